// SPDX-License-Identifier: Apache-2.0
// The channel's setpoints: when it moves, and what it writes in every cycle.
#include <algorithm>

#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

void ChannelCore::set_hold(const std::string& why) {
  interlock_.set_hold(why);
  if (why.empty()) return;
  if (states_.advances()) hold();
  end_homing();
}

void ChannelCore::set_drive_stopped(const std::string& why) {
  interlock_.set_drive_stopped(why);
  if (!why.empty()) end_homing();
}

void ChannelCore::hold() {
  hold_waits_ = false;
  manual_.stop();
  // The handwheel comes to rest by itself, and has no path to continue.
  if (!states_.is(Activity::handwheel)) states_.hold();
}

// The program may keep it from acting on some of its blocks (#3004); alarms, the PLC and a reset do not ask.
void ChannelCore::hold_for_operator() {
  if (!states_.advances()) return;
  hold_waits_ = suppresses(canonical::no_feed_hold);
  if (!hold_waits_) hold();
}

void ChannelCore::hold_when_permitted() {
  if (hold_waits_ && states_.advances() && !suppresses(canonical::no_feed_hold)) hold();
}

// Of the command that the newest setpoint belongs to, or that is carried out at rest.
bool ChannelCore::suppresses(std::uint8_t what) const {
  if (!states_.in<Running>() || !states_.interpreting() || states_.retracing() || !flow().suppression_used())
    return false;
  const auto* modal = flow().modals().at(std::max(progress_.point.sequence, progress_.reached));
  return modal != nullptr && (modal->suppressed & what) != 0;
}

double ChannelCore::feed_override() const {
  return suppresses(canonical::no_override) ? 1 : switches_.feed_override;
}

FlowState ChannelCore::fill() {
  auto* running = states_.running();
  if (running == nullptr || !states_.interpreting() || states_.abandoned() || running->retracing ||
      skip_.active() || read_.active() || thread_.cutting())
    return FlowState::full;
  flow().set_cycle(link().next());
  path().trajectory().set_position_check(tapping_.active() ? 0 : exact_stop_.cycles());
  const auto state = flow().fill(switches_.single_block && states_.is(Activity::program));
  running->text_missing = state == FlowState::waiting && flow().text_missing();
  report_guard();
  return state;
}

bool ChannelCore::motion_at_rest() const {
  if (thread_.cutting()) return thread_.ended() && manual_.offset_at_rest();
  const bool path_at_rest =
      states_.is(Activity::handwheel) ? manual_.wheel_at_rest() : path().trajectory().at_rest();
  return path_at_rest && manual_.offset_at_rest();
}

void ChannelCore::advance() {
  if (!configured()) return;
  advance_homing();
  advance_program_homing();
  apply_parameters();
  hold_when_permitted();
  if (!states_.busy() || !stream_.idle()) return;
  if (states_.in<Holding>()) {  // the motion has stopped and was executed
    if (states_.abandoned())
      finish(false);
    else
      states_.come_to_rest();
    return;
  }
  for (int i = 0; i < 1000 && states_.advances(); ++i) {
    if (states_.in<Preparing>()) {
      if (!run_preparation()) return;
      continue;
    }
    const auto state = fill();
    if (state == FlowState::waiting) return;
    const bool found = restart_ && states_.is(Activity::program) && !program_flow_.searching();
    if (state == FlowState::found || found) {
      prepare_entry();
      continue;
    }
    if (!motion_at_rest()) {
      if (interlock_.holds())
        states_.pause();
      else if (link().drive_mode() != DriveMode::HOMING)  // of another channel, which the drive lets end
        stream_.start();
      return;
    }
    if (!states_.interpreting() || states_.abandoned()) {
      finish(false);
      return;
    }
    if (skip_.active()) {
      finish_skip();
    } else if (read_.active()) {
      if (!finish_read()) return;
    } else {
      run_pending(state);
    }
    if (state == FlowState::loop || spindles_.waits()) return;
  }
}

bool ChannelCore::loops() const {
  return states_.in<Running>() && states_.interpreting() && flow().started() && flow().loops();
}

// The path behind a loop begins at rest, so that it does not depend on how fast the lines are read.
bool ChannelCore::read_on() {
  if (!loops() || !stream_.idle() || !motion_at_rest()) return false;
  flow().read_on();
  advance();
  return true;
}

// A path that brakes or was dropped does not pass the stop; an interrupted one starts the check again.
void ChannelCore::check_exact_stop(std::uint64_t cycle) {
  if (braking() || states_.abandoned() || exact_stop_.step(path().trajectory(), cycle)) return;
  event(alarm::position_not_reached,
        program_name() + ":" + std::to_string(progress_.point.line) + ": " + exact_stop_.failure());
  if (states_.advances()) hold();
}

