// SPDX-License-Identifier: Apache-2.0
#include "language/line_tapping.hpp"

namespace trunnion::language {

Fault LineTapping::run(std::uint16_t at, bool left_hand) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  if (const Fault fault = check(at, axes)) return fault;
  ModalState& modal = state_.modal;
  const AxisValues start = state_.program_position, end = programmed_target(axes);
  if (start == end) return {AlarmNumber::line_tap_axes, at};
  const SpindleDirection turned = modal.spindle_direction;
  if (turned != SpindleDirection::stopped) {
    modal.spindle_direction = SpindleDirection::stopped;
    output_.push(CommandKind::auxiliary).number = 5;
  }
  const bool per_revolution = modal.feed_mode == FeedMode::per_revolution;
  const double lead = (left_hand ? -1 : 1) * (per_revolution ? modal.feed : modal.feed / modal.spindle_speed);
  if (const Fault fault = stroke_to(end, lead)) return fault;
  if (const Fault fault = stroke_to(start, lead)) return fault;
  if (turned != SpindleDirection::stopped) {
    modal.spindle_direction = turned;
    output_.push(CommandKind::auxiliary).number = turned == SpindleDirection::cw ? 3 : 4;
  }
  return {};
}

Fault LineTapping::check(std::uint16_t at, std::uint32_t axes) const {
  const ModalState& modal = state_.modal;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (((axes >> axis) & 1u) != 0 && is_rotary(axis)) return {AlarmNumber::line_tap_axes, at};
  if (modal.feed_mode == FeedMode::inverse_time) return {AlarmNumber::cycle_inverse_time, at};
  const bool speed = modal.spindle_mode == SpindleMode::speed && modal.spindle_speed > 0;
  return speed && modal.feed > 0 ? Fault{} : Fault{AlarmNumber::cycle_lead_missing, at};
}

Fault LineTapping::stroke_to(const AxisValues& target, double lead) {
  StraightMove stroke{CommandKind::tap};
  stroke.value = lead;
  return output_.move_straight(stroke, target);
}

}  // namespace trunnion::language
