// SPDX-License-Identifier: Apache-2.0
#include "machine/program_number.hpp"

#include <cstddef>

namespace trunnion::machine {
namespace {

constexpr std::size_t most_digits = 9;

bool is_digit(std::string_view text, std::size_t at) {
  return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

bool has_letter(std::string_view text) {
  return !text.empty() && (text[0] == 'O' || text[0] == 'o' || text[0] == '%');
}

// The digits from `at`, which is behind them afterwards.
std::optional<ProgramNumber> read_number(std::string_view text, std::size_t& at) {
  const std::size_t begin = at;
  ProgramNumber program;
  for (; is_digit(text, at) && at - begin < most_digits; ++at)
    program.number = program.number * 10 + static_cast<std::uint32_t>(text[at] - '0');
  if (at == begin || is_digit(text, at)) return std::nullopt;
  return program;
}

// A point and one digit.
bool has_index(std::string_view text, std::size_t at) {
  return at < text.size() && text[at] == '.' && is_digit(text, at + 1) && !is_digit(text, at + 2);
}

std::uint8_t index_at(std::string_view text, std::size_t point) {
  return static_cast<std::uint8_t>(text[point + 1] - '0');
}

}  // namespace

std::optional<ProgramNumber> number_in_name(std::string_view name) {
  std::size_t at = has_letter(name) ? 1 : 0;
  auto program = read_number(name, at);
  if (!program || at == name.size()) return program;
  if (name[at] != '.') return std::nullopt;
  const std::size_t behind = at + 2;
  if (has_index(name, at) && (behind == name.size() || name[behind] == '.'))
    program->index = index_at(name, at);
  return program;
}

bool is_temporary(std::string_view name) { return name.ends_with(".tmp.nc"); }

std::optional<ProgramNumber> number_in_head(std::string_view text) {
  if (!has_letter(text)) return std::nullopt;
  std::size_t at = 1;
  auto program = read_number(text, at);
  if (program && has_index(text, at)) program->index = index_at(text, at);
  return program;
}

}  // namespace trunnion::machine
