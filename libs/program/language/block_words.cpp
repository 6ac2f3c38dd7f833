// SPDX-License-Identifier: Apache-2.0
#include "language/block_words.hpp"

#include <algorithm>
#include <cmath>

#include "language/decimal.hpp"
#include "language/linuxcnc_codes.hpp"

namespace trunnion::language {
namespace {

bool is_whole(double value, double low, double high) {
  return value == std::floor(value) && value >= low && value <= high;
}

}  // namespace

void BlockWords::configure(const Environment& machine) {
  channel_axes_ = machine.axes();
  diameter_ = machine.diameter_programming();
  functions_ = machine.m_functions();
  dwell_point_ = machine.dwell_point();
  radius_offsets_ = machine.haas_radius_offsets();
  words_for_logic_ = machine.m_codes_take_words();
}

Fault BlockWords::begin(const Block& block) {
  block_ = &block;
  used_ = Block::bit('N');
  g_.clear();
  m_.count = 0;
  if (const Fault fault = check_numbers()) return fault;
  if (const Fault fault = collect_g()) return fault;
  return collect_m();
}

Fault BlockWords::check_numbers() const {
  for (std::uint32_t rest = block_->letters; rest != 0; rest &= rest - 1) {
    const auto letter = static_cast<std::size_t>(std::countr_zero(rest));
    if (!(std::abs(block_->values[letter]) <= largest_number)) {
      return {AlarmNumber::number_range, block_->offsets[letter]};
    }
  }
  return {};
}

Fault BlockWords::collect_g() {
  for (std::size_t i = 0; i < block_->g_count; ++i) {
    const CodeWord& word = block_->g[i];
    const double tenths = std::round(word.value * 10);
    const bool exact = std::abs(word.value * 10 - tenths) < 1e-9 && tenths >= 0 && tenths < 10000;
    const auto number = static_cast<std::uint32_t>(exact ? tenths : 0);
    const GCode* const code = !exact ? nullptr : linuxcnc() ? linuxcnc_g_code(number) : g_code(number);
    if (code == nullptr) return {AlarmNumber::unknown_g, word.offset};
    if (g_.has(code->group)) return {AlarmNumber::group_twice, word.offset};
    g_.add(*code, word.offset);
  }
  // A cycle takes the place of the motion code.
  if (g_.has(Group::cycle) && !g_.is(Group::cycle, 800) && g_.has(Group::motion)) {
    return {AlarmNumber::group_twice, g_.offset(Group::cycle)};
  }
  return {};
}

Fault BlockWords::collect_m() {
  for (std::size_t i = 0; i < block_->m_count; ++i) {
    const CodeWord& word = block_->m[i];
    if (!is_whole(word.value, 0, highest_m)) return {AlarmNumber::unknown_m, word.offset};
    const auto number = static_cast<std::uint16_t>(word.value);
    const auto own = linuxcnc() ? linuxcnc_m_code(number) : std::nullopt;
    const MCode code = own ? *own : m_code(number);
    // What LinuxCNC does not have can only be a function of this machine.
    if (linuxcnc() && !own && (functions_ == nullptr || !functions_->has(number)))
      return {AlarmNumber::linuxcnc_m_unknown, word.offset,
              number >= first_user_m && number <= last_user_m ? "a user program of LinuxCNC" : nullptr};
    if (!has_function(code)) return {AlarmNumber::unknown_m, word.offset};
    for (std::size_t k = 0; k < m_.count; ++k) {
      const MCode& other = m_.codes[k];
      const bool same_group = (code.group != MGroup::none && code.group == other.group) ||
                              (functions_ != nullptr && functions_->same_group(code.number, other.number));
      if (same_group || code.number == other.number) return {AlarmNumber::group_twice, word.offset};
    }
    m_.codes[m_.count] = code;
    m_.offsets[m_.count++] = word.offset;
  }
  return {};
}

bool BlockWords::reaches_logic(const MCode& code) const {
  return functions_ == nullptr || code.group == MGroup::flow || functions_->has(code.number);
}

void BlockWords::leave_to_logic() {
  if (!words_for_logic_) return;
  for (std::size_t i = 0; i < m_.count; ++i)
    if (!is_named_m(m_.codes[i].number)) used_ |= letter_bits("PQRH");
}

std::uint16_t BlockWords::first_offset() const {
  if (block_->g_count > 0) return block_->g[0].offset;
  if (block_->m_count > 0) return block_->m[0].offset;
  return offset_of_any(block_->letters);
}

bool BlockWords::single_code() const {
  return block_->g_count == 1 && block_->m_count == 0 && (block_->letters & ~Block::bit('N')) == 0;
}

Fault BlockWords::report_unused() const {
  const std::uint32_t unused = block_->letters & ~used_;
  if (unused == 0) return {};
  std::uint16_t first = UINT16_MAX;
  for (std::uint32_t rest = unused; rest != 0; rest &= rest - 1) {
    first = std::min(first, block_->offsets[static_cast<std::size_t>(std::countr_zero(rest))]);
  }
  return {AlarmNumber::unused_word, first};
}

Fault BlockWords::whole_number(char letter, std::uint32_t low, std::uint32_t high, std::uint32_t& value) {
  use(letter);
  const double number = block_->value(letter);
  if (number != std::floor(number)) return {AlarmNumber::not_an_integer, block_->offset(letter)};
  if (number < low || number > high) return {AlarmNumber::value_range, block_->offset(letter)};
  value = static_cast<std::uint32_t>(number);
  return {};
}

Fault BlockWords::dwell(double longest, double& seconds) {
  use('P');
  const double value = block_->value('P');
  const bool point = ((block_->pointed & Block::bit('P')) != 0) || value != std::floor(value);
  const DwellPoint rule = block_->haas ? DwellPoint::seconds : dwell_point_;
  if (point && rule == DwellPoint::refused) return {AlarmNumber::dwell_point, block_->offset('P')};
  seconds = point && rule == DwellPoint::seconds ? value : value / 1000;
  if (seconds < 0 || seconds > longest) return {AlarmNumber::value_range, block_->offset('P')};
  return {};
}

double BlockWords::length(char letter) {
  if (!block_->has(letter)) return 0;
  use(letter);
  return block_->value(letter) * length_scale();
}

double BlockWords::axis(std::size_t axis) const {
  return in_axis_unit(block_->value(axis_letters[axis]), axis);
}

double BlockWords::in_axis_unit(double word, std::size_t axis) const {
  if (is_rotary(axis)) return word;
  return word * length_scale() * (diameter_ && axis == X ? 0.5 : 1.0);
}

Fault BlockWords::find_axes(std::uint32_t& axes) const {
  axes = 0;
  if ((block_->letters & axis_bits) == 0) return {};
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (!block_->has(axis_letters[axis])) continue;
    if (((channel_axes_ >> axis) & 1u) == 0)
      return {AlarmNumber::axis_absent, block_->offset(axis_letters[axis])};
    axes |= 1u << axis;
  }
  return {};
}

Fault BlockWords::take_axes(std::uint16_t at, std::uint32_t& axes) {
  if (const Fault fault = find_axes(axes)) return fault;
  if (axes == 0) return {AlarmNumber::missing_word, at, "needs an axis"};
  use_axes();
  return {};
}

}  // namespace trunnion::language
