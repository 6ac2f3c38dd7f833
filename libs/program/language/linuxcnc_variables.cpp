// SPDX-License-Identifier: Apache-2.0
// Parameters of the LinuxCNC dialect that show the state of the control.
#include "language/control_variables.hpp"
#include "language/linuxcnc_parameters.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t coordinate_systems = 9;  // G54 to G59.3
constexpr std::uint32_t numbers_of_system = 20;
constexpr std::uint32_t rotation_of_system = 9;  // behind its axes
constexpr std::uint8_t lettered_offsets = 6;     // G54 to G59, before those with a decimal
constexpr std::uint8_t g28 = 0, g30 = 2;         // as Environment::numbered_reference()

double flag_value(bool holds) { return holds ? 1 : 0; }

}  // namespace

AlarmNumber ControlVariables::read_linuxcnc(LinuxcncValue which, std::uint32_t index, double& value) const {
  value = 0;
  switch (which) {
    case LinuxcncValue::machine_position:
    case LinuxcncValue::skip_position:
    case LinuxcncValue::reference:
    case LinuxcncValue::second_reference:
    case LinuxcncValue::shift:
    case LinuxcncValue::position:
      return linuxcnc_place(which, index, value);
    case LinuxcncValue::work_offset:
      return linuxcnc_offset(index, value);
    case LinuxcncValue::active_length:
    case LinuxcncValue::tool:
    case LinuxcncValue::tool_length:
    case LinuxcncValue::tool_diameter:
      return linuxcnc_tool(which, index, value);
    case LinuxcncValue::always_1:
      value = 1;
      return AlarmNumber::none;
    case LinuxcncValue::always_0:
      return AlarmNumber::none;
    default:
      return linuxcnc_mode(which, value);
  }
}

