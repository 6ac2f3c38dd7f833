// SPDX-License-Identifier: Apache-2.0
// The parameters of the LinuxCNC dialect beside those that programs store what they like in.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "language/name_key.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

/// What a parameter shows. Lengths are mm or inch as the program has them, where nothing else is said.
enum class LinuxcncValue : std::uint8_t {
  absent,  ///< LinuxCNC has it, this control does not
  machine_position,
  skip_position,
  skip_touched,
  active_length,
  reference,         ///< mm
  second_reference,  ///< mm
  shift_active,
  shift,  ///< mm
  coordinate_system,
  work_offset,  ///< mm; 20 for each system: 9 axes, the rotation, nothing
  tool,
  tool_length,
  tool_diameter,
  position,
  line,
  motion_mode,
  plane,
  compensation,
  metric,
  imperial,
  absolute,
  incremental,
  inverse_time,
  per_minute,
  per_revolution,
  coordinate_code,
  length_on,
  retract_to_r,
  retract_to_old,
  speed_mode,
  surface_mode,
  centre_absolute,
  diameter_mode,
  radius_mode,
  spindle_on,
  spindle_clockwise,
  feed,
  speed,
  selected_tool,
  mist,
  flood,
  returned,
  has_returned,
  call_level,
  always_0,
  always_1,
};

/// #1 to #30 belong to the call, #31 to #5000 to all programs: those are the variables #50030 to #54999 of
/// the other dialects.
inline constexpr std::uint32_t last_call_parameter = 30, last_user_parameter = 5000;
inline constexpr std::uint32_t user_parameter_distance = 49999;

struct NumberedParameter {
  std::uint16_t first;
  std::uint16_t last;
  LinuxcncValue value;
  const char* meaning;
};
inline constexpr std::array numbered_parameters = {
    NumberedParameter{5021, 5029, LinuxcncValue::machine_position, "machine coordinates X Y Z A B C U V W"},
    NumberedParameter{5061, 5069, LinuxcncValue::skip_position, "where the newest G38 touched"},
    NumberedParameter{5070, 5070, LinuxcncValue::skip_touched, "1 = it touched"},
    NumberedParameter{5081, 5089, LinuxcncValue::active_length, "active tool length by axis: 5083"},
    NumberedParameter{5161, 5169, LinuxcncValue::reference, "position of G28, machine coordinates, mm"},
    NumberedParameter{5181, 5189, LinuxcncValue::second_reference, "position of G30, likewise"},
    NumberedParameter{5210, 5210, LinuxcncValue::shift_active, "1 = G52 or G92 acts"},
    NumberedParameter{5211, 5219, LinuxcncValue::shift, "shift of G52 and G92, mm"},
    NumberedParameter{5220, 5220, LinuxcncValue::coordinate_system, "1 to 9: G54 to G59.3"},
    NumberedParameter{5221, 5390, LinuxcncValue::work_offset,
                      "work offsets, mm: 5221 X of G54, 5241 of G55 .. 5381 of G59.3"},
    NumberedParameter{5399, 5399, LinuxcncValue::absent, "input of M66"},
    NumberedParameter{5400, 5400, LinuxcncValue::tool, "tool in the spindle"},
    NumberedParameter{5401, 5409, LinuxcncValue::tool_length, "its length by axis: 5403"},
    NumberedParameter{5410, 5410, LinuxcncValue::tool_diameter, "its diameter"},
    NumberedParameter{5411, 5413, LinuxcncValue::absent, "angles and orientation of a lathe tool"},
    NumberedParameter{5420, 5428, LinuxcncValue::position, "position in program coordinates"},
    NumberedParameter{5599, 5599, LinuxcncValue::always_1, "1: (DEBUG,) is shown"},
};

