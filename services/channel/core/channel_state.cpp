// SPDX-License-Identifier: Apache-2.0
// What the HMI shows of a channel.
#include <algorithm>

#include "channel_core.hpp"
#include "machine/parameter_constants.hpp"
#include "modal_codes.hpp"
#include "stream/drive_at_rest.hpp"
#include "text/utf8.hpp"

namespace trunnion::channel {
namespace {
// 20,000 .. 999,000, then 1.0 million.
std::string in_words(std::uint64_t lines) {
  if (lines < 1000000) return std::to_string(lines / 1000) + ",000";
  return std::to_string(lines / 1000000) + "." + std::to_string(lines / 100000 % 10) + " million";
}
}  // namespace

std::string ChannelCore::detail() const {
  if (homing_.active()) {
    auto text = homing_.detail(machine_.channel_axes(), link(), switches_.feed_override > 0);
    if (const auto done = program_homing_.done_letters(); !done.empty()) text += "; homed: " + done;
    return text;
  }
  const bool running = states_.advances(), held = states_.in<Held>();
  const auto* preparing = states_.preparing();
  const auto& executed = progress_.executed;
  if (held && program_homing_.under_way()) return "cycle start: homing of " + program_homing_.letters_left();
  if (preparing != nullptr && held) return "cycle start: " + words_of(preparing->preparation, machine_start_);
  if (loops())
    return "line " + std::to_string(flow().main_line()) + ": " + in_words(flow().lines_without_motion()) +
           " lines were read without a motion; reset ends it";
  if (running && states_.is(Activity::program) && program_flow_.searching())
    return "searching line " + std::to_string(executed.line);
  if (link().resuming() && link().drive_mode() == DriveMode::HELD)
    return "the drive waits for cycle start, or a reset, of the other channels that it has stopped";
  if (printer_.open() && states_.in<Waiting>()) return "waits for the program service: a line of DPRNT";
  if (hold_waits_ && !held) return "the feed hold waits until the program permits it (#3004)";
  if (cycle_call_.open()) return "waits for the measurement of the kinematics";
  if (waits_for_text()) return "waiting for the text of the program";
  if (running && preparing != nullptr && preparing->approaching) return "approaching the program";
  if (running && stream_.idle() && link().drive_mode() == DriveMode::HOMING && !motion_at_rest())
    return "waits: another channel searches a reference";
  if (auto why = running ? thread_.waits_for() : std::string(); !why.empty()) return why;
  if (running && tap_stopped())
    return "the PLC has stopped the tap: it continues when the PLC lets it; reset leaves it where it is";
  if (running && states_.interpreting() && !tapping_.active() && !thread_.cutting() &&
      (executed.rapid ? switches_.rapid_override : feed_override()) == 0)
    return executed.rapid ? "the rapid override is 0 %" : "the feed override is 0 %";
  if (held && states_.retracing()) return "gone back as far as the path is kept; cycle start: forwards";
  if (const auto* suspended = states_.suspended())
    return "the program is held in line " + std::to_string(suspended->progress.executed.line);
  if (states_.in<Interrupted>() && interlock_.drive_stopped() && !interlock_.holds() &&
      !states_.needs_reset())
    return "the drive has stopped on the path: cycle start continues there";
  if (const auto tap = states_.in<Idle>() ? tap_words(path_of_drive(drive_position())) : std::string();
      !tap.empty())
    return std::string(stream::tap_in_hole_detail) + tap + "; G84.9 or G39+ removes it";
  return states_.published() == RunState::HELD ? interlock_.hold() : "";
}

// Of the block that is executed, not of those read ahead.
std::uint32_t ChannelCore::executed_sequence() const {
  const auto sequence = progress_.executed.sequence;
  return states_.retracing() ? sequence : std::max(sequence, progress_.reached);
}

// MDI and manual motion have no line of the program.
std::uint32_t ChannelCore::program_line() const {
  if (const auto* suspended = states_.suspended()) return suspended->progress.executed.line;
  return states_.busy() && !states_.is(Activity::program) ? 0 : progress_.executed.line;
}

const language::ModalState& ChannelCore::executed_modal() const {
  if (!states_.interpreting() || !flow().started()) return mdi_.modal();
  return *flow().modals().at(executed_sequence());
}

// At rest the frames of the last MDI line act, on the
// tables as they are now; those of a held program when no MDI line was entered in it.
language::ProgramFrame ChannelCore::executed_frame(const language::ModalState& modal) const {
  const language::ProgramFrame* known = nullptr;
  const auto* suspended = states_.suspended();
  if (states_.interpreting())
    known = flow().frames().at(executed_sequence());
  else if (suspended != nullptr && !mdi_.frames_kept())
    known = program_flow_.frames().at(suspended->progress.executed.sequence);
  if (known != nullptr) return *known;
  language::ProgramFrame frame;
  if (const auto* typed = mdi_.frame()) frame = *typed;
  frame.set_work_offset(machine_.workpiece_zero(modal.work_offset));
  frame.set_tilt(modal.tilt);
  return frame;
}

void ChannelCore::show_positions() {
  auto& s = state_;
  const auto& index = machine_.channel_axes().index;
  const auto& modal = executed_modal();
  const bool moving = stream_.moving();
  const AxisValues position =
      lock_.show(drive_position(), moving ? progress_.executed.machine : machine_start_);
  AxisValues tip = position;
  if (modal.transformation == language::Transformation::rtcp)
    tip = machine_.tip_from_machine(position, modal.tool_length);
  else
    tip[language::Z] -= modal.tool_length;
  const AxisValues words = executed_frame(modal).program_from_command(tip);
  for (std::size_t i = 0; i < index.size(); ++i) {
    const auto way = machine_.rotary_way(index[i]);
    s.machine[i] = canonical::shown_angle(way, position[index[i]]);
    s.workpiece[i] = canonical::shown_angle(way, words[index[i]]);
    s.distance_to_go[i] = moving ? progress_.executed.distance_to_go[index[i]] : 0;
  }
}

RunState ChannelCore::run_state() const {
  if (!homing_.active()) return states_.published();
  return homing_.ended() ? RunState::HOLDING : RunState::RUNNING;
}

const idl::channel::ChannelState& ChannelCore::state() {
  auto& s = state_;
  s.channel = number_;
  s.name = parameters_ ? parameters_->text(parameter::channel_name, number_) : "";
  if (s.name.empty()) s.name = "CH" + std::to_string(number_);
  s.cycle = link().executed();
  s.mode = mode_;
  s.state = run_state();
  s.program = selected().name;
  s.program_revision = selected().revision;
  s.line = program_line();
  s.lines_total = selected().lines;
  const auto& modal = executed_modal();
  s.modal = modal_codes(modal);
  if (const auto error = machine_.configured() ? executed_frame(modal).setting_error().number : 0; error != 0)
    s.modal.push_back("G54.4 P" + std::to_string(error));
  const auto drive = link().drive_mode();
  const bool stopped = drive == DriveMode::HELD || drive == DriveMode::OFF;
  s.feed = stream_.moving() && !stopped ? progress_.executed.feed * 60 : 0;
  s.programmed_feed = modal.feed;
  s.spindle_programmed = spindle_programmed_;
  s.feed_override = switches_.feed_override;
  s.rapid_override = switches_.rapid_override;
  s.spindle_override = switches_.spindle_override;
  s.tool = tool_;
  s.length_offset = modal.length_offset;
  s.tool_length = modal.tool_length;
  s.work_offset = modal.work_offset;
  s.rtcp = modal.tip_control();
  s.single_block = switches_.single_block;
  s.optional_stop = switches_.optional_stop;
  s.axes = machine_.channel_axes().number;
  s.letters = machine_.channel_axes().letters;
  const auto& index = machine_.channel_axes().index;
  s.machine.resize(index.size());
  s.workpiece.resize(index.size());
  s.distance_to_go.resize(index.size());
  if (machine_.configured()) show_positions();
  s.parts = parts_;
  s.reset_count = reset_count_;
  s.revision = machine_.revision();
  s.cycles_ahead =
      static_cast<std::uint32_t>(link().next() > link().executed() ? link().next() - link().executed() : 0);
  s.homed =
      std::all_of(s.axes.begin(), s.axes.end(), [&](std::uint16_t axis) { return homing_.referenced(axis); });
  s.dry_run = switches_.dry_run;
  s.auxiliary_lock = switches_.auxiliary_lock;
  s.block_skip = switches_.block_skip;
  s.retracing = states_.retracing();
  s.suspended = states_.suspended() != nullptr;
  s.handwheel_offset_on = manual_.offset_on();
  s.locked.resize(index.size());
  s.handwheel_offset.resize(index.size());
  for (std::size_t i = 0; i < index.size(); ++i) {
    s.locked[i] = lock_.locked(index[i]) ? 1 : 0;
    s.handwheel_offset[i] = manual_.offset()[index[i]];
  }
  s.restart_line = interrupted_.line;
  s.needs_reset = states_.needs_reset();
  s.detail = text::shortened(detail(), 128);
  return s;
}

}  // namespace trunnion::channel
