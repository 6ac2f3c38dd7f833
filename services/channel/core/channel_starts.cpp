// SPDX-License-Identifier: Apache-2.0
// How programs, lines and moves start.
#include <algorithm>

#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

// What holds from the first block on.
void ChannelCore::configure_flow(ProgramFlow& flow) {
  hold_guarded_axes();
  flow.set_block_skip(switches_.block_skip);
  flow.set_coupled_threads(!switches_.dry_run && !switches_.auxiliary_lock && !lock_.any());
  flow.set_dry_run_feed(switches_.dry_run ? machine_.dry_run_feed() : 0);
  flow.set_offset(manual_.offset_target());
  tell_references();
  stream_.forget_blocks();
  progress_.executed.sequence = progress_.reached = progress_.point.sequence = 0;
}

Answer ChannelCore::start_program(const Entry& entry) {
  const auto& restart = entry.restart;
  const auto* stored = selection_.stored(selected().name);
  if (stored != nullptr && restart.sequence != 0 && stored->revision != selected().revision)
    return refuse(alarm::program_missing,
                  "Program '" + selected().name + "' has changed since it was interrupted: reset first");
  selection_.renew();
  apply_parameters();
  adopt_position();
  forget_removed_tap();
  skip_.end();
  read_.end();
  spindles_.end();
  finish_tapping();
  finish_thread();
  auto& text = program_cache_.open(selected());
  if (restart.sequence == 0) program_start_ = machine_start_;
  program_path_.start(machine_start_);
  mdi_.forget_frames();
  configure_flow(program_flow_);
  program_flow_.set_tap_in_hole(tap_words(machine_start_));
  if (restart.sequence == 0) homed_at_start_ = homed_axes(), parts_at_start_ = parts_;
  program_flow_.set_homed(homed_at_start_);
  program_flow_.set_parts(parts_at_start_.value_or(parts_));
  printer_.start(states_.in<Interrupted>());
  program_flow_.start(program_path_.trajectory(), text, program_start_, power_on_modal(), *variables_, entry);
  restart_ = restart.sequence != 0 ? std::optional(restart) : std::nullopt;
  interrupted_ = {};
  hold_waits_ = false;
  // A drive that has lost its cycle counts anew.
  ended_ = std::min(ended_, link().snapshot().valid ? link().snapshot().cycle : 0);
  states_.begin(Activity::program);
  return {};
}

Answer ChannelCore::start_from_line(std::uint32_t line) {
  if (mode_ != Mode::AUTO) return refuse(alarm::request_invalid, "A start from a line needs mode AUTO");
  if (!states_.in<Idle>()) return refuse(alarm::request_invalid, "The channel is busy");
  if (auto answer = startable(); !answer.accepted) return answer;
  if (selected().name.empty()) return refuse(alarm::program_missing, "No program is selected");
  // The approach would tear it out.
  adopt_position();
  if (const auto tap = tap_words(machine_start_); !tap.empty()) return refuse_with_tap(tap);
  // The last line need not end with a line feed.
  if (!(line >= 1 && line <= selected().lines + 1))
    return refuse(alarm::search_failed, "Program " + selected().name + " has lines 1 to " +
                                            std::to_string(selected().lines) + ", not " +
                                            std::to_string(line));
  Entry entry;
  entry.line = line;
  progress_.executed = {};
  progress_.executed.line = entry.line;
  return start_program(entry);
}

void ChannelCore::begin_manual(Activity activity) {
  manual_path_.start(machine_start_);
  states_.begin(activity);
}

Answer ChannelCore::start_mdi(const idl::channel::ChannelRequest& request) {
  if (mode_ != Mode::MDI) return refuse(alarm::request_invalid, "An MDI line needs mode MDI");
  if (states_.busy()) return refuse(alarm::request_invalid, "The channel is busy");
  if (auto refusal = interlock_.start()) return refuse(std::move(*refusal));
  if (auto answer = operable(); !answer.accepted) return answer;  // the line may home the axes
  apply_parameters();
  adopt_position();
  forget_removed_tap();
  mdi_.enter(request);
  begin_manual(Activity::mdi);
  mdi_.set_tool(tool_);
  const auto& modal = mdi_.modal();
  const auto position = modal.transformation == language::Transformation::rtcp
                            ? machine_.tip_from_machine(machine_start_, modal.tool_length)
                            : machine_start_;
  manual_path_.start(position, modal.transformation, modal.tool_length);
  auto& flow = mdi_.flow();
  configure_flow(flow);
  flow.set_homed(homed_axes());
  flow.set_parts(parts_);
  mdi_.start(manual_path_.trajectory(), position,
             states_.suspended() != nullptr ? program_flow_.variables() : *variables_);
  // What is wrong with the line is the answer to the operator who typed it.
  const auto state = flow.fill(false);
  if (state == FlowState::alarm && manual_path_.trajectory().at_rest()) {
    states_.end();
    return {false, flow.alarm_number(), "MDI:" + flow.alarm_text()};
  }
  return {};
}

Answer ChannelCore::start_move(const AxisMove& move) {
  if (states_.busy()) return refuse(alarm::request_invalid, "The channel is busy");
  if (auto answer = startable(); !answer.accepted) return answer;
  apply_parameters();
  adopt_position();
  const auto command = manual_.command(move, machine_start_);
  if (command.target == machine_start_) return {};
  begin_manual(Activity::jog);
  manual_path_.trajectory().push(command);
  manual_path_.trajectory().finish();
  return {};
}

}  // namespace trunnion::channel
