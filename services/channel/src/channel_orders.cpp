// What a program asks of the rest of the control while the axes stand: the PLC, the tables, the operator.
#include "channel_core.hpp"
#include "language/codes.hpp"
#include "machine/alarm_constants.hpp"
#include "table_order.hpp"

namespace trunnion::channel {

using program_execution::AuxiliaryKind;

// The axes stand and the drive has executed everything: what stopped the flow is dealt with now.
void ChannelCore::run_pending(FlowState state) {
  using language::CommandKind;
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
      run_ = RunState::HELD;
      return;
    case FlowState::full:
    case FlowState::waiting:
    case FlowState::found:
      return;
    case FlowState::command:
      break;
  }
  const auto& command = flow().pending();
  reached_ = command.sequence;
  if (auxiliary_lock_ && language::changes_machine(command)) {
    flow().finish_pending();
    return;
  }
  switch (command.kind) {
    case CommandKind::transformation:
      machine_start_ = machine_position();
      frame_ = command.modal.transformation;
      frame_tool_length_ = command.modal.tool_length;
      trajectory_->start(command.target, frame_, frame_tool_length_);
      flow().finish_pending();
      return;
    case CommandKind::skip:
      begin_skip();
      return;
    case CommandKind::tap:
      begin_tapping();
      return;
    case CommandKind::table:
      table_order_ = table_order(command, number_, tool_table_);
      table_open_ = true;
      run_ = RunState::WAITING;
      return;
    case CommandKind::message:
      event(alarm::program_message, program_name() + ":" + std::to_string(command.line) + ": message " +
                                        std::to_string(command.number) + ", see the comment of the line");
      flow().finish_pending();
      return;
    case CommandKind::tool:
      begin_auxiliary({program_execution::AuxiliaryKind::t, command.number, 0});
      return;
    case CommandKind::spindle_speed:
      spindle_programmed_ = command.value;
      begin_auxiliary({program_execution::AuxiliaryKind::s, 0, command.value});
      return;
    case CommandKind::auxiliary:
      if (command.number == 1 && !optional_stop_) {
        flow().finish_pending();
        return;
      }
      begin_auxiliary({program_execution::AuxiliaryKind::m, command.number, 0});
      return;
    case CommandKind::end:
      begin_auxiliary({program_execution::AuxiliaryKind::m, command.number, 0});
      return;
    default:
      flow().finish_pending();
      return;
  }
}

std::optional<idl::channel::AuxiliaryRequest> ChannelCore::take_auxiliary() {
  return std::exchange(outgoing_auxiliary_, std::nullopt);
}

void ChannelCore::begin_auxiliary(const program_execution::AuxiliaryFunction& function) {
  auxiliary_ = {number_,       ++auxiliary_number_, static_cast<std::uint8_t>(function.kind),
                function.code, function.value,      link_.executed()};
  outgoing_auxiliary_ = auxiliary_;
  auxiliary_open_ = true;
  run_ = RunState::WAITING;
}

void ChannelCore::on_auxiliary_done(const idl::plc::AuxiliaryDone& done) {
  if (!auxiliary_open_ || done.number != auxiliary_.number) return;
  auxiliary_open_ = false;
  if (done.failed) {
    event(alarm::auxiliary_refused,
          program_name() + ":" + std::to_string(flow().pending().line) + ": the PLC could not carry it out");
    auxiliary_.kind = AuxiliaryKind::NO_AUXILIARY;
    outgoing_auxiliary_ = auxiliary_;
    stop_activity();
    return;
  }
  auxiliary_.kind = AuxiliaryKind::NO_AUXILIARY;
  outgoing_auxiliary_ = auxiliary_;
  if (preparation_) {
    if (must_reset_) return;
    run_ = hold_ || !external_hold_.empty() ? RunState::HELD : RunState::RUNNING;
    hold_ = false;
    return;
  }
  const auto command = flow().pending();
  flow().finish_pending();
  if (suspended_) suspended_->by_hand.pass(command);
  // What the PLC has done is not undone by going back: the path begins anew behind it.
  if (language::changes_machine(command))
    trajectory_->start(trajectory_->position(), frame_, frame_tool_length_);
  if (command.kind == language::CommandKind::tool) {
    // The tool is selected; M6 puts it into the spindle.
  } else if (command.kind == language::CommandKind::auxiliary && command.number == 6) {
    tool_ = command.modal.tool;
  }
  if (command.kind == language::CommandKind::end) {
    finish(true);
    return;
  }
  const bool stop =
      command.kind == language::CommandKind::auxiliary && (command.number == 0 || command.number == 1);
  if (must_reset_) return;  // the drives were switched off meanwhile
  run_ = stop || hold_ || !external_hold_.empty() ? RunState::HELD : RunState::RUNNING;
  hold_ = false;
}

void ChannelCore::on_table_changed(const std::string& reason) {
  if (!table_open_) return;
  table_open_ = false;
  if (!reason.empty()) {
    event(alarm::table_refused, program_name() + ":" + std::to_string(flow().pending().line) + ": " + reason);
    stop_activity();
    return;
  }
  flow().finish_pending();
  if (must_reset_) return;
  run_ = hold_ || !external_hold_.empty() ? RunState::HELD : RunState::RUNNING;
  hold_ = false;
}

}  // namespace trunnion::channel
