// SPDX-License-Identifier: Apache-2.0
#include "language/tap_removal.hpp"

#include <bit>

namespace trunnion::language {

Fault TapRemoval::run(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  const auto axis = static_cast<std::size_t>(std::countr_zero(axes));
  if (!std::has_single_bit(axes) || is_rotary(axis) || state_.modal.mirrored)
    return {AlarmNumber::tap_removal_axis, at};
  // A reader of another dialect has made the hand of the thread out of M3 or M4.
  const bool checked = words_.lead_word() != 'K';
  if (!words_.has('K')) return {AlarmNumber::missing_word, at, needs('K')};
  const double lead = words_.length('K');
  if (lead == 0) return {AlarmNumber::tap_removal_lead, words_.offset('K')};
  if (const Fault fault = check_spindle(at)) return fault;
  AxisValues target = state_.program_position;
  target[axis] += words_.axis(axis);
  if (checked) {
    if (const Fault fault = check_direction(at, axis, target)) return fault;
  }
  StraightMove stroke{CommandKind::tap};
  stroke.value = -lead;
  stroke.out = true;
  return output_.move_straight(stroke, target);
}

Fault TapRemoval::check_spindle(std::uint16_t at) const {
  const ModalState& modal = state_.modal;
  if (modal.spindle_mode != SpindleMode::speed || !(modal.spindle_speed > 0))
    return {AlarmNumber::tap_removal_lead, at};
  if (modal.spindle_direction != SpindleDirection::stopped) return {AlarmNumber::tap_removal_spindle, at};
  return {};
}

// In the plane that the spindle is square to, a hole is drilled from above.
Fault TapRemoval::check_direction(std::uint16_t at, std::size_t axis, const AxisValues& target) const {
  if (axis != Z || state_.modal.plane != Plane::xy) return {};
  const ProgramFrame& frame = state_.frame();
  const double upwards =
      frame.contour_from_program(target)[Z] - frame.contour_from_program(state_.program_position)[Z];
  return upwards > 0 ? Fault{} : Fault{AlarmNumber::tap_removal_direction, at};
}

}  // namespace trunnion::language
