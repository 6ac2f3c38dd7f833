// SPDX-License-Identifier: Apache-2.0
#include "language/program_state.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::language {
namespace {

constexpr std::uint16_t rotary_letters = (1u << A) | (1u << B) | (1u << C);
constexpr std::array rotary_axes = {A, B, C, U, V, W};  // U V W may turn the tool, too

}  // namespace

// A cycle takes over the words of the one before (Fanuc B-64484EN-2, 5.1), and comes back to the level before
// the first of them. A peck of drilling is none of tapping, nor a shift.
void CycleWords::begin(std::uint8_t before, std::uint8_t cycle, double level) {
  hole.linuxcnc = false;
  if (before == 80) {
    *this = CycleWords{};
    hole.initial = level;
  } else if (is_tapping(before) != is_tapping(cycle) || is_shifting(before) != is_shifting(cycle)) {
    hole.peck = hole.reduction = hole.least_peck = hole.between_outs = 0;
    retract_multiple = 1;
    has_q = false;
    shift = {};
    tapping_axis = 0;
  }
}

ProgramSettings& ProgramState::change_settings() {
  if (settings_place == saved_.settings_place) {
    settings_place ^= 1u;
    settings_[settings_place] = settings_[saved_.settings_place];
  }
  return settings_[settings_place];
}

AxisValues ProgramState::machine_position(const Environment& environment) const {
  return modal.transformation == Transformation::rtcp
             ? environment.machine_from_tip(position, modal.tool_length)
             : position;
}

AxisValues ProgramState::workpiece_position() const {
  AxisValues tip = position;
  tip[Z] -= tool_length_in_z();
  return frame().workpiece_from_command(tip);
}

void ProgramState::to_command_frame(Command& command) const {
  if (command.kind == CommandKind::table) return;  // its target is a row of the table
  command.target = frame().command_from_contour(command.target);
  if (frame().setting_error().number != 0) set_up_tool(command.target);
  const double z = tool_length_in_z();
  command.target[Z] += z;
  if (command.kind != CommandKind::arc) return;
  Arc& arc = command.arc;
  const AxisValues centre =
      frame().command_from_contour({arc.centre[0], arc.centre[1], arc.centre[2], 0, 0, 0, 0, 0, 0});
  arc.centre = {centre[X], centre[Y], centre[Z] + z};
  if (!frame().turns()) return;
  Vector3 normal{};
  normal[plane_axes(arc.plane).normal] = 1;
  arc.normal = frame().turned(normal);
}

void ProgramState::locate(const AxisValues& command) {
  if (frame().setting_error().number != 0) keep_drawn(command);
  position = command;
  AxisValues tip = command;
  if (frame().setting_error().number != 0)
    for (const Axis axis : rotary_axes) tip[axis] = settings().drawn_rotary[axis];
  tip[Z] -= tool_length_in_z();
  program_position = frame().program_from_contour(frame().contour_from_command(tip));
}

void ProgramState::reach(const AxisValues& command, const AxisValues& program) {
  position = command;
  program_position = program;
  if (frame().setting_error().number == 0) return;
  change_settings().drawn_rotary = frame().command_from_contour(frame().contour_from_program(program));
}

void ProgramState::set_setting_error(std::uint8_t number, const AxisValues& values) {
  if (frame().setting_error().number == 0) change_settings().drawn_rotary = position;
  change_frame().set_setting_error(number, values);
  locate(position);
}

bool ProgramState::sets_up_tool() const {
  return modal.transformation == Transformation::rtcp && (environment_.axes() & rotary_letters) != 0;
}

// From the tip to the spindle. A long tool leaves little of the rounding of positions.
Vector3 ProgramState::tool_direction(const AxisValues& rotary) const {
  constexpr double long_tool = 1000;  // mm
  const AxisValues gauge = environment_.tip_from_machine(rotary, 0);
  const AxisValues tip = environment_.tip_from_machine(rotary, long_tool);
  Vector3 direction{gauge[X] - tip[X], gauge[Y] - tip[Y], gauge[Z] - tip[Z]};
  const double size = std::hypot(direction[0], direction[1], direction[2]);
  if (!(size > 0)) return {0, 0, 1};
  for (double& component : direction) component /= size;
  return direction;
}

// Of the solutions the one that is nearest to the words. Without tool tip control the workpiece stands as the
// table does, which is known for the table at zero alone.
void ProgramState::set_up_tool(AxisValues& command) const {
  if (!sets_up_tool()) {
    const bool turned = std::any_of(rotary_axes.begin(), rotary_axes.end(),
                                    [&](Axis axis) { return is_rotary(axis) && command[axis] != 0; });
    if (turned && modal.transformation == Transformation::none)
      setting_fault_ = AlarmNumber::tip_control_needed;
    return;
  }
  const Vector3 direction = language::turned(frame().setting_error().matrix, tool_direction(command));
  const auto solved = environment_.orient(direction, command, RotaryChoice::continuous);
  if (!solved) {
    setting_fault_ = AlarmNumber::orientation_impossible;
    return;
  }
  for (const Axis axis : rotary_axes) command[axis] = (*solved)[axis];
}

// Where the rotary axes have not moved, the words are those of before.
void ProgramState::keep_drawn(const AxisValues& command) {
  const bool moved = std::any_of(rotary_axes.begin(), rotary_axes.end(),
                                 [&](Axis axis) { return command[axis] != position[axis]; });
  if (!moved) return;
  AxisValues drawn = command;
  if (sets_up_tool()) {
    const Vector3 direction = language::turned_back(frame().setting_error().matrix, tool_direction(command));
    drawn = environment_.orient(direction, command, RotaryChoice::continuous).value_or(command);
  }
  change_settings().drawn_rotary = drawn;
}

AxisValues ProgramState::command_from_program(const AxisValues& program) const {
  AxisValues command = program;
  const ProgramFrame& frame = this->frame();
  if (frame.plain()) {
    const AxisValues& offset = frame.total_offset();
    for (std::size_t axis = 0; axis < axis_count; ++axis) {
      // An axis that stays keeps its number bit for bit.
      if (program[axis] == program_position[axis]) {
        command[axis] = position[axis];
      } else {
        command[axis] += offset[axis];
        if (axis == Z) command[axis] += tool_length_in_z();
      }
    }
    return command;
  }
  command = frame.command_from_contour(frame.contour_from_program(program));
  if (frame.setting_error().number != 0) set_up_tool(command);
  command[Z] += tool_length_in_z();
  return command;
}

}  // namespace trunnion::language
