// SPDX-License-Identifier: Apache-2.0
// What a program asks of the rest of the control while the axes are at rest: the PLC, the tables, the
// operator.
#include "channel_core.hpp"
#include "language/codes.hpp"
#include "machine/alarm_constants.hpp"
#include "table_request.hpp"

namespace trunnion::channel {

using program_execution::AuxiliaryKind;

namespace {
constexpr std::uint32_t program_stop = 0, optional_stop = 1, tool_change = 6;  // M0, M1, M6
}

// The axes are at rest and the drive has executed everything: what stopped the flow is handled now.
void ChannelCore::run_pending(FlowState state) {
  if (tapping_.active() && state != FlowState::block_end) {
    finish_tapping();
    return;
  }
  switch (state) {
    case FlowState::alarm:
      events_.push_back(
          {flow().machine_alarm(), flow().alarm_number(), program_name() + ":" + flow().alarm_text()});
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
    case language::CommandKind::tap:
      begin_tapping();
      return;
    case language::CommandKind::table:
      handshake_.begin_table(table_request(command, number_, tool_table_));
      states_.wait();
      return;
    case language::CommandKind::message:
      event(alarm::program_message, program_name() + ":" + std::to_string(command.line) + ": message " +
                                        std::to_string(command.number) + ", see the comment of the line");
      flow().finish_pending();
      return;
    case language::CommandKind::tool:
      begin_auxiliary({AuxiliaryKind::T, command.number, 0});
      return;
    case language::CommandKind::spindle_speed:
      spindle_programmed_ = command.value;
      begin_auxiliary({AuxiliaryKind::S, 0, command.value});
      return;
    case language::CommandKind::auxiliary:
      if (command.number == optional_stop && !switches_.optional_stop)
        flow().finish_pending();
      else
        begin_auxiliary({AuxiliaryKind::M, command.number, 0});
      return;
    case language::CommandKind::end:
      begin_auxiliary({AuxiliaryKind::M, command.number, 0});
      return;
    default:
      flow().finish_pending();
      return;
  }
}

void ChannelCore::begin_auxiliary(const program_execution::AuxiliaryFunction& function) {
  handshake_.begin(function, link().executed());
  states_.wait();
}

void ChannelCore::on_auxiliary_done(const idl::plc::AuxiliaryDone& done) {
  const auto function = handshake_.function();
  const auto outcome = handshake_.finish(done);
  if (outcome == AuxiliaryHandshake::Outcome::not_open) return;
  if (outcome == AuxiliaryHandshake::Outcome::failed) {
    event(alarm::auxiliary_refused, program_name() + ":" + std::to_string(flow().pending().line) +
                                        ": the PLC did not carry out " + function +
                                        ". Check the machine, then reset");
    stop_activity();
    return;
  }
  if (states_.preparing() != nullptr) {
    states_.end_wait(!external_hold_.empty());
    return;
  }
  const auto command = flow().pending();
  flow().finish_pending();
  if (auto* suspended = states_.suspended()) suspended->mdi_functions.pass(command);
  // What the PLC has done is not undone by going back: the path begins anew behind it.
  if (language::changes_machine(command)) path().restart();
  const bool auxiliary = command.kind == language::CommandKind::auxiliary;
  // T only selects a tool; M6 puts it into the spindle.
  if (auxiliary && command.number == tool_change) tool_ = command.modal.tool;
  if (command.kind == language::CommandKind::end) {
    finish(true);
    return;
  }
  const bool stop = auxiliary && (command.number == program_stop || command.number == optional_stop);
  states_.end_wait(stop || !external_hold_.empty());
}

void ChannelCore::on_table_changed(const std::string& reason) {
  if (!handshake_.finish_table()) return;
  if (!reason.empty()) {
    event(alarm::table_refused, program_name() + ":" + std::to_string(flow().pending().line) + ": " + reason);
    stop_activity();
    return;
  }
  flow().finish_pending();
  states_.end_wait(!external_hold_.empty());
}

}  // namespace trunnion::channel
