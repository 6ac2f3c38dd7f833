// SPDX-License-Identifier: Apache-2.0
// What an operator switches: dry run, locks, block skip; the handwheel and retrace.
#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

using idl::channel::ChannelRequest;
using idl::channel::CommandKind;

// They change what a program does from its first block on, so they are chosen before it: the blocks that are
// planned already would not follow.
Answer ChannelCore::set_switch(const ChannelRequest& request) {
  if (!states_.in<Idle>() || homing_.active())
    return refuse(alarm::request_invalid,
                  "Stop or reset the program first: this holds from its first block on");
  switch (request.command) {
    case CommandKind::DRY_RUN:
      switches_.dry_run = request.on;
      return {};
    case CommandKind::AUXILIARY_LOCK:
      switches_.auxiliary_lock = request.on;
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
Answer ChannelCore::lock_axes(std::uint16_t mask) {
  if (!configured() || !link().has_feedback())
    return refuse(alarm::not_ready, "The drive has not answered yet");
  const auto& axes = machine_.channel_axes().index;
  if (mask >> axes.size() != 0)
    return refuse(alarm::request_invalid, "The channel has " + std::to_string(axes.size()) + " axes to lock");
  if (manual_.offset_on() && mask != 0)
    return refuse(alarm::request_invalid, "Switch the handwheel offset off before axes are locked");
  adopt_position();
  std::uint16_t locked = 0;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if ((mask >> i & 1u) != 0) locked = static_cast<std::uint16_t>(locked | 1u << axes[i]);
  machine_start_ = lock_.hold(machine_start_);
  lock_.set(locked, machine_start_);
  return {};
}

Answer ChannelCore::set_block_skip(std::uint16_t mask) {
  constexpr std::uint16_t all = 0x1ff;  // levels 1 to 9
  if (mask > all) return refuse(alarm::request_invalid, "Block skip has levels 1 to 9: bits 0 to 8");
  switches_.block_skip = static_cast<language::SkipLevels>(mask);
  return {};
}

Answer ChannelCore::set_handwheel_offset(bool on) {
  if (!configured() || !stream_.idle()) return refuse(alarm::request_invalid, "The channel is busy");
  if (on && lock_.any()) return refuse(alarm::request_invalid, "Unlock the axes before a handwheel offset");
  if (on && bodies_.demanded())
    return refuse(alarm::request_invalid,
                  "The check for collisions does not know a handwheel offset: set 'collision: off' in "
                  "machine.yaml to use it");
  if (on == manual_.offset_on()) return {};
  if (!on) {
    drop_offset();
    return {};
  }
  manual_.switch_offset(true);
  build_paths();
  return {};
}

// The axes stay where they are: the path's position includes what was offset from now on.
void ChannelCore::drop_offset() {
  if (!manual_.offset_on()) return;
  for (std::size_t i = 0; i < machine_start_.size(); ++i) machine_start_[i] += manual_.offset()[i];
  manual_.switch_offset(false);
  manual_.place_offset({});
  build_paths();
}

Answer ChannelCore::turn_handwheel(const ChannelRequest& request) {
  if (auto error = manual_.axis_error(request.axis)) return refuse(std::move(*error));
  const bool by_hand = mode_ == Mode::JOG;
  if (!by_hand && !manual_.offset_on())
    return refuse(alarm::request_invalid, "The handwheel needs mode JOG, or its offset switched on");
  const bool turning = states_.is(Activity::handwheel);
  const bool in_motion = !by_hand && states_.interpreting() && states_.advances() && !tapping_.active() &&
                         !thread_.active() && !skip_.active() && !read_.active();
  if (states_.busy() && !turning && !in_motion)
    return refuse(alarm::request_invalid,
                  "The channel is busy: the handwheel waits for its motion to end or continue");
  if (!by_hand && states_.suspended() != nullptr && !turning)
    return refuse(alarm::request_invalid, "A program is held: the handwheel moves axes in mode JOG");
  if (auto refusal = interlock_.manual_motion()) return refuse(std::move(*refusal));
  if (auto answer = startable(); !answer.accepted) return answer;
  if (!turning && !in_motion) {
    apply_parameters();
    adopt_position();
  }
  const auto axis = machine_.channel_axes().index[request.axis];
  const double distance = request.counts * request.increment;
  double added = 0;
  if (by_hand) {
    added = manual_.turn(axis, guard_handwheel(axis, distance), machine_start_);
  } else {
    // The path that is planned already must keep its travel with the new offset.
    added = manual_.turn_offset(axis, distance,
                                in_motion ? flow().extent() : channel_setup::AxisBox::of(machine_start_));
    if (in_motion) flow().set_offset(manual_.offset_target());
  }
  if (distance != 0 && added == 0)
    return refuse(alarm::travel_limit,
                  "Axis " + std::string(1, language::axis_letters[axis]) +
                      (bodies_.stop() ? " has no travel left for the handwheel, or a body "
                                        "of the machine is in its way"
                                      : " has no travel left for the handwheel"));
  if (!turning && !in_motion) begin_manual(Activity::handwheel);
  return {};
}

// Off only stops: the direction forwards is the program's, and begins with cycle start.
Answer ChannelCore::retrace(bool on) {
  if (on == states_.retracing()) return {};
  if (!on) {
    states_.retrace(false);
    if (states_.advances()) hold();
    return {};
  }
  const bool program = states_.is(Activity::program) && states_.running() != nullptr && !restart_ &&
                       !program_flow_.searching() && !tapping_.active() && !thread_.active() &&
                       !skip_.active() && !read_.active() && !program_homing_.under_way();
  if (!program || (!states_.in<Running>() && !states_.in<Held>()))
    return refuse(alarm::request_invalid, "Only a program that runs or is held can be retraced");
  if (auto refusal = interlock_.start()) return refuse(std::move(*refusal));
  if (auto answer = startable(); !answer.accepted) return answer;
  auto& trajectory = path().trajectory();
  trajectory.retrace(true);
  if (trajectory.at_rest()) {
    trajectory.retrace(false);
    return refuse(alarm::request_invalid, "No path is behind the program that it could go back over");
  }
  states_.retrace(true);
  return {};
}

}  // namespace trunnion::channel
