// SPDX-License-Identifier: Apache-2.0
#include "language/program_state.hpp"

namespace trunnion::language {

// A cycle takes over the words of the one before (Fanuc B-64484EN-2, 5.1), and comes back to the level before
// the first of them. A peck of drilling is none of tapping, nor a shift.
void CycleWords::begin(std::uint8_t before, std::uint8_t cycle, double level) {
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
  const double z = tool_length_in_z();
  command.target[Z] += z;
  if (command.kind != CommandKind::arc) return;
  Arc& arc = command.arc;
  const AxisValues centre =
      frame().command_from_contour({arc.centre[0], arc.centre[1], arc.centre[2], 0, 0, 0, 0, 0, 0});
  arc.centre = {centre[X], centre[Y], centre[Z] + z};
  if (!frame().tilt().active) return;
  Vector3 normal{};
  normal[plane_axes(arc.plane).normal] = 1;
  arc.normal = frame().turned_by_tilt(normal);
}

void ProgramState::locate(const AxisValues& command) {
  position = command;
  AxisValues tip = command;
  tip[Z] -= tool_length_in_z();
  program_position = frame().program_from_contour(frame().contour_from_command(tip));
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
  command[Z] += tool_length_in_z();
  return command;
}

}  // namespace trunnion::language
