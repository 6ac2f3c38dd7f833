// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_cycles.hpp"

#include <algorithm>
#include <cstdio>

namespace trunnion::language {
namespace {

/// mm, between two pecks, when D does not give it: 0.01 inch.
constexpr double peck_clearance = 0.254;
constexpr double smallest_ngc_peck = 0.001;  // mm
constexpr std::uint32_t most_repeats = 9999;
constexpr std::uint32_t linear_axes = letter_bits("XYZ");

/// The cycle cannot do without P.
constexpr bool must_dwell(std::uint8_t cycle) { return cycle == 82 || cycle == 86 || cycle == 89; }

}  // namespace

Fault LinuxcncCycles::run() {
  const bool named = words_.g().has(Group::cycle);
  const bool axes = (words_.letters() & axis_bits) != 0;
  if (!named && !axes) return {};
  const std::uint16_t at = named ? words_.g().offset(Group::cycle) : words_.offset_of_any(axis_bits);
  if (const Fault fault = check(at)) return fault;
  const ModalState& before = state_.at_block_begin().modal;
  const bool same = before.cycle == state_.modal.cycle;
  CycleWords& cycle = state_.change_settings().cycle;
  LinuxcncCycleWords words = same ? cycle.linuxcnc : LinuxcncCycleWords{};
  // From one cycle to another the level before the first of them stays.
  words.initial = before.cycle == 80 ? cycle.hole.initial : cycle.linuxcnc.initial;
  if (const Fault fault = read_levels(at, same, words)) return fault;
  if (const Fault fault = read_settings(at, same, words)) return fault;
  std::uint32_t repeats = 1;
  if (words_.has('L')) {
    if (const Fault fault = words_.whole_number('L', 1, most_repeats, repeats)) return fault;
  }
  cycle.linuxcnc = words;
  return drill(words, repeats);
}

Fault LinuxcncCycles::check(std::uint16_t at) const {
  const ModalState& modal = state_.modal;
  if ((words_.letters() & linear_axes) == 0) return {AlarmNumber::missing_word, at, "needs X, Y or Z"};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (modal.feed_mode == FeedMode::inverse_time) return {AlarmNumber::cycle_inverse_time, at};
  if (const Fault fault = check_feed(at)) return fault;
  if (is_tapping(modal.cycle)) return check_tapping(at);
  if (modal.cycle == 86 && modal.spindle_direction == SpindleDirection::stopped)
    return {AlarmNumber::linuxcnc_cycle_spindle, at, "M3 or M4"};
  return {};
}

// A tap before this one has stopped the spindle.
Fault LinuxcncCycles::check_tapping(std::uint16_t at) const {
  const ModalState& modal = state_.modal;
  if (modal.spindle_mode != SpindleMode::speed || !(modal.spindle_speed > 0))
    return {AlarmNumber::cycle_lead_missing, at};
  const SpindleDirection turned =
      state_.parked != SpindleDirection::stopped ? state_.parked : modal.spindle_direction;
  const bool right = modal.cycle == 84;
  if (turned == (right ? SpindleDirection::cw : SpindleDirection::ccw)) return {};
  return {AlarmNumber::linuxcnc_cycle_spindle, at, right ? "M3" : "M4"};
}

Fault LinuxcncCycles::read_levels(std::uint16_t at, bool same, LinuxcncCycleWords& words) {
  const std::uint8_t normal = plane_axes(state_.modal.plane).normal;
  const char depth = axis_letters[normal];
  if ((!words_.has(depth) || !words_.has('R')) && !same) return {AlarmNumber::cycle_depth_missing, at};
  if (words_.has(depth)) {
    words_.use(depth);
    words.depth = words_.axis(normal);
  }
  if (words_.has('R')) words.retract = words_.length('R');
  const bool absolute = state_.modal.absolute;
  const double r = absolute ? words.retract : words.initial + words.retract;
  const double z = absolute ? words.depth : r + words.depth;
  HoleParameters& hole = state_.change_settings().cycle.hole;
  hole.r = r;
  hole.z = z;
  hole.initial = std::max(words.initial, r);
  if (r >= z) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::cycle_level_side;
  std::snprintf(detail.text.data(), detail.text.size(), "R %.3f mm, depth %.3f mm", r, z);
  return {detail.number, words_.has('R') ? words_.offset('R') : at};
}

Fault LinuxcncCycles::read_settings(std::uint16_t at, bool same, LinuxcncCycleWords& words) {
  const std::uint8_t cycle = state_.modal.cycle;
  HoleParameters& hole = state_.change_settings().cycle.hole;
  hole.cycle = cycle;
  hole.dwell = hole.peck = hole.reduction = hole.least_peck = hole.between_outs = 0;
  hole.retract = hole.clearance = peck_clearance;
  hole.linuxcnc = true;
  if (is_pecking(cycle)) {
    if (words_.has('Q')) words.peck = words_.length('Q');
    if (!(words.peck >= smallest_ngc_peck))
      return {AlarmNumber::cycle_peck_missing, words_.has('Q') ? words_.offset('Q') : at};
    hole.peck = words.peck;
    if (words_.has('D')) hole.retract = hole.clearance = words_.length('D');
    if (!(hole.retract >= 0)) return {AlarmNumber::value_range, words_.offset('D')};
  }
  if (!must_dwell(cycle) && !is_tapping(cycle)) return {};
  if (words_.has('P')) {
    words_.use('P');
    words.dwell = words_.value('P');
    if (!(words.dwell >= 0 && words.dwell <= longest_dwell))
      return {AlarmNumber::value_range, words_.offset('P')};
  } else if (must_dwell(cycle) && !same) {
    return {AlarmNumber::missing_word, at, needs('P')};
  }
  hole.dwell = words.dwell;
  return {};
}

Fault LinuxcncCycles::drill(const LinuxcncCycleWords& words, std::uint32_t repeats) {
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  const HoleParameters& hole = state_.settings().cycle.hole;
  if (words.initial < hole.r) {
    AxisValues risen = state_.program_position;
    risen[plane.normal] = hole.r;
    if (const Fault fault = output_.move_straight({CommandKind::rapid}, risen)) return fault;
  }
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  const AxisValues before = state_.program_position;
  const std::uint32_t in_plane = axes & (1u << plane.first | 1u << plane.second);
  for (const std::uint8_t axis : {plane.first, plane.second}) words_.use(axis_letters[axis]);
  const AxisValues place = programmed_target(in_plane);
  const HolePattern::Point first{place[plane.first], place[plane.second]};
  HolePattern::Point step{};
  if (!state_.modal.absolute) step = {first[0] - before[plane.first], first[1] - before[plane.second]};
  return holes_.drill(first, step, repeats);
}

}  // namespace trunnion::language
