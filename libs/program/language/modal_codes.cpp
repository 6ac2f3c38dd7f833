// SPDX-License-Identifier: Apache-2.0
#include "language/modal_codes.hpp"

#include <cmath>
#include <cstdio>

#include "language/arc_geometry.hpp"

namespace trunnion::language {
namespace {

constexpr double metres_per_foot = 0.3048;

}  // namespace

Fault ModalCodes::stop_exactly(std::uint16_t) {
  output_.stop_exactly_once();
  return {};
}

Fault ModalCodes::set_units(std::uint16_t, bool metric) {
  state_.modal.metric = metric;
  return {};
}

Fault ModalCodes::set_feed_mode(std::uint16_t, FeedMode mode) {
  // A number of one mode is nonsense in another.
  if (mode != state_.modal.feed_mode) state_.modal.feed = 0;
  state_.modal.feed_mode = mode;
  return {};
}

Fault ModalCodes::feed_word() {
  if (!words_.has('F')) return {};
  words_.use('F');
  const double feed = words_.value('F');
  if (!(feed > 0)) return {AlarmNumber::feed_not_positive, words_.offset('F')};
  const bool time = state_.modal.feed_mode == FeedMode::inverse_time;
  state_.modal.feed = time ? feed : feed * words_.length_scale();
  return {};
}

Fault ModalCodes::set_spindle_mode(std::uint16_t, SpindleMode mode) {
  state_.modal.spindle_mode = mode;
  return {};
}

Fault ModalCodes::check_spindle_speed(double speed) {
  const double highest = environment_.highest_spindle_speed();
  if (highest == 0 || speed <= highest) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::spindle_speed_above;
  std::snprintf(detail.text.data(), detail.text.size(), "at most %.10g 1/min (10a948)", highest);
  return {detail.number, words_.offset('S')};
}

Fault ModalCodes::spindle_word() {
  ModalState& modal = state_.modal;
  const bool surface = modal.spindle_mode == SpindleMode::surface;
  const bool limit = words_.g().is(Group::one_block, 920);
  if (words_.has('S')) {
    words_.use('S');
    const double speed = words_.value('S');
    if (speed < 0) return {AlarmNumber::value_range, words_.offset('S')};
    if (limit) {
      modal.spindle_limit = speed;
    } else if (surface) {
      modal.surface_speed = modal.metric ? speed : speed * metres_per_foot;
    } else {
      if (const Fault fault = check_spindle_speed(speed)) return fault;
      modal.spindle_speed = speed;
    }
  }
  if (surface && !(modal.surface_speed > 0)) {
    const bool named = words_.g().has(Group::spindle_mode);
    return {AlarmNumber::surface_speed_missing,
            named ? words_.g().offset(Group::spindle_mode) : words_.offset('S')};
  }
  if ((words_.has('S') && !limit) || modal.spindle_mode != state_.at_block_begin().modal.spindle_mode) {
    output_.push(CommandKind::spindle_speed).value = surface ? modal.surface_speed : modal.spindle_speed;
  }
  return {};
}

Fault ModalCodes::tool_word() {
  // In a G10 without L the tool is the one the entry is for; nothing is selected.
  if (!words_.has('T') || (words_.g().is(Group::one_block, 100) && !words_.has('L'))) return {};
  std::uint32_t tool = 0;
  if (const Fault fault = words_.whole_number('T', 0, highest_tool, tool)) return fault;
  if (tool != 0 && !environment_.has_tool(tool)) return {AlarmNumber::tool_unknown, words_.offset('T')};
  state_.modal.selected_tool = static_cast<std::uint16_t>(tool);
  output_.push(CommandKind::tool).number = tool;
  return {};
}

Fault ModalCodes::set_plane(std::uint16_t at, Plane plane) {
  if (plane == state_.modal.plane) return {};
  if (state_.modal.rotated || state_.modal.polar) return {AlarmNumber::frame_plane, at};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  state_.modal.plane = plane;
  return {};
}

Fault ModalCodes::set_distance(std::uint16_t, bool absolute) {
  state_.modal.absolute = absolute;
  return {};
}

Fault ModalCodes::set_return_level(std::uint16_t, bool initial) {
  state_.modal.return_to_initial = initial;
  return {};
}

Fault ModalCodes::stop_at_every_end(std::uint16_t) {
  state_.modal.path_control = PathControl::exact_stop;
  return {};
}

Fault ModalCodes::set_continuous_path(std::uint16_t) {
  state_.modal.path_control = PathControl::continuous;
  state_.modal.path_tolerance = 0;
  for (const char letter : {'P', 'Q'}) {
    if (!words_.has(letter)) continue;
    const double tolerance = words_.length(letter);
    if (tolerance < 0) return {AlarmNumber::value_range, words_.offset(letter)};
    // Q allows merging collinear points; leaving every point in place stays within any Q.
    if (letter == 'P') state_.modal.path_tolerance = tolerance;
  }
  return {};
}

Fault ModalCodes::set_polar(std::uint16_t, bool on) {
  state_.modal.polar = on;
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  const double u = state_.program_position[plane.first];
  const double v = state_.program_position[plane.second];
  ProgramSettings& polar = state_.change_settings();
  polar.polar_centre = {};
  polar.polar_radius = std::hypot(u, v);
  polar.polar_angle = std::atan2(v, u) * degrees_per_radian;
  return {};
}

Fault ModalCodes::set_smoothing(std::uint16_t at) {
  if (!words_.has('Q')) return {AlarmNumber::missing_word, at, needs('Q')};
  std::uint32_t q = 0;
  if (const Fault fault = words_.whole_number('Q', 0, 2, q)) return fault;
  state_.modal.smoothing = static_cast<std::uint8_t>(q);
  return {};
}

Fault ModalCodes::set_motion(std::uint16_t, std::uint8_t motion) {
  state_.modal.motion = motion;
  state_.modal.cycle = 80;
  return {};
}

Fault ModalCodes::set_cycle(std::uint16_t, std::uint8_t cycle) {
  // The level a cycle comes back to is the one before the first of its kind.
  if (state_.modal.cycle == 80 && cycle != 80) {
    const double level = state_.program_position[plane_axes(state_.modal.plane).normal];
    state_.change_settings().cycle.hole.initial = level;
  }
  state_.modal.cycle = cycle;
  return {};
}

}  // namespace trunnion::language
