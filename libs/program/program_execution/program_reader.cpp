// SPDX-License-Identifier: Apache-2.0
#include "program_execution/program_reader.hpp"

#include "canonical/macro_signal.hpp"
#include "canonical/spindle_value.hpp"
#include "language/codes.hpp"

namespace trunnion::program_execution {

using language::Command;
using language::CommandKind;

ProgramReader::ProgramReader(channel_setup::ChannelSetup& machine, const ReadingOptions& options,
                             ProgramMotion* motion)
    : environment_(machine),
      machine_(&machine),
      options_(options),
      flow_(machine, {options.block_skip, false, true}),
      motionless_(machine.limits(), machine.cycle_seconds()),
      motion_(motion != nullptr ? motion : &motionless_),
      loop_(true, options.most_returns) {}

// Where nothing limits the travel the axes may move on and on.
ProgramReader::ProgramReader(language::Environment& environment, const ReadingOptions& options)
    : environment_(environment),
      options_(options),
      flow_(environment, {options.block_skip, false, true}),
      motion_(&motionless_),
      loop_(false, options.most_returns) {}

Ending ProgramReader::read(language::TextSource& text, const AxisValues& start) {
  from_ = start;
  flow_.set_guard(options_.guard);
  flow_.watch_blocks(options_.watch);
  flow_.watch_loops(options_.find_repetition ? &loop_ : nullptr);
  flow_.on_move = [this](const Command& move) { pass(flow_.pending(), move); };
  motion_->moves().start(start, transformation_, tool_length_);
  flow_.start(motion_->moves(), text, start, environment_.power_on(), language::no_variables);
  std::optional<Ending> ending;
  while (!ending) ending = turn();
  return *ending;
}

std::optional<Ending> ProgramReader::turn() {
  motion_->prepare(flow_, tapping_.active());
  const auto state = skip_on_its_way_ || read_on_its_way_ ? FlowState::full : flow_.fill(false);
  if (state != FlowState::waiting && !motion_->at_rest()) {
    if (!motion_->step()) return Ending::stopped;
    return std::nullopt;
  }
  if (stop && stop()) return Ending::stopped;
  if (state != FlowState::waiting) return go_on_at_rest(state);
  if (flow_.text_missing()) return Ending::text_missing;
  return std::nullopt;
}

// As ChannelCore::run_pending.
std::optional<Ending> ProgramReader::go_on_at_rest(FlowState state) {
  if (skip_on_its_way_) {
    skip_on_its_way_ = false;
    flow_.skip_ended({motion_->position(), motion_->position()});
    return std::nullopt;
  }
  if (read_on_its_way_) {
    if (++reads_ > options_.most_idle_reads) return Ending::idle;
    answer_read();
    return std::nullopt;
  }
  if (tapping_.active()) {
    end_tapping();
    return std::nullopt;
  }
  switch (state) {
    case FlowState::alarm:
      return Ending::alarm;
    case FlowState::end:
      if (loop_.line() != 0) return loop_.gave_up() ? Ending::returns : Ending::repeats;
      if (flow_.pending().kind == CommandKind::end) pass(flow_.pending(), flow_.pending());
      return Ending::end;
    case FlowState::loop:
      if (flow_.lines_without_motion() > options_.most_idle_lines) return Ending::idle;
      flow_.read_on();
      return std::nullopt;
    case FlowState::command:
      return take(flow_.pending());
    default:
      return std::nullopt;
  }
}

// As ChannelCore::execute, with every answer at once.
std::optional<Ending> ProgramReader::take(const Command& command) {
  switch (command.kind) {
    case CommandKind::end:
      pass(command, command);
      return Ending::end;
    case CommandKind::skip:
      skip_on_its_way_ = flow_.push_pending() != FlowState::alarm;
      return std::nullopt;
    case CommandKind::read:
      read_on_its_way_ = flow_.push_pending() != FlowState::alarm;
      return std::nullopt;
    case CommandKind::tap:
      begin_tapping(command);
      return std::nullopt;
    case CommandKind::cycle:
      pass(command, command);
      flow_.cycle_answered(0);
      return std::nullopt;
    case CommandKind::home:
      motion_->moves().start(command.target, transformation_, tool_length_);
      pass(command, command);
      flow_.home_ended(command.target);
      return std::nullopt;
    case CommandKind::transformation:
      transformation_ = command.modal.transformation;
      tool_length_ = command.modal.tool_length;
      motion_->moves().start(command.target, transformation_, tool_length_);
      break;
    default:
      // What the PLC has done is not undone by going back: the path begins anew behind it.
      if (language::changes_machine(command))
        motion_->moves().start(motion_->position(), transformation_, tool_length_);
      break;
  }
  pass(command, command);
  flow_.finish_pending();
  return std::nullopt;
}

// So that programs that wait for it go on: for a signal of the PLC, whichever value it is to have.
void ProgramReader::answer_read() {
  read_on_its_way_ = false;
  const auto number = flow_.pending().number;
  if (canonical::is_macro_signal(number)) {
    constexpr std::uint16_t every = 0xffff;
    flow_.value_read(reads_ % 2 == 0 ? canonical::macro_value(number, every) : 0);
    return;
  }
  const auto value = canonical::read_value(number);
  const bool holds =
      value == canonical::SpindleValue::homed || value == canonical::SpindleValue::synchronized;
  flow_.value_read(holds ? 1 : 0);
}

void ProgramReader::begin_tapping(const Command& stroke) {
  if (machine_ != nullptr) {
    const auto& spindle = machine_->tapping_spindle(stroke.number);
    if (!spindle.axis) return flow_.refuse_pending(language::AlarmNumber::tapping_spindle_missing);
    tapping_.begin(motion_->position(), stroke);
    const double speed = Tapping::fastest(stroke, spindle.highest_speed);
    motion_->set_limits(tapping_.limits(machine_->limits(), spindle.acceleration_up_to(speed)));
  } else {
    tapping_.begin(motion_->position(), stroke);
  }
  motion_->moves().start(motion_->position(), transformation_, tool_length_);
  flow_.set_tapping(true);
}

void ProgramReader::end_tapping() {
  tapping_.end();
  if (machine_ != nullptr) motion_->set_limits(machine_->limits());
  motion_->moves().start(motion_->position(), transformation_, tool_length_);
  flow_.set_tapping(false);
}

void ProgramReader::pass(const Command& command, const Command& move) {
  if (on_command) on_command(command, move);
  switch (command.kind) {
    case CommandKind::rapid:
    case CommandKind::line:
    case CommandKind::arc:
    case CommandKind::skip:
    case CommandKind::tap:
    case CommandKind::thread:
    case CommandKind::transformation:
    case CommandKind::home:
      from_ = command.target;
      reads_ = 0;
      break;
    default:
      break;
  }
}

}  // namespace trunnion::program_execution