AlarmNumber ControlVariables::linuxcnc_place(LinuxcncValue which, std::uint32_t axis, double& value) const {
  switch (which) {
    case LinuxcncValue::machine_position:
      value = in_program_units(axis, executor_.machine_position()[axis]);
      break;
    case LinuxcncValue::skip_position:
      value = in_program_units(axis, skip_position_[axis]);
      break;
    case LinuxcncValue::position:
      value = in_program_units(axis, executor_.program_position()[axis]);
      break;
    case LinuxcncValue::shift:
      value = executor_.linuxcnc_frame().shift[axis];
      break;
    default: {
      const std::uint8_t number = which == LinuxcncValue::reference ? g28 : g30;
      const auto place = number == g28 ? environment_.reference_position()
                                       : environment_.numbered_reference(number).value_or(AxisValues{});
      value = place[axis];
      break;
    }
  }
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::linuxcnc_offset(std::uint32_t index, double& value) const {
  const std::uint32_t axis = index % numbers_of_system, system = index / numbers_of_system;
  if (axis > rotation_of_system || system >= coordinate_systems) return AlarmNumber::variable_unknown;
  value = axis == rotation_of_system
              ? executor_.linuxcnc_frame().rotations[system]
              : executor_.tables().work_offset(static_cast<std::uint8_t>(system))[axis];
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::linuxcnc_tool(LinuxcncValue which, std::uint32_t axis, double& value) const {
  const ModalState& modal = executor_.modal();
  if (which == LinuxcncValue::tool) {
    value = modal.tool;
  } else if (which == LinuxcncValue::active_length) {
    value = axis == Z ? in_program_units(Z, modal.tool_length) : 0;
  } else if (modal.tool != 0) {
    const auto tool = executor_.tables().tool(modal.tool);
    if (!tool) return AlarmNumber::none;
    if (which == LinuxcncValue::tool_diameter)
      value = in_program_units(X, 2 * (tool->radius.value_or(0) + tool->radius_wear));
    else if (axis == Z)
      value = in_program_units(Z, tool->length + tool->length_wear);
  }
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::linuxcnc_mode(LinuxcncValue which, double& value) const {
  const ModalState& modal = executor_.modal();
  const bool surface = modal.spindle_mode == SpindleMode::surface;
  switch (which) {
    case LinuxcncValue::shift_active:
      value = flag_value(executor_.linuxcnc_frame().shifted);
      break;
    case LinuxcncValue::coordinate_system:
      value = modal.work_offset + 1;
      break;
    case LinuxcncValue::coordinate_code:
      value = modal.work_offset < lettered_offsets ? 540 + 10 * modal.work_offset
                                                   : 585 + modal.work_offset;  // 591 of the seventh
      break;
    case LinuxcncValue::mist:
      value = flag_value((executor_.state().coolant & mist_on) != 0);
      break;
    case LinuxcncValue::flood:
      value = flag_value((executor_.state().coolant & flood_on) != 0);
      break;
    case LinuxcncValue::skip_touched:
      value = flag_value(skip_touched_);
      break;
    case LinuxcncValue::line:
      value = line_;
      break;
    case LinuxcncValue::call_level:
      value = static_cast<double>(calls_);
      break;
    case LinuxcncValue::motion_mode:
      value = executor_.state().own_motion;
      if (value == 0) value = 10 * (modal.cycle != 80 ? modal.cycle : modal.motion);
      break;
    case LinuxcncValue::plane:
      value = modal.plane == Plane::xy ? 170 : modal.plane == Plane::zx ? 180 : 190;
      break;
    case LinuxcncValue::compensation:
      value = modal.cutter_side == CutterSide::off ? 400 : modal.cutter_side == CutterSide::left ? 410 : 420;
      break;
    case LinuxcncValue::metric:
      value = flag_value(modal.metric);
      break;
    case LinuxcncValue::imperial:
      value = flag_value(!modal.metric);
      break;
    case LinuxcncValue::absolute:
      value = flag_value(modal.absolute);
      break;
    case LinuxcncValue::incremental:
      value = flag_value(!modal.absolute);
      break;
    case LinuxcncValue::inverse_time:
      value = flag_value(modal.feed_mode == FeedMode::inverse_time);
      break;
    case LinuxcncValue::per_minute:
      value = flag_value(modal.feed_mode == FeedMode::per_minute);
      break;
    case LinuxcncValue::per_revolution:
      value = flag_value(modal.feed_mode == FeedMode::per_revolution);
      break;
    case LinuxcncValue::length_on:
      value = flag_value(modal.length_offset != 0 || modal.tool_length != 0);
      break;
    case LinuxcncValue::retract_to_r:
      value = flag_value(!modal.return_to_initial);
      break;
    case LinuxcncValue::retract_to_old:
      value = flag_value(modal.return_to_initial);
      break;
    case LinuxcncValue::speed_mode:
      value = flag_value(!surface);
      break;
    case LinuxcncValue::surface_mode:
      value = flag_value(surface);
      break;
    case LinuxcncValue::centre_absolute:
      value = flag_value(modal.absolute_centres);
      break;
    case LinuxcncValue::diameter_mode:
      value = flag_value(environment_.diameter_programming());
      break;
    case LinuxcncValue::radius_mode:
      value = flag_value(!environment_.diameter_programming());
      break;
    case LinuxcncValue::spindle_on:
      value = flag_value(modal.spindle_direction != SpindleDirection::stopped);
      break;
    case LinuxcncValue::spindle_clockwise:
      value = flag_value(modal.spindle_direction == SpindleDirection::cw);
      break;
    case LinuxcncValue::feed:
      value = modal.feed_mode == FeedMode::inverse_time ? modal.feed : in_program_units(X, modal.feed);
      break;
    case LinuxcncValue::speed:
      value = surface ? modal.surface_speed : modal.spindle_speed;
      break;
    case LinuxcncValue::selected_tool:
      value = modal.selected_tool;
      break;
    default:
      return AlarmNumber::linuxcnc_parameter_unavailable;
  }
  return AlarmNumber::none;
}

}  // namespace trunnion::language
