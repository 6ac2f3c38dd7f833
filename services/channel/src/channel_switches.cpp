// What an operator switches: dry run, locks, block skip; and the handwheel.
#include <algorithm>
#include <cmath>

#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

using idl::channel::ChannelRequest;
using idl::channel::CommandKind;

// They change what a program does from its first block on, so they are chosen before it: the blocks that are
// planned already would not follow.
Answer ChannelCore::set_switch(const ChannelRequest& request) {
  if (activity_ != Activity::none || suspended_)
    return refuse(alarm::request_invalid,
                  "Stop or reset the program first: this holds from its first block on");
  switch (request.command) {
    case CommandKind::DRY_RUN:
      dry_run_ = request.on;
      return {};
    case CommandKind::AUXILIARY_LOCK:
      auxiliary_lock_ = request.on;
      return {};
    case CommandKind::AXIS_LOCK:
      return lock_axes(request.axes);
    case CommandKind::BLOCK_SKIP:
      return set_block_skip(request.levels);
    case CommandKind::HANDWHEEL_OFFSET:
      return set_handwheel_offset(request.on);
    default:
      return refuse(alarm::request_invalid, "Unknown switch");
  }
}

// With the lock off the program's position is that of the axes again.
Answer ChannelCore::lock_axes(double mask) {
  if (!configured() || !link_.has_feedback())
    return refuse(alarm::not_ready, "The drive has not answered yet");
  const auto& axes = machine_.channel_axes().index;
  if (!(mask >= 0 && mask < std::exp2(axes.size()) && mask == std::floor(mask)))
    return refuse(alarm::request_invalid, "The channel has " + std::to_string(axes.size()) + " axes to lock");
  if (offset_on_ && mask != 0)
    return refuse(alarm::request_invalid, "Switch the handwheel offset off before axes are locked");
  adopt_position();
  std::uint16_t wanted = 0;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if ((mask >> i & 1u) != 0) wanted = static_cast<std::uint16_t>(wanted | 1u << axes[i]);
  machine_start_ = lock_.hold(machine_start_);
  lock_.set(wanted, machine_start_);
  return {};
}

Answer ChannelCore::set_block_skip(double mask) {
  constexpr double all = 0x1ff;  // levels 1 to 9
  if (!(mask >= 0 && mask <= all && mask == std::floor(mask)))
    return refuse(alarm::request_invalid, "Block skip has levels 1 to 9: bits 0 to 8");
  block_skip_ = static_cast<language::SkipLevels>(mask);
  return {};
}

Answer ChannelCore::set_handwheel_offset(bool on) {
  if (!configured() || link_.state() != LinkState::idle)
    return refuse(alarm::request_invalid, "The channel is busy");
  if (on && lock_.any()) return refuse(alarm::request_invalid, "Unlock the axes before a handwheel offset");
  if (on == offset_on_) return {};
  if (!on) {
    drop_offset();
    return {};
  }
  offset_on_ = true;
  build_trajectories();
  return {};
}

// The axes stay where they are: what was offset is their position now.
void ChannelCore::drop_offset() {
  if (!offset_on_) return;
  for (std::size_t i = 0; i < machine_start_.size(); ++i) machine_start_[i] += offset_.position()[i];
  offset_on_ = false;
  offset_.start({});
  build_trajectories();
}

Answer ChannelCore::turn_handwheel(const ChannelRequest& request) {
  const auto& axes = machine_.channel_axes().index;
  if (request.axis >= axes.size())
    return refuse(alarm::request_invalid, "The channel has no axis number " + std::to_string(request.axis));
  if (std::find(std::begin(increments), std::end(increments), request.increment) == std::end(increments))
    return refuse(alarm::request_invalid, "A count of the handwheel is 0.001, 0.01, 0.1 or 1");
  if (std::abs(request.value) > most_counts || request.value != std::floor(request.value))
    return refuse(alarm::request_invalid, "Counts of the handwheel are whole numbers up to 10000");
  const bool by_hand = mode_ == Mode::JOG;
  if (!by_hand && !offset_on_)
    return refuse(alarm::request_invalid, "The handwheel needs mode JOG, or its offset switched on");
  const bool turning = activity_ == Activity::handwheel;
  const bool in_motion = !by_hand && interpreting() && run_ == RunState::RUNNING && !aborting_ &&
                         !tapping_.active() && !skip_.active();
  if (activity_ != Activity::none && !turning && !in_motion)
    return refuse(alarm::request_invalid,
                  "The channel is busy: the handwheel waits for its motion to end or go on");
  if (!by_hand && suspended_ && !turning)
    return refuse(alarm::request_invalid, "A program is held: the handwheel moves axes in mode JOG");
  if (auto answer = startable(); !answer.accepted) return answer;
  if (!turning && !in_motion) {
    apply_parameters();
    adopt_position();
  }
  const auto axis = axes[request.axis];
  const auto& travel = machine_.travel(axis);
  const double distance = request.counts * request.increment;
  double added = 0;
  if (by_hand) {
    const double at = machine_start_[axis] + offset_.target()[axis];
    added = wheel_.turn(axis, distance, travel.negative - at, travel.positive - at);
  } else {
    // The path that is planned already must keep its travel with the new offset.
    const auto box = in_motion ? flow().extent() : channel_setup::AxisBox::of(machine_start_);
    added = offset_.turn(axis, distance, travel.negative - box.low[axis], travel.positive - box.high[axis]);
    if (in_motion) flow().set_offset(offset_.target());
  }
  if (distance != 0 && added == 0)
    return refuse(alarm::travel_limit, std::string("Axis ") + language::axis_letters[axis] +
                                           " has no travel left for the handwheel");
  if (!turning && !in_motion) begin_manual(Activity::handwheel);
  return {};
}

// Off only stops: the way forwards is the program's, and begins with cycle start.
Answer ChannelCore::retrace(bool on) {
  if (on == retracing_) return {};
  if (!on) {
    retracing_ = false;
    if (run_ == RunState::RUNNING) hold();
    return {};
  }
  const bool program = activity_ == Activity::program && !preparation_ && !restart_ && !aborting_ &&
                       !program_flow_.searching() && !tapping_.active() && !skip_.active();
  if (!program || (run_ != RunState::RUNNING && run_ != RunState::HELD))
    return refuse(alarm::request_invalid, "Only a program that runs or is held can be retraced");
  if (auto answer = startable(); !answer.accepted) return answer;
  trajectory_->retrace(true);
  if (trajectory_->at_rest()) {
    trajectory_->retrace(false);
    return refuse(alarm::request_invalid, "No path is behind the program that it could go back over");
  }
  retracing_ = true;
  hold_ = false;
  run_ = RunState::RUNNING;
  return {};
}

}  // namespace trunnion::channel
