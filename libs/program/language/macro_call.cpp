// SPDX-License-Identifier: Apache-2.0
#include "language/macro_call.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace trunnion::language {
namespace {

constexpr double highest_program = 99999999;
constexpr double most_calls = 999999;
constexpr std::uint32_t first_m_cycle = 1007;

// The programs that codes call, and the variables of T and S, as on Fanuc controls.
constexpr std::uint32_t t_subprogram = 9000, m_subprogram = 9001, g_macro = 9010, m_macro = 9020,
                        s_subprogram = 9029;
constexpr std::uint32_t t_variable = 149, s_variable = 147;
constexpr std::size_t m_argument = 13, p_argument = 16;

/// Of the code, as it is written, among those that call, or their number.
template <std::size_t Count>
std::size_t place_of(const CodeWord& word, const std::array<std::uint16_t, Count>& calls) {
  const double code = word.written != 0 ? word.written : word.value;
  std::size_t k = 0;
  while (k < Count && (calls[k] == 0 || code != calls[k])) ++k;
  return k;
}

Fault whole_word(const Block& block, char name, double lowest, double highest, std::uint32_t& result) {
  const double value = block.value(name);
  if (value != std::floor(value)) return {AlarmNumber::not_an_integer, block.offset(name)};
  if (value < lowest || value > highest) return {AlarmNumber::value_range, block.offset(name)};
  result = static_cast<std::uint32_t>(value);
  return {};
}

/// Beside a code of the control there may be G90 or G91, which the caller carries out.
Fault check_beside(const Block& block, const Call& call) {
  const Fault fault{AlarmNumber::call_not_alone, call.offset};
  if (block.m_count != 0 || block.g_count > 2) return fault;
  for (std::size_t i = 0; i < block.g_count; ++i) {
    const CodeWord& word = block.g[i];
    if (word.offset != call.offset && word.value != 90 && word.value != 91) return fault;
  }
  return {};
}

/// List I and II in the sequence they were written in: of a variable named by both, the later counts.
void fanuc_arguments(const Block& block, Arguments& arguments) {
  std::array<std::uint16_t, local_variables> written{};
  const auto set = [&](std::size_t variable, double value, std::uint16_t offset) {
    if (arguments.values[variable].given && written[variable] > offset) return;
    arguments.values[variable] = Value::of(value);
    written[variable] = offset;
  };
  for (const ArgumentLetter& argument : argument_letters) {
    const bool listed = block.centre_count != 0 && argument.letter >= 'I' && argument.letter <= 'K';
    if (!listed && argument.letter != 'M' && block.has(argument.letter)) {
      set(argument.variable, block.value(argument.letter), block.offset(argument.letter));
    }
  }
  if (block.m_count != 0) set(m_argument, block.m[0].value, block.m[0].offset);
  // A letter that does not continue from I to K begins the next of ten sets: I J K J K is two of them.
  std::size_t first = 4;
  char last = '\0';
  for (std::size_t i = 0; i < block.centre_count; ++i) {
    const CallCentre& centre = block.centres[i];
    if (centre.letter <= last) first += 3;
    last = centre.letter;
    const std::size_t variable = first + static_cast<std::size_t>(centre.letter - 'I');
    if (variable < local_variables) set(variable, centre.value, centre.offset);
  }
}

}  // namespace

ProgramName::ProgramName(std::uint32_t program) {
  const auto append = [this](std::string_view part) {
    std::copy(part.begin(), part.end(), text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += part.size();
  };
  if (program == cycle_file) {
    append("USERDEF.CYC");
    return;
  }
  std::array<char, 10> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), program % program_tenth).ptr;
  const auto count = static_cast<std::size_t>(end - digits.data());
  append("O");
  append(std::string_view("0000").substr(std::min<std::size_t>(count, 4)));
  append({digits.data(), count});
  if (program < program_tenth) return;
  const char tenth = static_cast<char>('0' + program / program_tenth % 10);
  append(".");
  append({&tenth, 1});
}

bool find_call(const Block& block, const CycleMCodes& cycle_m_codes, Call& call) {
  for (std::size_t i = 0; i < block.g_count; ++i) {
    const double code = block.g[i].value;
    const double tenths = std::round(code * 10);
    if (tenths < call_codes[0].first) continue;
    const bool range_fits = std::abs(code * 10 - tenths) < 1e-9;
    for (const CallCode& entry : call_codes) {
      if (!range_fits || tenths < entry.first || tenths > entry.last) continue;
      if (entry.kind == CallKind::cycle && code != std::floor(code)) continue;
      call = Call{};
      call.kind = entry.kind;
      call.offset = call.program_offset = block.g[i].offset;
      if (entry.kind == CallKind::cycle) call.number = static_cast<std::uint32_t>(code);
      if (entry.kind == CallKind::control) {
        call.code = entry.first;
        call.number = entry.first == length_measuring_code ? length_measuring_macro : circular_pocket_macro;
      }
      return true;
    }
  }
  for (std::size_t i = 0; i < block.m_count; ++i) {
    const double code = block.m[i].value;
    for (std::uint32_t k = 0; k < cycle_m_codes.size(); ++k) {
      if (cycle_m_codes[k] == 0 || code != cycle_m_codes[k]) continue;
      call = Call{};
      call.kind = CallKind::cycle;
      call.number = first_m_cycle + k;
      call.offset = call.program_offset = block.m[i].offset;
      return true;
    }
  }
  return false;
}

