// SPDX-License-Identifier: Apache-2.0
#include "program_record.hpp"

#include <charconv>
#include <sstream>
#include <stdexcept>

#include "storage/crc32.hpp"

namespace trunnion::channel {
namespace {

constexpr const char* head = "trunnion program 1";

template <class Number>
Number number_of(const std::string& text, const std::string& file, int line) {
  Number value = 0;
  const auto end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || at != end || text.empty())
    throw std::runtime_error(file + ":" + std::to_string(line) + ":1: not a whole number: '" + text + "'");
  return value;
}

}  // namespace

std::string write_record(const RunningProgram& program) {
  std::string text = std::string(head) + "\n" + std::to_string(program.revision) + "\n" +
                     std::to_string(program.crc) + "\n" + std::to_string(program.line) + "\n" + program.name +
                     "\n";
  return text + std::to_string(storage::crc32(text)) + "\n";
}

RunningProgram read_record(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  std::string lines[6];
  for (int i = 0; i < 6; ++i)
    if (!std::getline(in, lines[i]) || in.eof())
      throw std::runtime_error(file + ":" + std::to_string(i + 1) + ":1: the file ends here");
  if (lines[0] != head) throw std::runtime_error(file + ":1:1: '" + head + "' expected");
  RunningProgram program;
  program.revision = number_of<std::uint64_t>(lines[1], file, 2);
  program.crc = number_of<std::uint32_t>(lines[2], file, 3);
  program.line = number_of<std::uint32_t>(lines[3], file, 4);
  program.name = lines[4];
  const auto sum = number_of<std::uint32_t>(lines[5], file, 6);
  if (write_record(program) != text ||
      sum != storage::crc32(text.substr(0, text.size() - lines[5].size() - 1)))
    throw std::runtime_error(file + ":6:1: the check sum is wrong");
  return program;
}

}  // namespace trunnion::channel
