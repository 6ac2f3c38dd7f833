// SPDX-License-Identifier: Apache-2.0
#include "language/block_context.hpp"

#include <cmath>
#include <numbers>

namespace trunnion::language {

double BlockHandler::absolute_target(std::size_t axis, double word, double position) const {
  return is_rotary(axis) ? canonical::rotary_target(environment_.rotary_way(axis), word, position) : word;
}

AxisValues BlockHandler::programmed_target(std::uint32_t axes) {
  AxisValues target = state_.program_position;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    const double word = words_.axis(axis);
    target[axis] = state_.modal.absolute ? absolute_target(axis, word, target[axis]) : target[axis] + word;
  }
  if (state_.modal.polar) apply_polar(axes, target);
  return target;
}

// The radius is about the program's zero, or about the position when it is an incremental word; the angle is
// in the plane from its first axis, or from the last angle.
void BlockHandler::apply_polar(std::uint32_t axes, AxisValues& target) {
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  const bool radius = ((axes >> plane.first) & 1u) != 0;
  const bool angle = ((axes >> plane.second) & 1u) != 0;
  if (!radius && !angle) return;
  ProgramSettings& polar = state_.change_settings();
  if (radius) {
    polar.polar_radius = words_.axis(plane.first);
    polar.polar_centre = {};
    if (!state_.modal.absolute) {
      polar.polar_centre = {state_.program_position[plane.first], state_.program_position[plane.second]};
    }
  }
  if (angle) {
    const double word = words_.value(axis_letters[plane.second]);
    polar.polar_angle = std::fmod(state_.modal.absolute ? word : polar.polar_angle + word, 360.0);
  }
  const double radians = polar.polar_angle * (std::numbers::pi / 180.0);
  target[plane.first] = polar.polar_centre[0] + polar.polar_radius * std::cos(radians);
  target[plane.second] = polar.polar_centre[1] + polar.polar_radius * std::sin(radians);
}

Fault BlockHandler::check_feed(std::uint16_t at) const {
  ModalState& modal = state_.modal;
  if (!(modal.feed > 0) && modal.feed_mode == FeedMode::per_minute && environment_.feeds_without_word())
    modal.feed = environment_.default_feed();
  const bool given = modal.feed_mode == FeedMode::inverse_time ? words_.has('F') : modal.feed > 0;
  return given ? Fault{} : Fault{AlarmNumber::feed_missing, at};
}

}  // namespace trunnion::language
