// SPDX-License-Identifier: Apache-2.0
#include "language/command_output.hpp"

#include <cmath>
#include <utility>

#include "canonical/turning_speed.hpp"
#include "language/turned_move.hpp"

namespace trunnion::language {

void CommandOutput::start() {
  kept_revision_.reset();
  compensation_.reset();
  compensation_.configure(environment_.cutter_settings());
  sequence_ = 0;
  corner_.reset();
  draining_ = held_too_many_ = false;
  lost_ = AlarmNumber::none;
}

void CommandOutput::discard() {
  held_too_many_ = draining_ = false;
  lost_ = AlarmNumber::none;
  corner_.reset();
  queue_->clear();
}

Fault CommandOutput::check_room() {
  if (lost_ != AlarmNumber::none) return {std::exchange(lost_, AlarmNumber::none), 0};
  if (!held_too_many_) return {};
  held_too_many_ = false;
  return {AlarmNumber::compensation_look_ahead, 0};
}

Fault CommandOutput::settle() {
  if (const Fault fault = check_room()) return fault;
  return drain();
}

void CommandOutput::drop_compensation() {
  compensation_.reset();
  state_.modal.cutter_side = CutterSide::off;
}

// The tool stays where the compensation has brought it: there the position ends too.
Fault CommandOutput::push_end(std::uint32_t number) {
  if (compensation_.active()) {
    if (const AlarmNumber alarm = compensation_.finish(); alarm != AlarmNumber::none) return {alarm, 0};
  }
  push(CommandKind::end).number = number;
  return {};
}

ModalState CommandOutput::command_modal() {
  const ProgramFrame& frame = state_.frame();
  if (kept_revision_ != frame.revision()) {
    kept_revision_ = frame.revision();
    state_.modal.frame = ++frame_number_;
    kept_[frame_number_ % frames_kept] = frame;
  }
  ModalState modal = state_.modal;
  if (exact_stop_once_) modal.path_control = PathControl::exact_stop;
  if ((modal.suppressed & canonical::no_exact_stop) != 0) modal.path_control = PathControl::continuous;
  return modal;
}

Command& CommandOutput::push(CommandKind kind) {
  lose_corner();
  const bool held = compensation_.active();
  Command* place = held ? compensation_.add_at_rest() : &queue_->push();
  if (place == nullptr) {
    held_too_many_ = true;
    place = &scratch_;
  }
  moves_ |= kind == CommandKind::rapid || kind == CommandKind::line || kind == CommandKind::arc ||
            kind == CommandKind::skip || kind == CommandKind::tap || kind == CommandKind::thread;
  Command& command = *place;
  command = Command{};
  command.kind = kind;
  command.program = program_;
  command.line = line_;
  command.sequence = held ? 0 : ++sequence_;
  command.target = state_.position;
  command.modal = command_modal();
  return command;
}

bool CommandOutput::moves_to(const AxisValues& command, bool& linear) const {
  linear = false;
  bool rotary = false;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    const bool moves = std::abs(command[axis] - state_.position[axis]) > no_distance;
    (is_rotary(axis) ? rotary : linear) |= moves;
  }
  return linear || rotary;
}

bool CommandOutput::turns_in_plane(const AxisValues& command) const {
  if (!state_.modal.plane_only) return false;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (is_rotary(axis) && std::abs(command[axis] - state_.position[axis]) > no_distance) return true;
  return false;
}

Fault CommandOutput::move_straight(const StraightMove& move, const AxisValues& program) {
  const AxisValues target = state_.command_from_program(program);
  bool linear = false;
  const bool moves = moves_to(target, linear);
  if (turns_in_plane(target)) return {AlarmNumber::plane_rotary, 0};
  if (compensation_.active()) {
    if (!moves) {
      state_.program_position = program;
      return {};
    }
    Command command;
    command.kind = move.kind;
    return move_compensated(command, program);
  }
  const AxisValues start = state_.position;
  state_.reach(moves ? target : start, program);
  if (!moves) return {};
  if (move.kind == CommandKind::line && !move.chord && linear) push_turned_pieces(start);
  Command& command = push(move.kind);
  command.chord = move.chord;
  if (move.chord) command.modal.path_control = PathControl::continuous;
  command.number = move.number;
  command.value = move.value;
  command.lead_change = move.lead_change;
  command.start_angle = move.start_angle;
  command.spindle_speed = move.spindle_speed;
  command.hole_speed = move.hole_speed;
  command.out = move.out;
  if (move.kind != CommandKind::rapid && !linear && state_.modal.feed_mode != FeedMode::inverse_time) {
    command.modal.feed /= state_.modal.metric ? 1.0 : 25.4;
  }
  return {};
}

void CommandOutput::push_turned_pieces(const AxisValues& start) {
  const ModalState& modal = state_.modal;
  if (modal.spindle_mode != SpindleMode::surface || modal.feed_mode != FeedMode::per_revolution) return;
  const double limit = canonical::lower_limit(modal.spindle_limit, environment_.highest_spindle_speed());
  if (!(limit > 0) || !queue_->has_room_for(Divisions::most)) return;
  const double centre = state_.frame().total_offset()[X];
  const Divisions divisions = divide_turned_move(start[X] - centre, state_.position[X] - centre,
                                                 canonical::radius_of_limit(modal.surface_speed, limit));
  for (std::size_t i = 0; i < divisions.count; ++i) {
    Command& piece = push(CommandKind::line);
    for (std::size_t axis = 0; axis < axis_count; ++axis)
      piece.target[axis] = start[axis] + divisions.share[i] * (state_.position[axis] - start[axis]);
    piece.modal.path_control = PathControl::continuous;
  }
}

