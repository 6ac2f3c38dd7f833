// What an operator may ask of a channel, and when.
#include <cmath>

#include "channel_core.hpp"
#include "machine/alarms.hpp"

namespace trunnion::channel {

using idl::channel::ChannelRequest;
using idl::channel::CommandKind;

Answer ChannelCore::refuse(const char* alarm, std::string reason) const {
  return {false, machine::alarm_definition(alarm).number, std::move(reason)};
}

Answer ChannelCore::startable() const {
  if (!configured()) return refuse("not_ready", "The channel has no parameters yet");
  if (!ready_) return refuse("not_ready", "The cluster is not ready: see the services");
  if (!external_hold_.empty()) return refuse("not_ready", external_hold_);
  if (!link_.has_feedback()) return refuse("not_ready", "The drive has not answered yet");
  if (link_.drive_mode() == DriveMode::off) return refuse("not_ready", "The drives are off");
  if (link_.drive_mode() == DriveMode::homing)
    return refuse("not_ready", "An axis searches its reference: wait until it has found it");
  return {};
}

Answer ChannelCore::handle(const ChannelRequest& request) {
  const auto finite = std::isfinite(request.value) && std::isfinite(request.increment);
  if (!finite) return refuse("request_invalid", "A value is not a finite number");
  const auto limited = [&](double& out, double low, double high) -> Answer {
    if (request.value < low || request.value > high)
      return refuse("request_invalid", "override " + std::to_string(request.value * 100) + " % is outside " +
                                           std::to_string(low * 100) + " .. " + std::to_string(high * 100) +
                                           " %");
    out = request.value;
    return {};
  };
  switch (request.command) {
    case CommandKind::SET_MODE:
      return set_mode(request.mode);
    case CommandKind::SELECT_PROGRAM:
      return select(request.text);
    case CommandKind::CYCLE_START:
      return cycle_start();
    case CommandKind::START_FROM_LINE:
      return start_from_line(request.value);
    case CommandKind::FEED_HOLD:
      if (run_ == RunState::RUNNING) hold();
      return {};
    case CommandKind::RESET:
      reset();
      return {};
    case CommandKind::MDI_LINE:
      return start_mdi(request.text);
    case CommandKind::JOG_AXIS:
      return jog(request);
    case CommandKind::JOG_STOP:
      stop_jog();
      return {};
    case CommandKind::REFERENCE_AXIS:
      return reference(request.axis);
    case CommandKind::HANDWHEEL:
      return turn_handwheel(request);
    case CommandKind::FEED_OVERRIDE:
      return limited(feed_override_, 0, 1.5);
    case CommandKind::RAPID_OVERRIDE:
      return limited(rapid_override_, 0, 1);
    case CommandKind::SPINDLE_OVERRIDE:
      return limited(spindle_override_, 0.5, 1.5);
    case CommandKind::SINGLE_BLOCK:
      single_block_ = request.value != 0;
      return {};
    case CommandKind::OPTIONAL_STOP:
      optional_stop_ = request.value != 0;
      return {};
    case CommandKind::RETRACE:
      return retrace(request.value != 0);
    case CommandKind::DRY_RUN:
    case CommandKind::AXIS_LOCK:
    case CommandKind::AUXILIARY_LOCK:
    case CommandKind::BLOCK_SKIP:
    case CommandKind::HANDWHEEL_OFFSET:
      return set_switch(request);
  }
  return refuse("request_invalid", "Unknown command");
}

// A program that is held may be left for MDI and jog; its way back is part of cycle start in AUTO.
Answer ChannelCore::set_mode(Mode mode) {
  const bool held_program = activity_ == Activity::program && run_ == RunState::HELD && !preparation_ &&
                            !retracing_ && !tapping_.active() && !skip_.active();
  if (activity_ != Activity::none && !held_program && mode != mode_)
    return refuse("request_invalid",
                  "The mode cannot change while the channel is busy: stop or reset it first");
  if (held_program && mode != Mode::AUTO) suspend();
  mode_ = mode;
  return {};
}

Answer ChannelCore::select(const std::string& name) {
  if (activity_ != Activity::none || suspended_)
    return refuse("request_invalid", "A program cannot be selected while the channel is busy");
  for (const auto& entry : programs_.programs)
    if (entry.name == name) {
      if (interrupted_.name != name) interrupted_ = {};
      selected_ = entry;
      shown_ = {};
      return {};
    }
  return refuse("program_missing", "Program '" + name + "' is not in the store");
}

Answer ChannelCore::cycle_start() {
  if (auto answer = startable(); !answer.accepted) return answer;
  switch (run_) {
    case RunState::IDLE:
      if (mode_ != Mode::AUTO)
        return refuse("request_invalid", "Cycle start needs mode AUTO (or an MDI line)");
      if (selected_.name.empty()) return refuse("program_missing", "No program is selected");
      return start_program({});
    case RunState::HELD:
      if (suspended_ && activity_ == Activity::none) return go_on_after_suspension();
      retracing_ = hold_ = false;
      trajectory_->retrace(false);
      run_ = RunState::RUNNING;
      return {};
    case RunState::INTERRUPTED:
      return go_on_after_interruption();
    default:
      return refuse("request_invalid", "The channel is busy");
  }
}

Answer ChannelCore::go_on_after_interruption() {
  if (must_reset_)
    return refuse("not_ready", "The drives were switched off in the program: reset the channel");
  if (restart_) {  // the stream was lost: begin anew at the newest point that was executed
    Entry entry;
    entry.restart = *restart_;
    // What was on its way through the stages may have been executed since.
    if (const auto own = snapshot_of(link_.states()); own && own->running && own->crc == selected_.crc32)
      entry.restart = RestartPoint{own->sequence, own->fraction, own->position};
    return start_program(entry);
  }
  link_.request_resume();
  hold_ = false;
  run_ = aborting_ ? RunState::HOLDING : RunState::RUNNING;
  return {};
}

Answer ChannelCore::reference(std::uint8_t index) {
  if (mode_ != Mode::REF) return refuse("request_invalid", "Reference return needs mode REF");
  const auto& axes = machine_.channel_axes().index;
  if (index >= axes.size())
    return refuse("request_invalid", "The channel has no axis number " + std::to_string(index));
  const auto number = machine_.channel_axes().number[index];
  if (parameters_ && parameters_->integer("homing_direction", number) != 0) {
    if (activity_ != Activity::none || suspended_) return refuse("request_invalid", "The channel is busy");
    if (auto answer = startable(); !answer.accepted) return answer;
    link_.request_homing(number);
    return {};
  }
  return start_move(axes[index], machine_.reference_position()[axes[index]],
                    machine_.reference_feed(axes[index]));
}

Answer ChannelCore::jog(const ChannelRequest& request) {
  if (mode_ != Mode::JOG) return refuse("request_invalid", "Jog needs mode JOG");
  const auto& axes = machine_.channel_axes().index;
  if (request.axis >= axes.size())
    return refuse("request_invalid", "The channel has no axis number " + std::to_string(request.axis));
  if (request.value == 0) return refuse("request_invalid", "Jog needs a speed other than 0");
  const auto axis = axes[request.axis];
  const double fastest = machine_.jog_feed(axis);
  if (std::abs(request.value) > fastest * 1.0001)
    return refuse("request_invalid", "Jog speed " + std::to_string(std::abs(request.value)) +
                                         " is above the axis' " + std::to_string(fastest));
  if (activity_ != Activity::none) return refuse("request_invalid", "The channel is busy");
  adopt_position();
  const auto& travel = machine_.travel(axis);
  const double direction = request.value > 0 ? 1 : -1;
  const double from = machine_start_[axis] + offset_.target()[axis];
  const double end = direction > 0 ? travel.positive : travel.negative;
  if ((end - from) * direction <= 0)
    return refuse("travel_limit",
                  std::string("Axis ") + language::axis_letters[axis] + " is at its travel limit");
  const double way = request.increment > 0 ? direction * request.increment : end - from;
  return start_move(axis, machine_start_[axis] + way, std::abs(request.value));
}

void ChannelCore::stop_jog() {
  if (activity_ == Activity::handwheel) {
    wheel_.stop();
    offset_.stop();
  }
  if (activity_ != Activity::jog || aborting_) return;
  aborting_ = true;
  trajectory_->abort();
}

void ChannelCore::reset() {
  ++reset_count_;
  must_reset_ = retracing_ = false;
  interrupted_ = {};
  const bool moving = activity_ != Activity::none && link_.state() == LinkState::active &&
                      run_ != RunState::INTERRUPTED && run_ != RunState::HELD;
  suspended_.reset();
  modal_ = power_on_modal();
  frames_kept_ = false;
  if (moving) {
    aborting_ = true;
    reset_due_ = true;
    run_ = RunState::HOLDING;
    offset_.stop();
    wheel_.stop();
    trajectory_->abort();
    return;
  }
  if (activity_ != Activity::none) stop_activity();
  run_ = RunState::IDLE;
  if (link_.state() == LinkState::idle) drop_offset();
  apply_parameters();
}

}  // namespace trunnion::channel
