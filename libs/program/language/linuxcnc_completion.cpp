// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <utility>

#include "language/linuxcnc_codes.hpp"
#include "language/linuxcnc_reader.hpp"

namespace trunnion::language {
namespace {

/// In which order M codes of one block act, whatever their order in the line.
int rank_of(double code) {
  constexpr int last = 6;
  if (code == 6) return 0;
  if (code == 3 || code == 4 || code == 5 || code == 19) return 1;
  if (code == 7 || code == 8 || code == 9) return 2;
  return code <= 2 || code == 30 || code == 98 || code == 99 ? last : last - 1;
}

}  // namespace

Fault LinuxcncReader::complete() {
  if (const Fault fault = complete_m()) return fault;
  if (const Fault fault = complete_calls()) return fault;
  if (const Fault fault = assign()) return fault;
  if (const Fault fault = complete_comment()) return fault;
  if (setting_count_ != 0 && !block_.has_more() && block_.statement == Statement::none)
    block_.statement = Statement::assignment;
  return {};
}

Fault LinuxcncReader::complete_m() {
  if (const Fault fault = complete_state()) return fault;
  for (std::size_t i = 0; i < block_.m_count;) {
    bool dropped = false;
    if (const Fault fault = complete_override(i, dropped)) return fault;
    if (dropped) continue;
    if (block_.m[i].value == 19) {
      if (const Fault fault = complete_orientation(block_.m[i].offset)) return fault;
    }
    ++i;
  }
  sort_m();
  return {};
}

Fault LinuxcncReader::complete_state() {
  for (std::size_t i = 0; i < block_.m_count; ++i) {
    const CodeWord m = block_.m[i];
    if (m.value < save_state_m || m.value > save_for_return_m) continue;
    const bool alone = block_.m_count == 1 && block_.g_count == 0 && (block_.letters & ~Block::bit('N')) == 0;
    if (!alone) return {AlarmNumber::linuxcnc_function_missing, m.offset, "M70 to M73 beside other words"};
    block_.statement = Statement::modal_state;
    block_.label = static_cast<std::uint32_t>(m.value);
    block_.at = m.offset;
    block_.m_count = 0;
  }
  return {};
}

// M48 and M50 to M53 switch what always acts here: that says nothing, its opposite is not possible.
Fault LinuxcncReader::complete_override(std::size_t index, bool& dropped) {
  const double code = block_.m[index].value;
  if (code != 48 && !(code >= 50 && code <= 53)) return {};
  const bool on = code == 48 || !block_.has('P') || block_.value('P') != 0;
  const bool acts = code != 52;
  if (on != acts)
    return {AlarmNumber::linuxcnc_function_missing, block_.m[index].offset,
            code == 52 ? "adaptive feed" : "overrides or feed stop switched off"};
  if (code != 48) drop('P');
  drop_m(index);
  dropped = true;
  return {};
}

// The control waits for the spindle in any case, and takes the shortest way.
Fault LinuxcncReader::complete_orientation(std::uint16_t at) {
  if (block_.has('P') && block_.value('P') != 0)
    return {AlarmNumber::linuxcnc_function_missing, at, "a direction P of M19"};
  if (block_.has('Q') && !(block_.value('Q') > 0)) return {AlarmNumber::value_range, block_.offset('Q')};
  if (block_.has('R') && !(block_.value('R') >= 0)) return {AlarmNumber::value_range, block_.offset('R')};
  drop('P');
  drop('Q');
  return {};
}

// M98 L0 calls nothing, and M99 has no label.
Fault LinuxcncReader::complete_calls() {
  for (std::size_t i = 0; i < block_.m_count; ++i) {
    const CodeWord m = block_.m[i];
    if (m.value == 99 && block_.has('P')) return {AlarmNumber::unused_word, block_.offset('P')};
    if (m.value != 98 || !block_.has('L') || block_.value('L') != 0) continue;
    if (!block_.has('P')) return {AlarmNumber::missing_word, m.offset, needs('P')};
    drop('P');
    drop('L');
    drop_m(i);
    return {};
  }
  return {};
}

void LinuxcncReader::sort_m() {
  for (std::size_t i = 1; i < block_.m_count; ++i)
    for (std::size_t k = i; k > 0 && rank_of(block_.m[k].value) < rank_of(block_.m[k - 1].value); --k)
      std::swap(block_.m[k], block_.m[k - 1]);
}

void LinuxcncReader::drop_m(std::size_t index) {
  for (std::size_t i = index + 1; i < block_.m_count; ++i) block_.m[i - 1] = block_.m[i];
  --block_.m_count;
}

// All values of a block are read before the first of its parameters is written.
Fault LinuxcncReader::assign() {
  for (std::size_t i = 0; i < setting_count_; ++i) {
    const auto& [parameter, value] = settings_[i];
    if (parameter.name != 0) {
      const bool predefined = parameter.global && predefined_parameter(parameter.name) != nullptr;
      if (predefined || parameter.of_files) return {AlarmNumber::variable_read_only, parameter.at};
      if (!variables_.names().write(parameter.name, parameter.global, value))
        return {AlarmNumber::linuxcnc_names, parameter.at};
      continue;
    }
    const std::uint32_t number = parameter.number;
    if (number < 1 || number > last_user_parameter) {
      const bool known = numbered_parameter(number) != nullptr;
      return {known ? AlarmNumber::variable_read_only : AlarmNumber::variable_unknown, parameter.at};
    }
    const AlarmNumber alarm = variables_.write(
        number <= last_call_parameter ? number : number + user_parameter_distance, Value::of(value));
    if (alarm != AlarmNumber::none) return {alarm, parameter.at};
  }
  return {};
}

}  // namespace trunnion::language
