// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>

#include "language/letters.hpp"
#include "language/num_line.hpp"
#include "language/num_reader.hpp"

namespace trunnion::language {
namespace {

constexpr double thread_motion = 33;    // of g_codes
constexpr double active_motion = 4001;  // variable with the motion code in force

}  // namespace

Fault NumReader::complete() {
  block_.lead_word = 'K';
  block_.spindle_codes = true;
  if (const Fault fault = check_order()) return fault;
  if (const Fault fault = complete_thread()) return fault;
  if (const Fault fault = calls_ ? complete_call() : check_no_call()) return fault;
  if (const Fault fault = removes_ ? complete_removal() : taps_ ? check_tap() : check_no_tap()) return fault;
  if (dwells_) {
    if (const Fault fault = complete_dwell()) return fault;
  }
  if (assigned_ && block_.statement == Statement::none && !block_.has_more())
    block_.statement = Statement::assignment;
  return {};
}

Fault NumReader::check_order() const {
  if (!orders_) return {};
  if (orders_angle_ && removes_) return wrong_removal(removal_at_);
  if (orders_angle_ && thread_ != NumUse::code) return {AlarmNumber::num_word, angle_at_};
  if (block_.g_count != 0 || (block_.letters & axis_bits) == 0) return {};
  Value motion;
  const AlarmNumber alarm = variables_.read(active_motion, motion);
  const bool continues = alarm == AlarmNumber::none && motion.number == thread_motion;
  return continues ? Fault{AlarmNumber::num_word, order_at_} : Fault{};
}

Fault NumReader::complete_thread() {
  if (thread_ == NumUse::code) return {};
  if (!block_.has('K')) return {AlarmNumber::missing_word, thread_at_, needs('K')};
  if (thread_ == NumUse::thread) return {};
  if ((block_.letters & axis_bits) == 0) return {AlarmNumber::missing_word, thread_at_, "needs an axis"};
  block_.thread = thread_ == NumUse::resumed ? ThreadBlock::first : ThreadBlock::alone;
  return thread_ == NumUse::resumed ? Fault{} : check_one_pass();
}

Fault NumReader::check_one_pass() const {
  const std::uint32_t of_cycle = block_.letters & letter_bits("FRS");
  if (of_cycle != 0) return {AlarmNumber::num_function_missing, first_offset(of_cycle), thread_cycle};
  const std::uint32_t other_axes = block_.letters & axis_bits & ~letter_bits("XZ");
  if (other_axes != 0) return {AlarmNumber::num_word, first_offset(other_axes)};
  const bool angle = block_.has(taught_angle_word), x = block_.has(taught_x_word),
             z = block_.has(taught_z_word);
  if (x && z) return {AlarmNumber::num_thread_data, block_.offset(taught_z_word), "both EX and EZ"};
  if ((x || z) && !angle)
    return {AlarmNumber::num_thread_data, block_.offset(x ? taught_x_word : taught_z_word), "needs EC"};
  if (angle && !x && !z)
    return {AlarmNumber::num_thread_data, block_.offset(taught_angle_word), "needs EZ or EX"};
  return {};
}

std::uint16_t NumReader::first_offset(std::uint32_t letters) const {
  return block_.offsets[static_cast<std::size_t>(std::countr_zero(letters))];
}

Fault NumReader::check_no_call() const {
  return block_.has('H') ? Fault{AlarmNumber::num_word, block_.offset('H')} : Fault{};
}

Fault NumReader::complete_call() {
  if (!block_.has('H')) return {AlarmNumber::missing_word, call_at_, needs('H')};
  const std::uint16_t at = block_.offset('H');
  // On a NUM control S is how often; here it would be a speed.
  if (block_.has('S')) return {AlarmNumber::num_word, block_.offset('S')};
  if (const Fault fault = program_of(block_.value('H'), at, block_.called)) return fault;
  block_.letters &= ~Block::bit('H');
  block_.offsets['P' - 'A'] = at;  // where an alarm of the call points
  return add_m(98, call_at_);
}

Fault NumReader::check_no_tap() const {
  for (const char word : {retract_ratio_word, work_plane_word, approach_word})
    if (block_.has(word)) return {AlarmNumber::num_word, block_.offset(word)};
  return {};
}

Fault NumReader::check_tap() const {
  return block_.has('K') ? Fault{} : Fault{AlarmNumber::missing_word, tap_at_, needs('K')};
}

Fault NumReader::complete_removal() {
  constexpr std::uint32_t axes = letter_bits("UVWXYZ"), others = letter_bits("KNS");
  const bool has_words =
      block_.has('S') && block_.has('K') && block_.value('K') > 0 && (block_.letters & axes) != 0;
  if (!has_words || (block_.letters & ~(axes | others)) != 0 || block_.g_count != 1 || calls_)
    return wrong_removal(removal_at_);
  int senses = 0, ranges = 0;
  bool clockwise = false;
  std::uint8_t kept = 0;
  for (std::size_t i = 0; i < block_.m_count; ++i) {
    const CodeWord m = block_.m[i];
    const auto within = [&](double first, double last) {
      return m.value == std::floor(m.value) && m.value >= first && m.value <= last;
    };
    if (within(3, 4)) {
      ++senses;
      clockwise = m.value == 3;
    } else if (within(40, 45)) {
      ++ranges;
    } else if (within(64, 66)) {
      block_.m[kept++] = m;
    } else {
      return wrong_removal(m.offset);
    }
  }
  if (senses == 0) return wrong_removal(removal_at_);
  if (senses > 1 || ranges > 1) return {AlarmNumber::num_removal_twice, removal_at_, "NUM error 1"};
  block_.m_count = kept;
  if (clockwise) block_.values['K' - 'A'] = -block_.value('K');
  block_.ends_program = true;
  return add_m(2, removal_at_);
}

Fault NumReader::complete_dwell() {
  if (!block_.has('F')) return {AlarmNumber::missing_word, dwell_at_, needs('F')};
  for (const char axis : {'X', 'U'}) {
    if (block_.has(axis)) return {AlarmNumber::num_word, block_.offset(axis)};
  }
  block_.letters &= ~Block::bit('F');
  store('X', block_.value('F'), block_.offset('F'));
  return {};
}

}  // namespace trunnion::language
