// SPDX-License-Identifier: Apache-2.0
// What a program asks of the rest of the control while the axes are at rest: the PLC, the tables, the
// operator, the services that carry out cycles.
#include <algorithm>
#include <cmath>

#include "canonical/turning_speed.hpp"
#include "channel_core.hpp"
#include "language/codes.hpp"
#include "language/macro_call.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/print_file.hpp"
#include "machine/roles.hpp"

namespace trunnion::channel {

using program_execution::AuxiliaryKind;

namespace {
constexpr std::uint32_t program_stop = 0, optional_stop = 1, tool_change = 6;  // M0, M1, M6
// Results of measuring programs, docs/calibration-programs.md; the last one says that they are complete.
constexpr std::uint32_t first_user = 50000, first_result = 52150, last_result = 52199,
                        complete_result = 52999;

CycleRequest cycle_request(const language::Command& command, const ProgramFlow& flow) {
  CycleRequest request;
  request.cycle = command.number;
  request.line = flow.main_line();
  request.tool_length = command.modal.tool_length;
  const auto add = [&](std::uint32_t number, const language::Value& value) {
    if (value.given) request.numbers.push_back(number), request.values.push_back(value.number);
  };
  for (std::uint32_t i = 0; i < language::local_variables; ++i) add(i, flow.locals()[i]);
  const auto& user = flow.variables().user;
  for (auto i = first_result; i <= last_result; ++i) add(i, user[i - first_user]);
  add(complete_result, user[complete_result - first_user]);
  return request;
}
}  // namespace

// The axes are at rest and the drive has executed everything: what stopped the flow is handled now.
void ChannelCore::run_pending(FlowState state) {
  if (thread_.collecting() && state != FlowState::alarm) {
    cut_thread();
    return;
  }
  if (thread_.cutting()) {
    const bool broken = !thread_.broken().empty();
    finish_thread();
    if (broken) finish(false);
    return;
  }
  if (tapping_.active() && state != FlowState::block_end) {
    finish_tapping();
    return;
  }
  switch (state) {
    case FlowState::alarm:
      event(flow().alarm(), program_name() + ":" + flow().alarm_text());
      finish(false);
      return;
    case FlowState::end:
      finish(true);
      return;
    case FlowState::block_end:
      flow().next_block();
      states_.pause();
      return;
    case FlowState::full:
    case FlowState::waiting:
    case FlowState::loop:
    case FlowState::found:
      return;
    case FlowState::command:
      break;
  }
  const auto& command = flow().pending();
  progress_.reached = command.sequence;
  if (switches_.auxiliary_lock && language::changes_machine(command))
    flow().finish_pending();
  else
    execute(command);
}

// As in ParameterRequest: what texts change is the matter of who has stored them, whoever starts or calls
// them; what a line changes by itself, of who has entered it.
std::uint8_t ChannelCore::role() const {
  if (states_.is(Activity::mdi)) return mdi_.role();
  return program_cache_.role().value_or(machine::role::machine_operator);
}

void ChannelCore::change_table(const language::Command& command) {
  const auto channel = "channel " + std::to_string(number_);
  table_change_.begin(command, role(),
                      states_.is(Activity::mdi) ? "MDI of " + channel + " by " + mdi_.who()
                                                : program_name() + " line " +
                                                      std::to_string(flow().main_line()) + " of " + channel);
}

// As in the alarms of the interpreter.
std::string ChannelCore::place_of(const language::Command& command) const {
  auto place = program_name() + ":";
  const auto file = flow().interpreter().file_name(command.program);
  if (file.front() != '\0')
    place += std::string(file.data()) + ":";
  else if (command.program != 0)
    place += std::string(language::ProgramName(command.program).view()) + ":";
  return place + std::to_string(command.line);
}

// The command is the newest that the interpreter has given, so the text behind $ is that of its line.
std::string ChannelCore::message_of(const language::Command& command) const {
  if (command.number == language::line_message) return std::string(flow().interpreter().message_text());
  return "message " + std::to_string(command.number) + ", see the comment of the line";
}

void ChannelCore::execute(const language::Command& command) {
  switch (command.kind) {
    case language::CommandKind::transformation:
      machine_start_ = machine_position();
      path().start(command.target, command.modal.transformation, command.modal.tool_length);
      flow().finish_pending();
      return;
    case language::CommandKind::skip:
      begin_skip();
      return;
    case language::CommandKind::read:
      begin_read(command);
      return;
    case language::CommandKind::spindle_order:
      begin_auxiliary({AuxiliaryKind::E, command.number, command.value, true});
      return;
    case language::CommandKind::tap:
      begin_tapping();
      return;
    case language::CommandKind::home:
      begin_program_homing(command);
      return;
    case language::CommandKind::thread:
      begin_thread();
      return;
    case language::CommandKind::table:
      if (command.table == language::Table::parts) {
        parts_ = static_cast<std::uint32_t>(command.value);
        flow().finish_pending();
        return;
      }
      change_table(command);
      states_.wait();
      return;
    case language::CommandKind::print:
      begin_print(command);
      return;
    case language::CommandKind::cycle:
      begin_cycle(command);
      return;
    case language::CommandKind::message:
      event(alarm::program_message, place_of(command) + ": " + message_of(command));
      flow().finish_pending();
      return;
    case language::CommandKind::tool:
      begin_auxiliary({AuxiliaryKind::T, command.number, 0, false});
      return;
    case language::CommandKind::spindle_speed:
      begin_auxiliary({AuxiliaryKind::S, 0, command.value, false,
                       command.modal.spindle_mode == language::SpindleMode::surface,
                       command.modal.spindle_limit, 0});
      return;
    case language::CommandKind::auxiliary:
      if (command.number == optional_stop && !switches_.optional_stop)
        flow().finish_pending();
      else
        begin_auxiliary({AuxiliaryKind::M, command.number, command.value, command.has_value});
      return;
    case language::CommandKind::end:
      begin_auxiliary({AuxiliaryKind::M, command.number, 0, false});
      return;
    default:
      flow().finish_pending();
      return;
  }
}

// At standstill: until the setpoints tell it, the radius of a surface speed is that of the position.
void ChannelCore::begin_auxiliary(program_execution::AuxiliaryFunction function) {
  if (function.surface) {
    const auto frame = executed_frame(executed_modal());
    function.limit = canonical::lower_limit(function.limit, machine_.highest_spindle_speed());
    function.radius = std::abs(path().position()[language::X] - frame.total_offset()[language::X]);
  }
  if (function.kind == AuxiliaryKind::S) spindle_programmed_ = function.value;
  handshake_.begin(function, link().executed());
  states_.wait();
}

void ChannelCore::on_auxiliary_done(const idl::plc::AuxiliaryDone& done) {
  if (read_.active() && !done.failed) return;  // only on_macro_signal() has the value
  const auto refusal = handshake_.refusal();
  const auto outcome = handshake_.finish(done);
  if (outcome == AuxiliaryHandshake::Outcome::not_open) return;
  if (outcome == AuxiliaryHandshake::Outcome::failed) {
    event(alarm::auxiliary_refused, place_of(flow().pending()) + ": " + refusal);
    stop_activity();
    return;
  }
  if (states_.preparing() != nullptr) {
    states_.end_wait(interlock_.holds());
    return;
  }
  const auto command = flow().pending();
  flow().finish_pending();
  if (auto* suspended = states_.suspended()) suspended->mdi_functions.pass(command);
  // What the PLC has done is not undone by going back: the path begins anew behind it.
  if (language::changes_machine(command)) path().restart();
  const bool auxiliary = command.kind == language::CommandKind::auxiliary;
  // T only selects a tool; M6 puts it into the spindle.
  if (auxiliary && command.number == tool_change) put_into_spindle(command.modal.tool);
  if (command.kind == language::CommandKind::end) {
    count_part();
    finish(true);
    return;
  }
  const bool stop = auxiliary && (command.number == program_stop || command.number == optional_stop);
  states_.end_wait(stop || interlock_.holds());
}

void ChannelCore::on_macro_signal(const idl::plc::MacroSignal& signal) {
  if (!read_.active() || !read_.value()) return;
  if (handshake_.finish({signal.channel, signal.number, false}) == AuxiliaryHandshake::Outcome::not_open)
    return;
  read_.end();
  flow().value_read(signal.value);
  states_.end_wait(interlock_.holds());
}

// What was only tested, and a program of a command, is no part.
void ChannelCore::count_part() {
  const bool tested = switches_.dry_run || switches_.auxiliary_lock || lock_.any();
  if (states_.is(Activity::program) && !tested && !is_temporary(selected().name)) ++parts_;
}

void ChannelCore::on_table_changed(const std::string& reason) {
  if (!table_change_.finish()) return;
  if (!reason.empty()) {
    event(alarm::table_refused, place_of(flow().pending()) + ": " + reason);
    stop_activity();
    return;
  }
  flow().finish_pending();
  states_.end_wait(interlock_.holds());
}

// The command is the newest that the interpreter has given, so the line is its.
void ChannelCore::begin_print(const language::Command& command) {
  const bool mdi = states_.is(Activity::mdi);
  const auto file = machine::print_file(program_name(), number_);
  const auto* stored = selection_.stored(file);
  const bool due = printer_.begin(mdi ? LinePrinter::Source::line : LinePrinter::Source::program, file,
                                  stored == nullptr ? 0 : stored->size, command.sequence,
                                  flow().interpreter().print_text());
  if (due)
    states_.wait();
  else
    flow().finish_pending();
}

// A line that is refused is sent again by cycle start.
void ChannelCore::on_printed(const idl::program::ProgramReply& reply) {
  switch (printer_.finish(reply)) {
    case LinePrinter::Outcome::not_open:
    case LinePrinter::Outcome::waits:
      return;
    case LinePrinter::Outcome::refused:
      event(alarm::print_refused, place_of(flow().pending()) + ": the line of DPRNT was not written: " +
                                      printer_.reason() + ". Cycle start writes it again");
      states_.end_wait(true);
      return;
    case LinePrinter::Outcome::done:
      break;
  }
  flow().finish_pending();
  states_.end_wait(interlock_.holds());
}

// The axes are at rest, and nothing is read ahead before the answer.
void ChannelCore::begin_cycle(const language::Command& command) {
  if (!cycle_service_) {
    refuse_cycle("this machine has no service `measurement`: add it to machine.yaml");
    return;
  }
  auto request = cycle_request(command, flow());
  request.program = program_name();
  // The text of the cycle is the builder's; what it is to do is said by the line that calls it.
  request.role = states_.is(Activity::mdi) ? std::min(mdi_.role_of_line(), role()) : role();
  const auto position = machine_position();
  request.machine.assign(position.begin(), position.end());
  cycle_call_.begin(std::move(request));
  states_.wait();
}

void ChannelCore::on_cycle_reply(const CycleReply& reply) {
  cycle_call_.take(reply);
  settle_cycle();
}

void ChannelCore::give_up_cycle() {
  if (cycle_call_.unheard()) refuse_cycle("the service `measurement` does not answer");
}

void ChannelCore::refuse_cycle(const std::string& reason) {
  event(alarm::cycle_refused, program_name() + ":" + std::to_string(flow().main_line()) + ": " + reason);
  stop_activity();
}

// The list of programs may come after the answer: a call must not read an older text.
void ChannelCore::settle_cycle() {
  if (!cycle_call_.answer()) return;
  const auto answer = *cycle_call_.answer();
  if (answer.outcome == CycleOutcome::REFUSED) {
    refuse_cycle(answer.reason);
    return;
  }
  const bool call = answer.outcome == CycleOutcome::CALL;
  const auto* stored = selection_.stored(answer.program);
  if (call && (stored == nullptr || stored->revision < answer.revision)) return;
  cycle_call_.close();
  flow().cycle_answered(call ? 1 : 0);
  states_.end_wait(interlock_.holds());
}

}  // namespace trunnion::channel
