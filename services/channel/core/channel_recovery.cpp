// SPDX-License-Identifier: Apache-2.0
// What the drive stopped, lost or kept: interruptions, and what a new process finds.
#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

void ChannelCore::on_feedback(const idl::stream::Feedback& feedback) {
  auto& link = stream_.link();
  const bool first = !link.has_feedback();
  const bool was_off = link.drive_mode() == DriveMode::OFF;
  link.on_feedback(feedback);
  skip_.on_feedback(feedback, machine_.channel_axes(), machine_.columns());
  exact_stop_.on_feedback(feedback);
  thread_.on_feedback(feedback);
  synchronized_ = synchronized_spindles(feedback);
  spindles_.on_feedback(feedback);
  if (read_.active()) read_.on_feedback(feedback, motion_at_rest() && link.executed() >= link.next());
  remember_executed();
  if (first) handshake_.continue_numbers(link.epoch()), cycle_call_.continue_numbers(link.epoch());
  const auto mode = link.drive_mode();
  if (link.state() == LinkState::lost)
    interrupt("The drive was restarted");
  else if (link.state() == LinkState::refused)
    interrupt(mode == DriveMode::OFF ? "The drives are off" : "The drive gave no place in the stream");
  else if (stream_.moving() && (mode == DriveMode::HELD || mode == DriveMode::OFF) && !link.resuming() &&
           !states_.in<Interrupted>())
    interrupt(mode == DriveMode::OFF ? "The drives were switched off" : "The drive stopped on the path");
  else if (mode == DriveMode::OFF && !first && !was_off && !link.drive_restarted() && !states_.needs_reset())
    interrupt("The drives were switched off");  // while the program was held or waited
  follow_cut();
  stop_jog_without_renewal();
}

// The drive goes on with what was on its way to it when the program was interrupted, and a new process may
// have begun with a cut of the drive's history.
void ChannelCore::follow_cut() {
  if (!restart_ || !states_.in<Interrupted>() || !stream_.idle()) return;
  auto own = snapshot_of(link().snapshot());
  if (!own || !own->running || own->crc != selected().crc32) return;
  restart_ = RestartPoint{own->sequence, own->fraction, own->position};
  progress_.executed.line = own->line;
  if (goes_farther(own->skips, program_flow_.skips())) program_flow_.set_skips(std::move(own->skips));
}

void ChannelCore::interrupt(const std::string& why) {
  auto& link = stream_.link();
  const bool off = link.drive_mode() == DriveMode::OFF && link.state() != LinkState::lost;
  if (link.state() == LinkState::lost || link.state() == LinkState::refused) {
    // What was written is void: continue from the newest consistent cut, if there is a program to continue.
    const bool was_lost = link.state() == LinkState::lost;
    link.acknowledge();
    const auto own = snapshot_of(link.snapshot());
    manual_.place_offset(own && own->offset_on ? own->offset : AxisValues{});
    const bool entering = states_.preparing() != nullptr && !restart_, reset = states_.resetting();
    if (states_.is(Activity::program) && !entering && !reset && !(was_lost && lock_.any())) {
      states_.drop_preparation();
      if (own && own->running && own->crc == selected().crc32)
        restart_ = RestartPoint{own->sequence, own->fraction, own->position};
      else if (!was_lost)
        restart_ = RestartPoint{};
    } else if (states_.busy()) {
      stop_activity();
      states_.interrupt(off);
      if (reset) drop_offset();
      event(alarm::interrupted, with_tap(why));
      return;
    }
  }
  states_.interrupt(off);
  if (states_.busy()) event(alarm::interrupted, with_tap(why));
}

void ChannelCore::recover() {
  if (recovered_ || !configured() || !link().has_feedback()) return;
  recovered_ = true;
  // The process before this one has demanded it, and nothing that stops it reached the drive meanwhile.
  if (link().drive_mode() == DriveMode::HOMING) stream_.link().leave();
  const auto own = snapshot_of(link().snapshot());
  if (own) {
    if (link().snapshot().cycle >= tool_since_) tool_ = own->tool;
    if (own->offset_on) {
      manual_.switch_offset(true);
      build_paths();
      manual_.place_offset(own->offset);
    }
  }
  if (!own || !own->running || link().snapshot().cycle <= ended_) {
    if (link().echo_active()) stream_.link().leave();
    offer_interrupted();
    return;
  }
  selection_.select_text(own->crc, own->revision);
  if (selected().name.empty()) {
    stream_.link().leave();
    event(alarm::interrupted, "The interrupted program is not in the store any more");
    return;
  }
  program_start_ = own->start;
  program_flow_.set_skips(own->skips);
  switches_.dry_run = own->dry_run;
  switches_.auxiliary_lock = own->auxiliary_lock;
  switches_.block_skip = own->block_skip;
  restart_ = RestartPoint{own->sequence, own->fraction, own->position};
  mode_ = Mode::AUTO;
  states_.begin_interrupted();
  interrupted_ = {};
  progress_.executed.line = own->line;
  const auto line = "Program " + selected().name + " was interrupted in line " + std::to_string(own->line);
  const bool in_thread = own->in_thread && own->fraction < 1;
  event(alarm::interrupted, with_tap(line + (in_thread ? ", in a thread: retract the tool and reset" : "")));
}

// What the operator has to know before the axes move again.
std::string ChannelCore::with_tap(const std::string& what) const {
  const auto tap = tap_words(path_of_drive(drive_position()));
  return tap.empty() ? what : what + "; a tap is in its hole: " + tap;
}

// After a power failure only the line is known: the operator decides whether to start from it.
void ChannelCore::offer_interrupted() {
  if (interrupted_.line == 0) return;
  const auto where = "Program " + interrupted_.name + " was in line " + std::to_string(interrupted_.line) +
                     " when the control was switched off";
  if (selection_.select(interrupted_)) {
    const auto told = with_tap(where);
    event(alarm::switched_off_in_program,
          told == where ? where + ": it can be started from there"
                        : told + ". Remove it with G84.9 (NUM: G39+) by MDI, then start from there");
    return;
  }
  event(alarm::switched_off_in_program, where + ", and has been changed or deleted since");
  interrupted_ = {};
}

}  // namespace trunnion::channel