bool take_code_call(Block& block, const CodeCalls& calls, Call& call, std::uint32_t& variable,
                    double& value) {
  call = Call{};
  call.by_code = true;
  call.kind = CallKind::macro;
  variable = 0;
  const auto found = [&](std::uint32_t number, std::uint16_t at) {
    call.number = number;
    call.offset = call.program_offset = at;
    return true;
  };
  for (std::size_t i = 0; i < block.g_count; ++i) {
    const std::size_t k = place_of(block.g[i], calls.g);
    if (k < calls.g.size()) return found(g_macro + static_cast<std::uint32_t>(k), block.g[i].offset);
  }
  for (std::size_t i = 0; i < block.m_count; ++i) {
    const std::size_t k = place_of(block.m[i], calls.m);
    if (k < calls.m.size()) return found(m_macro + static_cast<std::uint32_t>(k), block.m[i].offset);
  }
  call.kind = CallKind::subprogram;
  for (std::size_t i = 0; i < block.m_count; ++i) {
    const std::size_t k = place_of(block.m[i], calls.m_subprograms);
    if (k == calls.m_subprograms.size()) continue;
    const std::uint16_t at = block.m[i].offset;
    std::copy(block.m.begin() + static_cast<std::ptrdiff_t>(i + 1), block.m.begin() + block.m_count,
              block.m.begin() + static_cast<std::ptrdiff_t>(i));
    --block.m_count;
    return found(m_subprogram + static_cast<std::uint32_t>(k), at);
  }
  for (const char letter : {'T', 'S'}) {
    if (!(letter == 'T' ? calls.t : calls.s) || !block.has(letter)) continue;
    variable = letter == 'T' ? t_variable : s_variable;
    value = block.value(letter);
    block.letters &= ~Block::bit(letter);
    return found(letter == 'T' ? t_subprogram : s_subprogram, block.offset(letter));
  }
  return false;
}

Fault read_code_call(const Block& block, bool absolute, Call& call, Arguments& arguments) {
  if (block.two_tools) return {AlarmNumber::letter_twice, block.offset(second_tool_word)};
  const bool by_m = call.number >= m_macro;
  // M may be an argument of a G code; otherwise the code of the call is the only one.
  if (by_m ? block.g_count != 0 || block.m_count > 1 : block.g_count > 1 || block.m_count > 1)
    return {AlarmNumber::call_not_alone, call.offset};
  if (block.has('L')) {
    if (const Fault fault = whole_word(block, 'L', 1, most_calls, call.repetitions)) return fault;
  }
  read_arguments(block, call.kind, absolute, arguments);
  if (by_m) arguments.values[m_argument] = Value{};
  if (block.has('P')) arguments.values[p_argument] = Value::of(block.value('P'));
  return {};
}

Fault read_call(const Block& block, Call& call) {
  if (block.two_tools) return {AlarmNumber::letter_twice, block.offset(second_tool_word)};
  if (call.kind == CallKind::control) return check_beside(block, call);
  const bool fanuc = call.kind == CallKind::macro || call.kind == CallKind::modal_macro ||
                     call.kind == CallKind::block_macro;
  // In a Fanuc call M is an argument; otherwise the code of the call is the only one.
  const std::size_t codes = std::size_t{block.g_count} + block.m_count;
  if (block.g_count > 1 || codes > (fanuc ? 2u : 1u)) return {AlarmNumber::call_not_alone, call.offset};
  if (call.kind == CallKind::cycle) return {};
  if (call.kind == CallKind::modal_cancel) {
    return (block.letters & ~Block::bit('N')) == 0 ? Fault{}
                                                   : Fault{AlarmNumber::call_not_alone, call.offset};
  }
  if (!block.has('P')) return {AlarmNumber::missing_word, call.offset, needs('P')};
  call.program_offset = block.offset('P');
  if (const Fault fault = whole_word(block, 'P', 1, highest_program, call.number)) return fault;
  if (!block.has('L')) return {};
  return whole_word(block, 'L', 1, most_calls, call.repetitions);
}

void read_arguments(const Block& block, CallKind kind, bool absolute, Arguments& arguments) {
  arguments.clear();
  arguments.absolute = absolute;
  if (kind != CallKind::cycle) fanuc_arguments(block, arguments);
  if (kind == CallKind::block_macro || kind == CallKind::control) {
    if (block.has('L')) arguments.values[12] = Value::of(block.value('L'));
    if (block.has('P')) arguments.values[16] = Value::of(block.value('P'));
  }
  if (kind == CallKind::block_macro) {
    if (block.g_count != 0) arguments.values[10] = Value::of(block.g[block.g_count - 1u].value);
    if (block.has('N')) arguments.values[14] = Value::of(block.value('N'));
  }
  if (kind != CallKind::cycle) return;
  for (char name = 'A'; name <= 'Z'; ++name) {
    if (name != 'N' && block.has(name)) {
      arguments.values[static_cast<std::size_t>(name - 'A')] = Value::of(block.value(name));
    }
  }
}

}  // namespace trunnion::language
