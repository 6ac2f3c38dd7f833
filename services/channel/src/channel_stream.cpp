// The channel's setpoints: when it moves, what it writes in every cycle, and what of it has been executed.
#include <algorithm>

#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::channel {
namespace {
// A hold has ended in a standstill when the setpoints have been the same this long: a rounding at a stop may
// still run out after the path speed is 0.
constexpr int standstill_cycles = 3;
}  // namespace

void ChannelCore::set_hold(const std::string& why) {
  external_hold_ = why;
  if (!why.empty() && run_ == RunState::RUNNING && activity_ != Activity::none) hold();
}

void ChannelCore::hold() {
  offset_.stop();
  wheel_.stop();
  if (activity_ == Activity::handwheel)
    return;  // it comes to rest by itself, and there is nothing to go on with
  hold_ = true;
  run_ = RunState::HOLDING;
}

FlowState ChannelCore::fill() {
  if (!interpreting() || aborting_ || preparation_ || retracing_ || skip_.active()) return FlowState::full;
  flow().set_cycle(link_.next());
  trajectory_->set_position_check(tapping_.active() ? 0 : exact_stop_.cycles());
  const auto state = flow().fill(single_block_ && activity_ == Activity::program);
  text_missing_ = state == FlowState::waiting;
  return state;
}

void ChannelCore::advance() {
  if (!configured()) return;
  apply_parameters();
  if (activity_ == Activity::none || link_.state() != LinkState::idle) return;
  if (run_ == RunState::HOLDING) {  // the motion has stopped and was executed
    hold_ = false;
    if (aborting_)
      finish(false);
    else
      run_ = RunState::HELD;
    return;
  }
  for (int i = 0; i < 1000 && run_ == RunState::RUNNING && activity_ != Activity::none; ++i) {
    if (preparation_) {
      if (!run_preparation()) return;
      continue;
    }
    const auto state = fill();
    if (state == FlowState::waiting) return;
    const bool found = restart_ && activity_ == Activity::program && !program_flow_.searching();
    if (state == FlowState::found || found) {
      prepare_entry();
      continue;
    }
    const bool rests =
        (activity_ == Activity::handwheel ? wheel_.at_rest() : trajectory_->at_rest()) && offset_.at_rest();
    if (!rests) {
      if (!external_hold_.empty()) {
        run_ = RunState::HELD;
        return;
      }
      start_stream();
      return;
    }
    if (!interpreting() || aborting_) {
      finish(false);
      return;
    }
    if (skip_.active()) {
      finish_skip();
      continue;
    }
    run_pending(state);
  }
}

// Not before every copy of a stage is in step.
void ChannelCore::start_stream() {
  if (!may_start_) return;
  standing_ = 0;
  link_.request_start();
}

// The slowest copy of a stage is near enough for `count` setpoints more. It may not have heard of this
// motion.
bool ChannelCore::copies_follow(std::uint32_t count) {
  if (link_.starts()) motion_start_ = link_.next();
  const auto end = link_.next() + count, distance = 2 * machine_.lead();
  return end <= distance || end - distance <= std::max(floor_, motion_start_);
}

// One cycle: the path, or the handwheel in its place; then what is added to it and which axes stand.
void ChannelCore::step_cycle(idl::stream::PathFrame& frame) {
  const std::uint64_t cycle = link_.next() + frame.count;
  if (skip_.active()) skip_.moves_from(cycle);
  if (skip_.active() && skip_.brakes_in(cycle, machine_.lead())) trajectory_->abort();
  motion::Setpoint setpoint;
  if (activity_ == Activity::handwheel) {
    wheel_.step();
    setpoint.position = machine_position();
    setpoint.at_rest = wheel_.at_rest();
  } else {
    if (!holding() && !exact_stop_.step(*trajectory_, cycle)) {
      event(alarm::position_not_reached,
            program_name() + ":" + std::to_string(point_.line) + ": " + exact_stop_.failure());
      hold();
    }
    setpoint = trajectory_->step(tapping_.active() ? 1 : feed_override_, rapid_override_, holding());
    point_ = {setpoint.sequence, setpoint.line, setpoint.fraction};
    if (retracing_ && run_ == RunState::RUNNING && trajectory_->retraced_to_start()) hold();
  }
  auto& written = written_[cycle % history];
  written = {cycle,
             suspended_ ? suspended_->shown.line : setpoint.line,
             setpoint.feed,
             setpoint.distance_to_go,
             setpoint.position,
             {},
             setpoint.rapid,
             setpoint.sequence};
  auto out = setpoint.position;
  if (in_machine_coordinates()) {
    written.machine = activity_ == Activity::handwheel ? out : machine_of(out);
    out = lock_.hold(written.machine);
    const auto& offset = offset_.step();
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += offset[i];
  }
  frame.setpoints.insert(frame.setpoints.end(), out.begin(), out.end());
  frame.lines.push_back(setpoint.line);
  if (tapping_.active()) frame.spindle.push_back(tapping_.revolutions(setpoint.position));
  ++frame.count;
  standing_ = setpoint.path_speed == 0 && out == last_position_ ? standing_ + 1 : 0;
  last_position_ = out;
  frame.ends = offset_.at_rest() && (setpoint.at_rest || (holding() && standing_ > standstill_cycles));
}