// One cycle: the path, or the handwheel in its place; then what is added to it and which axes are locked.
StreamCycle ChannelCore::step_cycle(std::uint64_t cycle) {
  if (thread_.cutting()) return step_thread(cycle);
  auto& trajectory = path().trajectory();
  if (skip_.active()) skip_.moves_from(cycle);
  if (skip_.active() && skip_.brakes_in(cycle, machine_.lead())) trajectory.abort();
  const bool by_hand = states_.is(Activity::handwheel);
  motion::Setpoint setpoint;
  if (by_hand) {
    manual_.step_wheel();
    setpoint.position = machine_position();
    setpoint.at_rest = manual_.wheel_at_rest();
  } else {
    check_exact_stop(cycle);
    setpoint = trajectory.step(tapping_.active() ? tapping_override() : feed_override(),
                               switches_.rapid_override, braking() || tap_stopped());
    progress_.point = {setpoint.sequence, setpoint.line, setpoint.fraction};
    hold_when_permitted();
    if (states_.in<Running>() && states_.retracing() && trajectory.retraced_to_start()) hold();
  }
  const auto* suspended = states_.suspended();
  StreamCycle out;
  out.shown.line = suspended != nullptr ? suspended->progress.executed.line : setpoint.line;
  out.shown.feed = setpoint.feed;
  out.shown.distance_to_go = setpoint.distance_to_go;
  out.shown.position = setpoint.position;
  out.shown.rapid = setpoint.rapid;
  out.shown.sequence = setpoint.sequence;
  out.setpoint = setpoint.position;
  if (in_machine_coordinates())
    add_offset(out, by_hand ? setpoint.position : path().machine_of(setpoint.position));
  out.line = setpoint.line;
  if (tapping_.active()) out.spindle = tapping_.revolutions(setpoint.position);
  // Moved by hand, or to the program, axes leave the spindle as it is.
  if (states_.interpreting() && (states_.is(Activity::mdi) || on_program_path()))
    out.radius = flow().turning_radius(setpoint.sequence, setpoint.position);
  out.stopped = setpoint.path_speed == 0;
  out.at_rest = setpoint.at_rest;
  out.holding = braking();
  out.may_end = manual_.offset_at_rest();
  return out;
}

void ChannelCore::add_offset(StreamCycle& out, const AxisValues& machine) {
  out.shown.machine = machine;
  out.setpoint = lock_.hold(machine);
  const auto& offset = manual_.step_offset();
  for (std::size_t i = 0; i < out.setpoint.size(); ++i) out.setpoint[i] += offset[i];
}

// Cycle n must not be computed before the drive has executed cycle n - lead - 1. An operator who moves axes
// by hand watches them, so these do not run far ahead either.
bool ChannelCore::uses_feedback() const {
  const bool by_hand = !states_.is(Activity::program) && !states_.is(Activity::mdi);
  return by_hand || skip_.active() || thread_.cutting() || exact_stop_.checking();
}

bool ChannelCore::produce(idl::stream::PathBatch& out) {
  if (link().state() != LinkState::active) return false;
  const auto& settings = machine_.stream(virtual_time_);
  const bool bound = uses_feedback();
  const std::uint32_t count = bound || machine_.has_gantry() ? settings.feedback_batch : settings.batch;
  if (!stream_.may_write(count, bound ? settings.lead : settings.ahead)) return false;
  stream_.open(out);
  if (thread_.cutting()) {
    if (link().starts()) thread_.stream_starts(link().next());
    thread_.begin_batch(link().next(), states_.abandoned() || states_.feed_hold());
  }
  auto flow = FlowState::full;
  while (out.count < count && !out.ends) {
    if (!braking() && !states_.abandoned()) {
      flow = fill();
      if (flow == FlowState::waiting) break;
    }
    stream_.add(out, step_cycle(stream_.cycle(out)));
    if (!bound && uses_feedback()) break;
  }
  if (out.count == 0) return false;
  report_jog_obstacle();
  stream_.close(out, path(), in_machine_coordinates(), machine_.revision(),
                machine_.tapping_spindle(tapping_.axis()).axis.value_or(0));
  out.skip_move = skip_.active();
  out.follows_spindle = thread_.cutting() && !out.spindle.empty();
  store_state(flow, out.snapshot);
  out.snapshot.cycle = out.first + out.count - 1;
  stream_.written(out);
  return true;
}

void ChannelCore::store_state(FlowState state, idl::stream::ChannelSnapshot& out) const {
  const bool last = state == FlowState::end ||
                    (state == FlowState::command && flow().pending().kind == language::CommandKind::end);
  const auto* path = &this->path();
  auto point = progress_.point;
  ChannelSnapshot s;
  s.crc = selected().crc32;
  s.revision = selected().revision;
  s.tool = tool_;
  s.start = program_start_;
  s.offset_on = manual_.offset_on();
  s.offset = manual_.offset();
  s.dry_run = switches_.dry_run;
  s.auxiliary_lock = switches_.auxiliary_lock;
  s.block_skip = switches_.block_skip;
  s.running = states_.is(Activity::program) && states_.running() != nullptr && !states_.abandoned() &&
              !lock_.any() && !(last && path->trajectory().at_rest());
  if (const auto* suspended = states_.suspended()) {
    s.running = !lock_.any();
    point = suspended->progress.point;
    path = &program_path_;
  }
  s.in_thread = thread_.following() && point.fraction < 1;
  s.thread_origin = s.in_thread ? thread_.path().origin() : 0;
  s.transformation = path->transformation();
  s.tool_length = path->tool_length();
  s.position = thread_.cutting() && states_.suspended() == nullptr ? thread_.position() : path->position();
  if (restart_) {
    s.running = true;
    point = {restart_->sequence, point.line, restart_->fraction};
    s.transformation = program_flow_.executing().transformation;
    s.tool_length = program_flow_.executing().tool_length;
    s.position = restart_->position;
  }
  s.sequence = point.sequence, s.line = point.line, s.fraction = point.fraction;
  store(s, program_flow_.skips(), out);
}

void ChannelCore::remember_executed() {
  if (!states_.busy()) return;
  const auto* written = stream_.executed();
  if (written != nullptr && (written->line != 0 || !states_.is(Activity::program)))
    progress_.executed = *written;
  if (!states_.is(Activity::program)) progress_.executed.line = 0;  // lines are the program's
}

}  // namespace trunnion::channel
