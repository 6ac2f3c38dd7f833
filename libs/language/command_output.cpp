// SPDX-License-Identifier: Apache-2.0
#include "language/command_output.hpp"

#include <cmath>

namespace trunnion::language {
namespace {

/// A move shorter than this (mm, degrees) on every axis is rounding, not motion.
constexpr double no_distance = 1e-9;

}  // namespace

void CommandOutput::start() {
  kept_revision_.reset();
  compensation_.reset();
  compensation_.configure(environment_.cutter_settings());
  sequence_ = 0;
  draining_ = held_too_many_ = false;
}

void CommandOutput::discard() {
  held_too_many_ = draining_ = false;
  queue_->clear();
}

Fault CommandOutput::check_room() {
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
  return modal;
}

Command& CommandOutput::push(CommandKind kind) {
  const bool held = compensation_.active();
  Command* place = held ? compensation_.add_at_rest() : &queue_->push();
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

Fault CommandOutput::move_straight(const StraightMove& move, const AxisValues& program) {
  const AxisValues target = state_.command_from_program(program);
  bool linear = false;
  const bool moves = moves_to(target, linear);
  if (compensation_.active()) {
    if (!moves) {
      state_.program_position = program;
      return {};
    }
    Command command;
    command.kind = move.kind;
    return move_compensated(command, program);
  }
  state_.program_position = program;
  if (!moves) return {};
  state_.position = target;
  Command& command = push(move.kind);
  command.chord = move.chord;
  if (move.chord) command.modal.path_control = PathControl::continuous;
  command.number = move.number;
  command.value = move.value;
  if (move.kind != CommandKind::rapid && !linear && state_.modal.feed_mode != FeedMode::inverse_time) {
    command.modal.feed /= state_.modal.metric ? 1.0 : 25.4;
  }
  return {};
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
  if (state_.modal.transformation == Transformation::rtcp) {
    for (const Axis axis : {A, B, C}) {
      if (std::abs(program[axis] - state_.program_position[axis]) > no_distance) {
        return {AlarmNumber::compensation_rotary, 0};
      }
    }
  }
  const AxisValues start = state_.frame().contour_from_program(state_.program_position);
  moves_ = true;
  Command command = move;
  command.program = program_;
  command.line = line_;
  command.target = state_.frame().contour_from_program(program);
  command.modal = command_modal();
  state_.position = state_.command_from_program(program);
  state_.program_position = program;
  return {compensation_.add(command, start, state_.frame().flips(state_.modal.plane)), 0};
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