bool ChannelCore::produce(idl::stream::PathFrame& frame) {
  if (link_.state() != LinkState::active) return false;
  const std::uint32_t count = machine_.frame_cycles(virtual_time_);
  if (!link_.credit(count, machine_.lead()) || !copies_follow(count)) return false;
  frame.setpoints.clear();
  frame.lines.clear();
  frame.spindle.clear();
  frame.ends = false;
  frame.count = 0;
  auto flow = FlowState::full;
  while (frame.count < count && !frame.ends) {
    if (!holding() && !aborting_) {
      flow = fill();
      if (flow == FlowState::waiting) break;
    }
    step_cycle(frame);
  }
  if (frame.count == 0) return false;
  frame.channel = number_;
  frame.copy = 0;
  frame.epoch = link_.epoch();
  frame.first = link_.next();
  frame.revision = machine_.revision();
  frame.starts = link_.starts();
  const bool rtcp = frame_ == language::Transformation::rtcp && !in_machine_coordinates();
  frame.transformation = idl_of(rtcp ? language::Transformation::rtcp : language::Transformation::none);
  frame.tool_length = in_machine_coordinates() ? 0 : frame_tool_length_;
  frame.spindle_axis = machine_.tapping_spindle(tapping_.axis()).axis.value_or(0);
  frame.states.clear();
  if (frame.starts) frame.states = link_.states();
  store_state(flow, frame.snapshot);
  frame.snapshot.cycle = frame.first + frame.count - 1;
  link_.written(frame.count, frame.ends);
  return true;
}

void ChannelCore::store_state(FlowState state, idl::stream::ChannelSnapshot& out) const {
  const bool last = state == FlowState::end ||
                    (state == FlowState::command && flow().pending().kind == language::CommandKind::end);
  ChannelSnapshot s;
  s.crc = selected_.crc32;
  s.revision = selected_.revision;
  s.tool = tool_;
  s.start = program_start_;
  s.offset_on = offset_on_;
  s.offset = offset_.position();
  s.dry_run = dry_run_, s.auxiliary_lock = auxiliary_lock_, s.block_skip = block_skip_;
  auto point = point_;
  s.transformation = frame_, s.tool_length = frame_tool_length_;
  s.position = trajectory_->position();
  s.running = activity_ == Activity::program && !aborting_ && !preparation_ && !lock_.any() &&
              !(last && trajectory_->at_rest());
  if (suspended_) {
    s.running = !aborting_ && !lock_.any();
    point = suspended_->point;
    s.transformation = suspended_->frame, s.tool_length = suspended_->tool_length;
    s.position = program_trajectory_->position();
  } else if (restart_) {
    s.running = true;
    point = {restart_->sequence, point_.line, restart_->fraction};
    s.transformation = program_flow_.executing().transformation;
    s.tool_length = program_flow_.executing().tool_length;
    s.position = restart_->position;
  }
  s.sequence = point.sequence, s.line = point.line, s.fraction = point.fraction;
  store(s, program_flow_.skips(), out);
}

// Commands are counted anew; what was written before is not of them.
void ChannelCore::forget_sequences() {
  for (auto& written : written_) written.sequence = 0;
  shown_.sequence = reached_ = 0;
}

void ChannelCore::remember_executed() {
  if (link_.executed() == 0 || activity_ == Activity::none) return;
  const auto& written = written_[(link_.executed() - 1) % history];
  if (written.cycle == link_.executed() - 1 && (written.line != 0 || activity_ != Activity::program))
    shown_ = written;
}

}  // namespace trunnion::channel
