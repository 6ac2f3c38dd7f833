// SPDX-License-Identifier: Apache-2.0
#include "program_index.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "storage/crc32.hpp"

namespace trunnion::program {
namespace {

constexpr std::size_t piece = 65536;

}  // namespace

void TextScan::add(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  size_ += bytes.size();
  crc_ = storage::crc32(crc_, bytes);
  for (const auto byte : bytes) {
    // A CR and the LF behind it are one end.
    if (byte == '\r' || (byte == '\n' && last_ != '\r')) ++ends_;
    last_ = byte;
  }
  head_.add(bytes);
}

bool valid_name(const std::string& name) {
  if (name.empty() || name.size() > 64 || name[0] == '.') return false;
  return std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  });
}

TextScan scan(Files& files, const std::string& name) {
  TextScan text;
  std::vector<std::uint8_t> buffer(piece);
  for (std::size_t n = piece; n == piece;) {
    n = files.read(name, text.size(), buffer);
    text.add(std::span(buffer).first(n));
  }
  return text;
}

const IndexedProgram* resolve(const Index& index, const std::string& call) {
  for (const auto* extension : {"", ".nc", ".NC", ".ngc", ".txt"})
    if (const auto found = index.find(call + extension); found != index.end()) return &found->second;
  const auto number = machine::number_in_name(call);
  if (!number) return nullptr;
  for (const auto& [name, program] : index)
    if (machine::number_in_name(name) == number) return &program;
  for (const auto& [name, program] : index)
    if (program.number == number) return &program;
  return nullptr;
}

}  // namespace trunnion::program
