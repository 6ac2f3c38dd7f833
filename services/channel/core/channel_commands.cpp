// SPDX-License-Identifier: Apache-2.0
// What an operator may ask of a channel, and when.
#include <cmath>

#include "channel_core.hpp"
#include "commands/channel_request.hpp"
#include "commands/override_limits.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "motion/cell_builder.hpp"

namespace trunnion::channel {

using idl::channel::ChannelRequest;
using idl::channel::CommandKind;

namespace {

// Motion plans every cell for this one.
static_assert(commands::feed_override.maximum == motion::highest_override);
// A tap keeps to the acceleration of the spindle with this one, and a thread is not broken off.
static_assert(commands::spindle_override.maximum == Tapping::highest_override);
static_assert(commands::spindle_override.maximum < ThreadPath::speed_margin);

/// Of an override, to whole percents within its limits.
double stepped(double override_, double by, const commands::OverrideLimits& limits) {
  return limits.clamp(std::round(100 * (override_ + by)) / 100);
}

}  // namespace

Answer ChannelCore::refuse(const machine::AlarmDefinition& alarm, std::string reason) const {
  return {false, alarm.number, std::move(reason)};
}

Answer ChannelCore::operable() const {
  if (!configured()) return refuse(alarm::not_ready, "The channel has no parameters yet");
  if (auto refusal = interlock_.motion(states_.in<Interrupted>())) return refuse(std::move(*refusal));
  if (!bodies_.error().empty()) return refuse(alarm::bodies_invalid, bodies_.error());
  if (!recovered_) return refuse(alarm::not_ready, "The drive has not answered yet");
  if (link().drive_mode() == DriveMode::OFF) return refuse(alarm::not_ready, "The drives are off");
  if (homing_.active())
    return refuse(alarm::not_ready,
                  "An axis searches its reference: wait until it has found it, or end it with feed hold");
  return {};
}

std::string ChannelCore::names_without_reference() const {
  std::string names;
  if (!parameters_ || homing_.all_referenced()) return names;
  for (const auto& axis : machine::drive_axes(*parameters_))
    if (!homing_.referenced(axis.number)) names += (names.empty() ? "" : ", ") + axis.name;
  return names;
}

// The drive moves nothing while any of its axes has no reference, or searches it for another channel.
Answer ChannelCore::startable() const {
  if (auto answer = operable(); !answer.accepted) return answer;
  if (link().drive_mode() == DriveMode::HOMING)
    return refuse(alarm::not_ready,
                  "Another channel searches the reference of an axis: wait until it has found it");
  const auto names = names_without_reference();
  if (names.empty()) return {};
  return refuse(alarm::not_homed,
                "Axes without a reference: " + names + ". Mode REF, then reference return of each");
}

// A jog and the search for a reference by hand stop at once.
void ChannelCore::set_control(const idl::plc::ChannelControl& control) {
  if (interlock_.set_control(control)) {
    manual_.stop();
    stop_jog();
    if (!program_homing_.under_way()) end_homing();
  }
  if (!control.sets_overrides) return;
  switches_.feed_override = commands::feed_override.clamp(control.feed_override);
  switches_.rapid_override = commands::rapid_override.clamp(control.rapid_override);
  switches_.spindle_override = commands::spindle_override.clamp(control.spindle_override);
}

Answer ChannelCore::set_override(double& override_, double fraction) {
  if (control().sets_overrides)
    return refuse(alarm::request_invalid,
                  "The override switches of the machine's panel are in force: turn them");
  override_ = fraction;
  return {};
}

Answer ChannelCore::handle(const ChannelRequest& request) {
  if (auto why = commands::outside_limits(request); !why.empty())
    return refuse(alarm::request_invalid, std::move(why));
  switch (request.command) {
    case CommandKind::SET_MODE:
      return set_mode(request.mode);
    case CommandKind::SELECT_PROGRAM:
      return select(request.program);
    case CommandKind::CYCLE_START:
      return cycle_start();
    case CommandKind::START_FROM_LINE:
      return start_from_line(request.line);
    case CommandKind::FEED_HOLD:
      hold_for_operator();
      end_homing();
      return {};
    case CommandKind::RESET:
      reset();
      return {};
    case CommandKind::MDI_LINE:
      return start_mdi(request);
    case CommandKind::JOG_AXIS:
      return jog(request);
    case CommandKind::JOG_RENEW:
      return renew_jog(request.press);
    case CommandKind::JOG_STOP:
      stop_jog();
      return {};
    case CommandKind::REFERENCE_AXIS:
      return reference(request.axis);
    case CommandKind::HANDWHEEL:
      return turn_handwheel(request);
    case CommandKind::FEED_OVERRIDE:
      return set_override(switches_.feed_override, request.fraction);
    case CommandKind::RAPID_OVERRIDE:
      return set_override(switches_.rapid_override, request.fraction);
    case CommandKind::SPINDLE_OVERRIDE:
      return set_override(switches_.spindle_override, request.fraction);
    case CommandKind::FEED_OVERRIDE_STEP:
      return set_override(switches_.feed_override,
                          stepped(switches_.feed_override, request.fraction, commands::feed_override));
    case CommandKind::RAPID_OVERRIDE_STEP:
      return set_override(switches_.rapid_override,
                          stepped(switches_.rapid_override, request.fraction, commands::rapid_override));
    case CommandKind::SPINDLE_OVERRIDE_STEP:
      return set_override(switches_.spindle_override,
                          stepped(switches_.spindle_override, request.fraction, commands::spindle_override));
    case CommandKind::SINGLE_BLOCK:
      switches_.single_block = request.on;
      return {};
    case CommandKind::OPTIONAL_STOP:
      switches_.optional_stop = request.on;
      return {};
    case CommandKind::RETRACE:
      return retrace(request.on);
    case CommandKind::SET_PARTS:
      parts_ = request.parts;
      return {};
    case CommandKind::TOOL_IN_SPINDLE:
      return state_tool(request.tool);
    case CommandKind::DRY_RUN:
    case CommandKind::AXIS_LOCK:
    case CommandKind::AUXILIARY_LOCK:
    case CommandKind::BLOCK_SKIP:
    case CommandKind::HANDWHEEL_OFFSET:
      return set_switch(request);
  }
  return refuse(alarm::request_invalid, "Unknown command");
}

// A program that is held may be left for MDI and manual motion; cycle start in AUTO returns to it. Before its
// restart point is reached it may not: its trajectory starts there, wherever the axes are.
Answer ChannelCore::set_mode(Mode mode) {
  const bool leaves = states_.may_suspend() && !restart_ && !tapping_.active() && !thread_.active() &&
                      !skip_.active() && !read_.active() && !program_homing_.under_way();
  if (states_.busy() && !leaves && mode != mode_)
    return refuse(alarm::request_invalid,
                  "The mode cannot change while the channel is busy: stop or reset it first");
  if (leaves && mode != Mode::AUTO) suspend();
  if (mode != mode_) end_homing();
  mode_ = mode;
  return {};
}

Answer ChannelCore::select(const std::string& name) {
  if (!states_.in<Idle>())
    return refuse(alarm::request_invalid, "A program cannot be selected while the channel is busy");
  if (!selection_.select(name))
    return refuse(alarm::program_missing, "Program '" + name + "' is not in the store");
  interrupted_ = {};
  progress_.executed = {};
  return {};
}

Answer ChannelCore::cycle_start() {
  if (auto refusal = interlock_.start()) return refuse(std::move(*refusal));
  // What comes next may home the axes: a program without references ends at its first move.
  const bool reads_on = states_.in<Held>() && states_.interpreting() && states_.preparing() == nullptr &&
                        path().trajectory().at_rest();
  if (auto answer = states_.in<Idle>() || reads_on ? operable() : startable(); !answer.accepted)
    return answer;
  if (states_.in<Idle>()) {
    if (mode_ != Mode::AUTO)
      return refuse(alarm::request_invalid, "Cycle start needs mode AUTO (or an MDI line)");
    if (selected().name.empty()) return refuse(alarm::program_missing, "No program is selected");
    if (interrupted_.line != 0 && interrupted_.name == selected().name)
      return refuse(
          alarm::request_invalid,
          selected().name + " was left in line " + std::to_string(interrupted_.line) +
              ": start from that line, or reset the channel to start the program from its beginning");
    return start_program({});
  }
  if (states_.in<Suspended>()) return continue_after_suspension();
  if (states_.in<Interrupted>()) return continue_after_interruption();
  if (!states_.in<Held>()) return refuse(alarm::request_invalid, "The channel is busy");
  path().trajectory().retrace(false);
  hold_waits_ = false;
  states_.resume();
  return {};
}

void ChannelCore::put_into_spindle(std::uint32_t tool) {
  tool_ = tool;
  tool_since_ = link().executed();
}

// What was changed by hand, or before the control knew of it.
Answer ChannelCore::state_tool(std::uint32_t tool) {
  if (!states_.in<Idle>()) return refuse(alarm::request_invalid, "The channel is busy");
  put_into_spindle(tool);
  mdi_.set_tool(tool);
  return {};
}

Answer ChannelCore::continue_after_interruption() {
  if (states_.needs_reset())
    return refuse(alarm::not_ready, "The drives were switched off in the program: reset the channel");
  if (restart_ && stream_.idle()) {  // the stream was lost: restart at the newest point that was executed
    Entry entry;
    entry.restart = *restart_;
    return start_program(entry);
  }
  if (thread_.cutting())
    return refuse(alarm::not_ready,
                  "The axes were stopped in a thread: reset the channel, retract the tool, cut it again");
  stream_.link().request_resume();
  hold_waits_ = false;
  states_.resume_interrupted();
  return {};
}

Answer ChannelCore::reference(std::uint8_t index) {
  if (mode_ != Mode::REF) return refuse(alarm::request_invalid, "Reference return needs mode REF");
  if (auto refusal = interlock_.manual_motion()) return refuse(std::move(*refusal));
  auto move = manual_.reference(index);
  if (auto* refusal = std::get_if<Refusal>(&move)) return refuse(std::move(*refusal));
  const auto number = machine_.channel_axes().number[index];
  if (homing_.needed(number, parameters_.get())) return begin_homing(number);
  if (!states_.busy() && startable().accepted) {
    adopt_position();
    if (auto refusal = guard_reference(std::get<AxisMove>(move))) return refuse(std::move(*refusal));
  }
  return start_move(std::get<AxisMove>(move));
}

Answer ChannelCore::begin_homing(std::uint16_t axis) {
  if (states_.busy()) return refuse(alarm::request_invalid, "The channel is busy");
  if (auto answer = operable(); !answer.accepted) return answer;
  homing_.begin(axis);
  advance_homing();
  return {};
}

Answer ChannelCore::jog(const ChannelRequest& request) {
  if (mode_ != Mode::JOG) return refuse(alarm::request_invalid, "Jog needs mode JOG");
  if (auto error = manual_.jog_error(request.axis, request.speed)) return refuse(std::move(*error));
  if (auto refusal = interlock_.manual_motion()) return refuse(std::move(*refusal));
  if (states_.busy()) return refuse(alarm::request_invalid, "The channel is busy");
  adopt_position();
  auto move = manual_.jog(request.axis, request.speed, request.increment, machine_start_);
  if (auto* refusal = std::get_if<Refusal>(&move)) return refuse(std::move(*refusal));
  if (auto answer = startable(); !answer.accepted) return answer;
  if (auto refusal = guard_jog(std::get<AxisMove>(move))) return refuse(std::move(*refusal));
  auto answer = start_move(std::get<AxisMove>(move));
  if (auto* running = states_.running(); answer.accepted && running != nullptr && request.increment == 0)
    running->press = JogPress{request.press, link().tick()};
  return answer;
}

Answer ChannelCore::renew_jog(std::uint32_t press) {
  auto* running = states_.running();
  if (running == nullptr || !running->press || running->press->number != press || states_.abandoned())
    return refuse(alarm::request_invalid,
                  "Jog press " + std::to_string(press) + " has ended: release the key and press it again");
  running->press->renewed = link().tick();
  return {};
}

void ChannelCore::stop_jog_without_renewal() {
  const auto* running = states_.running();
  if (running == nullptr || !running->press) return;
  const double seconds =
      static_cast<double>(link().tick() - running->press->renewed) * machine_.cycle_seconds();
  if (seconds > machine_.jog_renewal_seconds()) stop_jog();
}

void ChannelCore::stop_jog() {
  if (states_.is(Activity::handwheel)) manual_.stop();
  if (!states_.is(Activity::jog) || states_.abandoned()) return;
  states_.stop_jog();
  path().trajectory().abort();
}

void ChannelCore::reset() {
  ++reset_count_;
  end_homing();
  // Behind an emergency stop the program may be continued from its line.
  interrupted_ = states_.needs_reset() ? running_program() : RunningProgram{};
  const bool stands =
      states_.in<Interrupted>() || (link().resuming() && link().drive_mode() == DriveMode::HELD);
  const bool moving = states_.busy() && link().state() == LinkState::active && !stands && !states_.in<Held>();
  states_.forget_suspended();
  mdi_.set_modal(power_on_modal());
  mdi_.forget_frames();
  if (moving) {
    states_.reset_at_rest();
    manual_.stop();
    path().trajectory().abort();
    return;
  }
  end_snapshot();
  if (states_.busy())
    stop_activity();
  else
    states_.end();
  end_cycle();
  leave_temporary_program();
  if (stream_.idle()) drop_offset();
  apply_parameters();
}

}  // namespace trunnion::channel
