// The part of BlockExecutor that hands commands on and knows where they lead.
#include "language/block_executor.hpp"

namespace trunnion::language {

void BlockExecutor::set_position(const AxisValues& position) {
  if (compensation_.active()) {
    compensation_.reset();
    modal_.cutter_side = CutterSide::off;
  }
  needs_position_ = false;
  locate(position);
}

AxisValues BlockExecutor::machine_position() const {
  return modal_.transformation == Transformation::rtcp
             ? environment_.machine_from_tip(position_, modal_.tool_length)
             : position_;
}

AxisValues BlockExecutor::workpiece_position() const {
  AxisValues tip = position_;
  tip[Z] -= tool_length_in_z();
  return frame_.workpiece_from_command(tip);
}

Fault BlockExecutor::end_program(std::uint32_t number, std::uint32_t program, std::uint32_t line,
                                 CommandQueue& out) {
  program_ = program;
  line_ = line;
  if (curve_.active()) return {AlarmNumber::curve_incomplete, 0};
  // Behind a line of manual data input the next one may hold the swing.
  const bool more = number == 0 && beginning_ == Beginning::line;
  if (swing_due_ && !more) return {AlarmNumber::tilt_swing_missing, 0};
  if (const Fault fault = push_end(number, out)) return fault;
  return drain_compensation(out);
}

// The tool stays where the compensation has brought it: there the position ends too.
Fault BlockExecutor::push_end(std::uint32_t number, CommandQueue& out) {
  if (compensation_.active()) {
    if (const AlarmNumber alarm = compensation_.finish(); alarm != AlarmNumber::none) return {alarm, 0};
  }
  push(CommandKind::end, out).number = number;
  return {};
}

Fault BlockExecutor::message(std::uint32_t number, std::uint32_t program, std::uint32_t line,
                             CommandQueue& out) {
  program_ = program;
  line_ = line;
  push(CommandKind::message, out).number = number;
  push(CommandKind::auxiliary, out).number = 0;
  return settle(out);
}

Fault BlockExecutor::settle(CommandQueue& out) {
  if (!held_too_many_) return drain_compensation(out);
  held_too_many_ = false;
  return {AlarmNumber::compensation_look_ahead, 0};
}

ModalState BlockExecutor::command_modal() {
  if (kept_revision_ != frame_.revision()) {
    kept_revision_ = frame_.revision();
    modal_.frame = ++frame_number_;
    kept_[frame_number_ % frames_kept] = frame_;
  }
  ModalState modal = modal_;
  if (exact_stop_once_) modal.path_control = PathControl::exact_stop;
  return modal;
}

Command& BlockExecutor::push(CommandKind kind, CommandQueue& out) {
  const bool held = compensation_.active();
  Command* place = held ? compensation_.add_standing() : &out.push();
  if (place == nullptr) {
    held_too_many_ = true;
    place = &scratch_;
  }
  moves_ |= kind == CommandKind::rapid || kind == CommandKind::line || kind == CommandKind::arc ||
            kind == CommandKind::skip || kind == CommandKind::tap;
  Command& command = *place;
  command = Command{};
  command.kind = kind;
  command.program = program_;
  command.line = line_;
  command.sequence = held ? 0 : ++sequence_;
  command.target = position_;
  command.modal = command_modal();
  return command;
}

Fault BlockExecutor::drain_compensation(CommandQueue& out) {
  if (!compensation_.active()) return {};
  Command command;
  for (bool popped = true; popped;) {
    draining_ = out.crowded();
    if (draining_) return {};
    if (const AlarmNumber alarm = compensation_.pop(command, popped); alarm != AlarmNumber::none) {
      return {alarm, 0};
    }
    if (!popped) break;
    to_command_frame(command);
    command.sequence = ++sequence_;
    out.push() = command;
    if (command.kind == CommandKind::end) {
      compensation_.reset();
      modal_.cutter_side = CutterSide::off;
      locate(command.target);
      return {};
    }
  }
  return {};
}

void BlockExecutor::to_command_frame(Command& command) const {
  if (command.kind == CommandKind::table) return;  // its target is a row of the table
  command.target = frame_.command_from_contour(command.target);
  const double z = tool_length_in_z();
  command.target[Z] += z;
  if (command.kind != CommandKind::arc) return;
  Arc& arc = command.arc;
  const AxisValues centre =
      frame_.command_from_contour({arc.centre[0], arc.centre[1], arc.centre[2], 0, 0, 0, 0, 0, 0});
  arc.centre = {centre[X], centre[Y], centre[Z] + z};
  if (!frame_.tilt().active) return;
  Vector3 normal{};
  normal[plane_axes(arc.plane).normal] = 1;
  arc.normal = frame_.turned_by_tilt(normal);
}

void BlockExecutor::locate(const AxisValues& position) {
  position_ = position;
  AxisValues tip = position;
  tip[Z] -= tool_length_in_z();
  program_position_ = frame_.program_from_contour(frame_.contour_from_command(tip));
}

AxisValues BlockExecutor::command_from_program(const AxisValues& program) const {
  AxisValues command = program;
  if (frame_.plain()) {
    const AxisValues& offset = frame_.total_offset();
    for (std::size_t axis = 0; axis < axis_count; ++axis) {
      // An axis that stays keeps its number bit for bit.
      if (program[axis] == program_position_[axis]) {
        command[axis] = position_[axis];
      } else {
        command[axis] += offset[axis];
        if (axis == Z) command[axis] += tool_length_in_z();
      }
    }
    return command;
  }
  command = frame_.command_from_contour(frame_.contour_from_program(program));
  command[Z] += tool_length_in_z();
  return command;
}

}  // namespace trunnion::language