struct PredefinedParameter {
  const char* name;
  LinuxcncValue value;
  std::uint8_t index;
  const char* meaning;
};
inline constexpr std::array predefined_parameters = {
    PredefinedParameter{"_x", LinuxcncValue::position, 0, "position in program coordinates"},
    PredefinedParameter{"_y", LinuxcncValue::position, 1, ""},
    PredefinedParameter{"_z", LinuxcncValue::position, 2, ""},
    PredefinedParameter{"_a", LinuxcncValue::position, 3, ""},
    PredefinedParameter{"_b", LinuxcncValue::position, 4, ""},
    PredefinedParameter{"_c", LinuxcncValue::position, 5, ""},
    PredefinedParameter{"_u", LinuxcncValue::position, 6, ""},
    PredefinedParameter{"_v", LinuxcncValue::position, 7, ""},
    PredefinedParameter{"_w", LinuxcncValue::position, 8, ""},
    PredefinedParameter{"_abs_x", LinuxcncValue::machine_position, 0, "machine coordinates"},
    PredefinedParameter{"_abs_y", LinuxcncValue::machine_position, 1, ""},
    PredefinedParameter{"_abs_z", LinuxcncValue::machine_position, 2, ""},
    PredefinedParameter{"_abs_a", LinuxcncValue::machine_position, 3, ""},
    PredefinedParameter{"_abs_b", LinuxcncValue::machine_position, 4, ""},
    PredefinedParameter{"_abs_c", LinuxcncValue::machine_position, 5, ""},
    PredefinedParameter{"_abs_u", LinuxcncValue::machine_position, 6, ""},
    PredefinedParameter{"_abs_v", LinuxcncValue::machine_position, 7, ""},
    PredefinedParameter{"_abs_w", LinuxcncValue::machine_position, 8, ""},
    PredefinedParameter{"_line", LinuxcncValue::line, 0, "line of its file"},
    PredefinedParameter{"_motion_mode", LinuxcncValue::motion_mode, 0, "active motion code, ten times"},
    PredefinedParameter{"_plane", LinuxcncValue::plane, 0, "170, 180 or 190"},
    PredefinedParameter{"_ccomp", LinuxcncValue::compensation, 0, "400, 410 or 420"},
    PredefinedParameter{"_metric", LinuxcncValue::metric, 0, "1: G21"},
    PredefinedParameter{"_imperial", LinuxcncValue::imperial, 0, "1: G20"},
    PredefinedParameter{"_absolute", LinuxcncValue::absolute, 0, "1: G90"},
    PredefinedParameter{"_incremental", LinuxcncValue::incremental, 0, "1: G91"},
    PredefinedParameter{"_inverse_time", LinuxcncValue::inverse_time, 0, "1: G93"},
    PredefinedParameter{"_units_per_minute", LinuxcncValue::per_minute, 0, "1: G94"},
    PredefinedParameter{"_units_per_rev", LinuxcncValue::per_revolution, 0, "1: G95"},
    PredefinedParameter{"_coord_system", LinuxcncValue::coordinate_code, 0, "540 to 593"},
    PredefinedParameter{"_tool_offset", LinuxcncValue::length_on, 0, "1: G43"},
    PredefinedParameter{"_retract_r_plane", LinuxcncValue::retract_to_r, 0, "1: G99"},
    PredefinedParameter{"_retract_old_z", LinuxcncValue::retract_to_old, 0, "1: G98"},
    PredefinedParameter{"_spindle_rpm_mode", LinuxcncValue::speed_mode, 0, "1: G97"},
    PredefinedParameter{"_spindle_css_mode", LinuxcncValue::surface_mode, 0, "1: G96"},
    PredefinedParameter{"_ijk_absolute_mode", LinuxcncValue::centre_absolute, 0, "1: G90.1"},
    PredefinedParameter{"_lathe_diameter_mode", LinuxcncValue::diameter_mode, 0, "1: G7"},
    PredefinedParameter{"_lathe_radius_mode", LinuxcncValue::radius_mode, 0, "1: G8"},
    PredefinedParameter{"_spindle_on", LinuxcncValue::spindle_on, 0, "1: M3 or M4"},
    PredefinedParameter{"_spindle_cw", LinuxcncValue::spindle_clockwise, 0, "1: M3"},
    PredefinedParameter{"_feed", LinuxcncValue::feed, 0, "F"},
    PredefinedParameter{"_rpm", LinuxcncValue::speed, 0, "S"},
    PredefinedParameter{"_current_tool", LinuxcncValue::tool, 0, "tool in the spindle"},
    PredefinedParameter{"_selected_tool", LinuxcncValue::selected_tool, 0, "T"},
    PredefinedParameter{"_value", LinuxcncValue::returned, 0, "what the newest subroutine has returned"},
    PredefinedParameter{"_value_returned", LinuxcncValue::has_returned, 0, "1: it has returned something"},
    PredefinedParameter{"_call_level", LinuxcncValue::call_level, 0, "calls inside each other"},
    PredefinedParameter{"_task", LinuxcncValue::always_1, 0, "1: the program is not only drawn"},
    PredefinedParameter{"_feed_override", LinuxcncValue::always_1, 0, "1: the feed override acts"},
    PredefinedParameter{"_speed_override", LinuxcncValue::always_1, 0, "1: the spindle override acts"},
    PredefinedParameter{"_feed_hold", LinuxcncValue::always_1, 0, "1: feed hold acts"},
    PredefinedParameter{"_adaptive_feed", LinuxcncValue::always_0, 0, "1: adaptive feed acts"},
    PredefinedParameter{"_remap_level", LinuxcncValue::always_0, 0, "depth of remapped codes"},
    PredefinedParameter{"_mist", LinuxcncValue::mist, 0, "1: M7 of this program"},
    PredefinedParameter{"_flood", LinuxcncValue::flood, 0, "1: M8 of this program"},
    PredefinedParameter{"_vmajor", LinuxcncValue::absent, 0, ""},
    PredefinedParameter{"_vminor", LinuxcncValue::absent, 0, ""},
    PredefinedParameter{"_current_pocket", LinuxcncValue::absent, 0, ""},
    PredefinedParameter{"_selected_pocket", LinuxcncValue::absent, 0, ""},
};

/// Null when LinuxCNC predefines no such name.
const PredefinedParameter* predefined_parameter(NameKey name);
/// Null when there is no parameter of that number, or it is one that programs store in.
const NumberedParameter* numbered_parameter(std::uint32_t number);

}  // namespace trunnion::language