Fault CommandOutput::move_straight_in_command_frame(CommandKind kind, const AxisValues& command) {
  bool linear = false;
  if (!moves_to(command, linear)) return {};
  state_.locate(command);
  Command& made = push(kind);
  if (kind == CommandKind::line && !linear && state_.modal.feed_mode != FeedMode::inverse_time) {
    made.modal.feed /= state_.modal.metric ? 1.0 : 25.4;
  }
  return {};
}

// Held moves are in contour coordinates until the compensation lets go of them.
Fault CommandOutput::move_compensated(const Command& move, const AxisValues& program) {
  if (lose_corner()) return {};
  if (state_.modal.transformation == Transformation::rtcp) {
    for (const Axis axis : {A, B, C}) {
      if (std::abs(program[axis] - state_.program_position[axis]) > no_distance) {
        return {AlarmNumber::compensation_rotary, 0};
      }
    }
  }
  const AxisValues start = state_.frame().contour_from_program(state_.program_position);
  return give(contour_move(move, program), start);
}

Command CommandOutput::contour_move(const Command& move, const AxisValues& program) {
  moves_ = true;
  Command command = move;
  command.program = program_;
  command.line = line_;
  command.target = state_.frame().contour_from_program(program);
  command.modal = command_modal();
  state_.reach(state_.command_from_program(program), program);
  return command;
}

// In contour coordinates.
Fault CommandOutput::give(Command command, const AxisValues& start) {
  if (compensation_.active())
    return {compensation_.add(command, start, state_.frame().flips(state_.modal.plane)), 0};
  state_.to_command_frame(command);
  command.sequence = ++sequence_;
  queue_->push() = command;
  return {};
}

bool CommandOutput::lose_corner() {
  if (!corner_ && !state_.line_open) return false;
  lost_ = state_.line_open ? AlarmNumber::angle_open : AlarmNumber::corner_without_move;
  corner_.reset();
  state_.line_open = false;
  return true;
}

Fault CommandOutput::move_with_corner(const Command& move, const AxisValues& program,
                                      const std::optional<Corner>& corner) {
  AxisValues start = state_.frame().contour_from_program(state_.program_position);
  Command command = contour_move(move, program);
  const PlaneAxes plane = plane_axes(command.modal.plane);
  const Vector2 way = in_plane(command.target, plane) - in_plane(start, plane);
  bool plain = move.kind == CommandKind::arc || length(way) > no_distance;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    plain = plain && (axis == plane.first || axis == plane.second ||
                      std::abs(command.target[axis] - start[axis]) <= no_distance);
  if (!plain) return {AlarmNumber::corner_without_move, 0};
  if (corner_) {
    if (const Fault fault = end_corner(command, start)) return fault;
  }
  const bool used_up = !(planar_piece(command, start, plane).length() > no_distance);
  if (!corner) return used_up ? Fault{} : give(command, start);
  corner_ = HeldCorner{command, start, *corner, compensation_.side(), state_.frame().revision()};
  return {};
}

// `move`, from `start`, begins where the corner ends.
Fault CommandOutput::end_corner(Command& move, AxisValues& start) {
  HeldCorner held = *corner_;
  corner_.reset();
  if (held.move.modal.plane != move.modal.plane || held.frame != state_.frame().revision() ||
      held.side != compensation_.side())
    return {AlarmNumber::corner_without_move, 0};
  const PlaneAxes plane = plane_axes(move.modal.plane);
  const PlanarPiece first = planar_piece(held.move, held.start, plane),
                    second = planar_piece(move, start, plane);
  const CutCorner cut = cut_corner(first, second, held.corner);
  if (cut.alarm != AlarmNumber::none) {
    corner_measures_ = {held.move.line, held.corner.size, first.length(), second.length()};
    return {cut.alarm, 0};
  }
  Command between = held.move;
  const AxisValues corner = held.move.target;
  const auto shape = [&](Command& command, const PlanarPiece& piece, const AxisValues& from) {
    command.kind = piece.arc ? CommandKind::arc : CommandKind::line;
    command.target = corner;
    command.target[plane.first] = piece.end.u, command.target[plane.second] = piece.end.v;
    if (!piece.arc) return;
    command.arc = {move.modal.plane,
                   piece.sweep < 0,
                   {from[X], from[Y], from[Z]},
                   std::abs(piece.sweep) * degrees_per_radian,
                   {}};
    command.arc.centre[plane.first] = piece.centre.u, command.arc.centre[plane.second] = piece.centre.v;
  };
  const AxisValues end = move.target;
  shape(held.move, cut.first, held.start);
  if (cut.first.length() > no_distance) {
    if (const Fault fault = give(held.move, held.start)) return fault;
  }
  if (!cut.inserted) return {};
  shape(between, cut.between, held.move.target);
  if (const Fault fault = give(between, held.move.target)) return fault;
  start = between.target;
  shape(move, cut.second, start);
  move.target = end;
  return {};
}

Fault CommandOutput::drain() {
  if (!compensation_.active()) return {};
  Command command;
  for (bool popped = true; popped;) {
    draining_ = queue_->crowded();
    if (draining_) return {};
    if (const AlarmNumber alarm = compensation_.pop(command, popped); alarm != AlarmNumber::none) {
      return {alarm, 0};
    }
    if (!popped) break;
    state_.to_command_frame(command);
    command.sequence = ++sequence_;
    queue_->push() = command;
    if (command.kind == CommandKind::end) {
      drop_compensation();
      state_.locate(command.target);
      return {};
    }
  }
  return {};
}

}  // namespace trunnion::language
