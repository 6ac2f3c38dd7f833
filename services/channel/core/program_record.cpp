// SPDX-License-Identifier: Apache-2.0
#include "program_record.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "field_lines.hpp"
#include "storage/crc32.hpp"

namespace trunnion::channel {
namespace {

constexpr const char* head = "trunnion program ";
constexpr const char* newest = "trunnion program 5\n";

// The formats before, with values in the order of their lines and a checksum of their own. Each has lines
// more than the one before: the second has `ended`, the third `parts`, the fourth `tool` and `tool_since`.
constexpr int former_formats = 4;
constexpr std::array<std::size_t, former_formats> lines_of_format{6, 7, 8, 10};

int format_of(const std::string& text) {
  for (int format = 1; format <= former_formats; ++format)
    if (text.starts_with(head + std::to_string(format) + "\n")) return format;
  return 0;
}

template <class Number>
Number number_of(const std::string& text, const std::string& file, int line) {
  Number value = 0;
  const auto end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || at != end || text.empty())
    throw std::runtime_error(file + ":" + std::to_string(line) + ":1: not a whole number: '" + text + "'");
  return value;
}

RunningProgram read_former(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  const int format = format_of(text);
  const std::size_t size = lines_of_format[static_cast<std::size_t>(std::max(format, 1)) - 1];
  std::vector<std::string> lines(size);
  for (std::size_t i = 0; i < size; ++i)
    if (!std::getline(in, lines[i]) || in.eof())
      throw std::runtime_error(file + ":" + std::to_string(i + 1) + ":1: the file ends here");
  if (format == 0) throw std::runtime_error(file + ":1:1: '" + head + "1' to '" + head + "5' expected");
  RunningProgram program;
  program.revision = number_of<std::uint64_t>(lines[1], file, 2);
  program.crc = number_of<std::uint32_t>(lines[2], file, 3);
  program.line = number_of<std::uint32_t>(lines[3], file, 4);
  program.name = lines[4];
  if (format >= 2) program.ended = number_of<std::uint64_t>(lines[5], file, 6);
  if (format >= 3) program.parts = number_of<std::uint32_t>(lines[6], file, 7);
  if (format >= 4) {
    program.tool = number_of<std::uint32_t>(lines[7], file, 8);
    program.tool_since = number_of<std::uint64_t>(lines[8], file, 9);
  }
  const auto last = static_cast<int>(size);
  const auto sum = number_of<std::uint32_t>(lines.back(), file, last);
  const auto summed = text.size() - std::min(text.size(), lines.back().size() + 1);
  if (in.peek() != std::istringstream::traits_type::eof() || sum != storage::crc32(text.substr(0, summed)))
    throw std::runtime_error(file + ":" + std::to_string(last) + ":1: the check sum is wrong");
  return program;
}

}  // namespace

std::string write_record(const RunningProgram& program) { return newest + write_lines(program); }

RunningProgram read_record(const std::string& text, const std::string& file) {
  return text.starts_with(newest) ? read_lines(text, file, RunningProgram{}) : read_former(text, file);
}

}  // namespace trunnion::channel
