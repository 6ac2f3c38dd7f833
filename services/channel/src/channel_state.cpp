// What the HMI shows of a channel.
#include <algorithm>

#include "channel_core.hpp"
#include "machine/parameter_constants.hpp"
#include "modal_codes.hpp"

namespace trunnion::channel {

std::string ChannelCore::detail() const {
  const bool running = run_ == RunState::RUNNING;
  if (preparation_ && run_ == RunState::HELD)
    return "cycle start: " + words_of(*preparation_, machine_start_);
  if (running && activity_ == Activity::program && program_flow_.searching())
    return "searching line " + std::to_string(shown_.line);
  if (waits_for_text()) return "waiting for the text of the program";
  if (running && preparing_motion_) return "approaching the program";
  if (running && interpreting() && (shown_.rapid ? rapid_override_ : feed_override_) == 0)
    return shown_.rapid ? "the rapid override is 0 %" : "the feed override is 0 %";
  if (retracing_ && run_ == RunState::HELD)
    return "gone back as far as the path is kept; cycle start: forwards";
  if (suspended_) return "the program is held in line " + std::to_string(suspended_->shown.line);
  if (!external_hold_.empty() && run_ == RunState::HELD) return external_hold_;
  return "";
}

// Of the block that is executed, not of those read ahead. At rest the frames of the last MDI line act, on the
// tables as they are now; those of a held program when nothing was typed into it.
language::ProgramFrame ChannelCore::executed_frame(const language::ModalState& modal) const {
  const language::ProgramFrame* known = nullptr;
  if (interpreting())
    known = flow().frames().at(retracing_ ? shown_.sequence : std::max(shown_.sequence, reached_));
  else if (suspended_ && !frames_kept_)
    known = program_flow_.frames().at(suspended_->shown.sequence);
  if (known != nullptr) return *known;
  language::ProgramFrame frame;
  const auto* typed = frames_kept_ ? mdi_flow_.frames().newest() : nullptr;
  if (typed != nullptr) frame = *typed;
  frame.set_work_offset(machine_.work_offset(modal.work_offset));
  frame.set_tilt(modal.tilt);
  return frame;
}

void ChannelCore::show_positions() {
  auto& s = state_;
  const auto& index = machine_.channel_axes().index;
  const auto& modal = interpreting() ? flow().executing() : modal_;
  const bool moving = link_.state() == LinkState::active || link_.state() == LinkState::ending;
  const AxisValues position = lock_.show(drive_position(), moving ? shown_.machine : machine_start_);
  AxisValues tip = position;
  if (s.rtcp)
    tip = machine_.tip_from_machine(position, modal.tool_length);
  else
    tip[language::Z] -= modal.tool_length;
  const AxisValues words = executed_frame(modal).program_from_command(tip);
  for (std::size_t i = 0; i < index.size(); ++i) {
    s.machine[i] = position[index[i]];
    s.workpiece[i] = words[index[i]];
    s.distance_to_go[i] = moving ? shown_.distance_to_go[index[i]] : 0;
  }
}

const idl::channel::ChannelState& ChannelCore::state() {
  auto& s = state_;
  s.channel = number_;
  s.name = parameters_ ? parameters_->text(parameter::channel_name, number_) : "";
  if (s.name.empty()) s.name = "CH" + std::to_string(number_);
  s.cycle = link_.executed();
  s.mode = mode_;
  s.state = run_;
  s.program = selected_.name;
  s.program_revision = selected_.revision;
  s.line = shown_.line;
  s.lines_total = selected_.lines;
  s.progress = selected_.lines > 0 ? std::min(1.0, static_cast<double>(shown_.line) / selected_.lines) : 0;
  const auto& modal = interpreting() ? flow().executing() : modal_;
  s.modal = modal_codes(modal);
  const bool moving = link_.state() == LinkState::active || link_.state() == LinkState::ending;
  s.feed = moving ? shown_.feed * 60 : 0;
  s.programmed_feed = modal.feed;
  s.spindle_programmed = spindle_programmed_;
  s.feed_override = feed_override_, s.rapid_override = rapid_override_,
  s.spindle_override = spindle_override_;
  s.tool = tool_;
  s.length_offset = modal.length_offset;
  s.tool_length = modal.tool_length;
  s.work_offset = modal.work_offset;
  s.rtcp = modal.transformation == language::Transformation::rtcp;
  s.single_block = single_block_, s.optional_stop = optional_stop_;
  s.axes = machine_.channel_axes().number;
  s.letters = machine_.channel_axes().letters;
  const auto& index = machine_.channel_axes().index;
  s.machine.resize(index.size());
  s.workpiece.resize(index.size());
  s.distance_to_go.resize(index.size());
  if (machine_.configured()) show_positions();
  s.reset_count = reset_count_;
  s.revision = machine_.revision();
  s.frames_ahead =
      static_cast<std::uint32_t>(link_.next() > link_.executed() ? link_.next() - link_.executed() : 0);
  s.homed = true;  // absolute encoders
  s.dry_run = dry_run_, s.auxiliary_lock = auxiliary_lock_;
  s.block_skip = block_skip_;
  s.retracing = retracing_;
  s.suspended = suspended_.has_value();
  s.handwheel_offset_on = offset_on_;
  s.locked.resize(index.size());
  s.handwheel_offset.resize(index.size());
  for (std::size_t i = 0; i < index.size(); ++i) {
    s.locked[i] = lock_.locked(index[i]) ? 1 : 0;
    s.handwheel_offset[i] = offset_.position()[index[i]];
  }
  s.restart_line = interrupted_.line;
  s.detail = detail().substr(0, 128);
  return s;
}

}  // namespace trunnion::channel
