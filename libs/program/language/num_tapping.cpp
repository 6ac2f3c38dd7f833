// SPDX-License-Identifier: Apache-2.0
#include "language/num_tapping.hpp"

#include <cmath>
#include <cstdio>

namespace trunnion::language {
namespace {

constexpr double shortest_tap = 0.001;  // mm

}  // namespace

Fault NumTapping::run() {
  if (!words_.g().has(Group::cycle)) {
    // The document does not say whether such a block taps again.
    const bool axes = (words_.letters() & axis_bits) != 0;
    return axes ? Fault{AlarmNumber::num_tap_modal, words_.offset_of_any(axis_bits)} : Fault{};
  }
  const std::uint16_t at = words_.g().offset(Group::cycle);
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  Tap tap;
  if (const Fault fault = read(at, tap)) return fault;
  ModalState& modal = state_.modal;
  const SpindleDirection turned = modal.spindle_direction;
  const bool clockwise = turned == SpindleDirection::cw;
  if (tap.approach) {
    if (const Fault fault = rapid_to(tap, *tap.approach)) return fault;
  }
  if (const Fault fault = rapid_to(tap, tap.start)) return fault;
  // A spindle is coupled at standstill.
  modal.spindle_direction = SpindleDirection::stopped;
  output_.push(CommandKind::auxiliary).number = 5;
  const double lead = clockwise ? tap.lead : -tap.lead;
  if (const Fault fault = stroke_to(tap, tap.depth, lead, 0)) return fault;
  if (const Fault fault = stroke_to(tap, tap.start, lead, tap.retract_speed)) return fault;
  if (!stops_spindle()) {
    modal.spindle_direction = turned;
    output_.push(CommandKind::auxiliary).number = clockwise ? 3 : 4;
  }
  return tap.approach ? rapid_to(tap, *tap.approach) : Fault{};
}

Fault NumTapping::read(std::uint16_t at, Tap& tap) {
  const ModalState& modal = state_.modal;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  words_.use_axes();
  if (axes != (1u << X) && axes != (1u << Z)) return {AlarmNumber::num_tap_axis, at};
  tap.axis = axes == (1u << X) ? X : Z;
  if (!modal.absolute) return {AlarmNumber::num_tap_incremental, at};
  tap.lead = words_.length('K');
  if (!(tap.lead > 0)) return {AlarmNumber::num_tap_lead, words_.offset('K')};
  const bool speed = modal.spindle_mode == SpindleMode::speed && modal.spindle_speed > 0;
  if (!speed || modal.spindle_direction == SpindleDirection::stopped)
    return {AlarmNumber::num_tap_spindle, at};
  if (const Fault fault = read_retract(tap)) return fault;
  return read_levels(at, tap);
}

Fault NumTapping::read_retract(Tap& tap) {
  if (!words_.has(retract_ratio_word)) return {};
  words_.use(retract_ratio_word);
  const double ratio = words_.value(retract_ratio_word);
  if (!(ratio > 0)) return {AlarmNumber::num_tap_lead, words_.offset(retract_ratio_word)};
  tap.retract_speed = ratio * state_.modal.spindle_speed;
  const double highest = environment_.highest_spindle_speed();
  if (highest == 0 || tap.retract_speed <= highest) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::spindle_speed_above;
  std::snprintf(detail.text.data(), detail.text.size(), "S times EK %.6g, at most %.6g 1/min (%s)",
                tap.retract_speed, highest, environment_.highest_speed_parameter());
  return {detail.number, words_.offset(retract_ratio_word)};
}

Fault NumTapping::read_levels(std::uint16_t at, Tap& tap) {
  tap.depth = words_.axis(tap.axis);
  tap.start =
      words_.has(work_plane_word) ? level(work_plane_word, tap.axis) : state_.program_position[tap.axis];
  if (words_.has(approach_word)) tap.approach = level(approach_word, tap.axis);
  const double into = tap.depth - tap.start;
  const bool in_front = !tap.approach || (*tap.approach - tap.start) * into <= 0;
  if (std::abs(into) >= shortest_tap && in_front) return {};
  return {AlarmNumber::num_tap_level, words_.has(work_plane_word) ? words_.offset(work_plane_word) : at};
}

/// mm, as a word of the axis.
double NumTapping::level(char word, std::size_t axis) {
  return words_.length(word) * (axis == X && environment_.diameter_programming() ? 0.5 : 1.0);
}

bool NumTapping::stops_spindle() const {
  const MCodes& m = words_.m();
  for (std::size_t i = 0; i < m.count; ++i)
    if (m.codes[i].number == 5) return true;
  return false;
}

Fault NumTapping::rapid_to(const Tap& tap, double to) {
  AxisValues target = state_.program_position;
  target[tap.axis] = to;
  return output_.move_straight({CommandKind::rapid}, target);
}

Fault NumTapping::stroke_to(const Tap& tap, double to, double lead, double speed) {
  AxisValues target = state_.program_position;
  target[tap.axis] = to;
  StraightMove stroke{CommandKind::tap};
  stroke.value = lead;
  stroke.spindle_speed = speed;
  stroke.hole_speed = tap.retract_speed;
  return output_.move_straight(stroke, target);
}

}  // namespace trunnion::language
