// SPDX-License-Identifier: Apache-2.0
// Moves that are more than a path: those a skip input ends, those a spindle follows, and those that follow
// one. Values of spindles and signals of the PLC, behind a wait.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "canonical/macro_signal.hpp"
#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/axes.hpp"

namespace trunnion::channel {
namespace {

std::string speed_words(double speed) { return std::to_string(std::lround(speed)) + " 1/min"; }

}  // namespace

// The axes are at rest, and nothing is read ahead before the move has ended.
void ChannelCore::begin_skip() {
  const auto input = flow().pending().number;
  if (flow().push_pending() != FlowState::alarm) skip_.begin(input);
}

void ChannelCore::finish_skip() {
  const auto& path = this->path();
  SkipResult result;
  result.stopped = result.touched = path.position();
  if (const auto& touch = skip_.touch()) {
    // The path at the cycle of the edge, and the axes' deviation from it when the input came on.
    AxisValues machine = path.machine_of(stream_.at(touch->cycle).position);
    for (std::size_t i = 0; i < machine.size(); ++i) machine[i] += touch->deviation[i];
    result.touched = path.path_of(machine);
  }
  skip_.end();
  flow().skip_ended(result);
}

// As a skip move: nothing is read ahead, and the wait lets time pass in a loop that does nothing else.
void ChannelCore::begin_read(const language::Command& command) {
  const auto number = command.number;
  if (flow().push_pending() != FlowState::alarm) read_.begin(number);
}

bool ChannelCore::finish_read() {
  if (!read_.value()) return false;
  if (canonical::is_macro_signal(read_.number())) {
    begin_auxiliary({program_execution::AuxiliaryKind::E, read_.number(), 0, false});
    return true;
  }
  const auto value = *read_.value();
  read_.end();
  flow().value_read(value);
  return true;
}

void ChannelCore::begin_tapping() {
  const auto& spindle = machine_.tapping_spindle(flow().pending().number);
  if (!spindle.axis) {
    flow().refuse_pending(language::AlarmNumber::tapping_spindle_missing);
    return;
  }
  // A part may hold both: the path would turn one of them alone.
  const auto column = column_of(spindle);
  if (((synchronized_ >> column) & 1u) != 0) {
    flow().refuse_pending(language::AlarmNumber::tapping_spindle_synchronized);
    return;
  }
  const auto& stroke = flow().pending();
  const auto from = path().machine_position(), to = path().machine_of(stroke.target);
  const auto tap = tap_words(from);
  if (!tap.empty() && (!stroke.out || tap_.contradicts(from, to, stroke.value))) {
    flow().refuse_pending(language::AlarmNumber::tap_removal_thread, tap);
    return;
  }
  if (!may_couple(spindle, stroke, column)) return;
  if (!stroke.out) tap_ = program_execution::TapInHole::of(stroke.value, from, to);
  const double fastest = Tapping::fastest(stroke, spindle.highest_speed);
  tapping_.begin(path().position(), stroke, spindle.highest_speed_in(spindles_.gear(column)));
  path().trajectory().set_limits(tapping_.limits(manual_.path_limits(), spindle.acceleration_up_to(fastest)));
  path().restart();
  flow().set_tapping(true);
}

// False: it is refused, or the feedback has to tell more before.
bool ChannelCore::may_couple(const channel_setup::TappingSpindle& spindle, const language::Command& stroke,
                             std::size_t column) {
  const auto name = machine::spindles(*parameters_).at(column).name;
  const auto rest = spindles_.rest(column);
  if (rest == SpindleWatch::Rest::waits) return false;
  if (rest == SpindleWatch::Rest::turns) {
    flow().refuse_pending(language::AlarmNumber::tapping_spindle_turns,
                          name + " turns at " + speed_words(spindles_.speed(column)) +
                              ". Stop this spindle: M5 may have been that of another one");
    return false;
  }
  const auto gear = spindles_.gear(column);
  const double highest = spindle.highest_speed_in(gear), wanted = fastest_stroke(stroke);
  if (highest == 0 || wanted <= highest) return true;
  auto why = "the tap needs " + speed_words(wanted) + ", " + name + " has at most " + speed_words(highest);
  if (gear > 0) why += " in gear " + std::to_string(gear);
  why += spindle.by_gears || highest < spindle.highest_speed ? " (10a985)" : " (10a948)";
  flow().refuse_pending(language::AlarmNumber::spindle_speed_above, why);
  return false;
}

// The column of the feedback.
std::size_t ChannelCore::column_of(const channel_setup::TappingSpindle& spindle) const {
  const int column = machine::column_of(machine::spindles(*parameters_), spindle.axis.value_or(0));
  return static_cast<std::size_t>(std::max(column, 0));
}

// Empty: no tap is in its hole with the axes at `position`, in machine coordinates.
std::string ChannelCore::tap_words(const AxisValues& position) const {
  const double depth = tap_.depth(position);
  return depth > 0 ? tap_.words(depth) : std::string();
}

Answer ChannelCore::refuse_with_tap(const std::string& words) const {
  return refuse(alarm::tap_removal_thread,
                "A tap is in its hole: " + words + ". Remove it with G84.9 (NUM: G39+) by MDI, then start");
}

// A tap that is not in its hole when something starts was removed otherwise. Axes without a reference may be
// anywhere.
void ChannelCore::forget_removed_tap() {
  if (names_without_reference().empty() && tap_words(machine_start_).empty()) tap_ = {};
}

// The override of the spindle is that of the path it is coupled to.
double ChannelCore::tapping_override() const {
  return Tapping::override_of(switches_.spindle_override, flow().tap_speed(), tapping_.highest_speed());
}

void ChannelCore::finish_tapping() {
  if (!tapping_.active()) return;
  if (!(tap_.depth(path().machine_position()) > 0)) {
    tap_ = {};
    flow().set_tap_in_hole({});
  }
  tapping_.end();
  flow().set_tapping(false);
  path().trajectory().set_limits(manual_.path_limits());
  path().restart();
}

// The axes are at rest. A thread may go on in the next blocks, which have to be read first.
void ChannelCore::begin_thread() {
  thread_.collect();
  flow().set_threading(true);
}

void ChannelCore::cut_thread() {
  if (flow().legs().empty()) return;
  const auto& modal = flow().executing();
  const auto& settings = machine_.stream(virtual_time_);
  ThreadSpindle spindle;
  spindle.column = column_of(machine_.tapping_spindle());
  spindle.speed = modal.spindle_speed;
  spindle.clockwise = modal.spindle_direction == language::SpindleDirection::cw;
  spindle.cycle_seconds = machine_.cycle_seconds();
  spindle.lead = settings.lead;
  spindle.batch = settings.feedback_batch;
  const auto fault = thread_.begin(path().position(), flow().legs(), manual_.path_limits(), spindle);
  if (fault == ThreadPath::Fault::none) return;
  const auto leg = thread_.path().faulty_leg();
  thread_.end();
  flow().refuse_thread(language::AlarmNumber::thread_too_short, leg);
  flow().set_threading(false);
}

StreamCycle ChannelCore::step_thread(std::uint64_t cycle) {
  const bool whole = thread_.broken().empty();
  const auto now = thread_.step(cycle, states_.abandoned(), states_.feed_hold());
  const auto& leg = thread_.path().leg(now.leg);
  if (whole && !thread_.broken().empty())
    event(alarm::thread_broken,
          program_name() + ":" + std::to_string(leg.line) + ": " + thread_.broken() + ". Retract the tool");
  if (thread_.following()) progress_.point = {leg.sequence, leg.line, now.fraction};
  const auto* suspended = states_.suspended();
  StreamCycle out;
  out.shown.line = suspended != nullptr ? suspended->progress.executed.line : leg.line;
  out.shown.feed = now.speed;
  for (std::size_t i = 0; i < now.position.size(); ++i)
    out.shown.distance_to_go[i] = leg.target[i] - now.position[i];
  out.shown.position = now.position;
  out.shown.sequence = leg.sequence;
  out.setpoint = now.position;
  if (in_machine_coordinates()) add_offset(out, path().machine_of(now.position));
  out.line = leg.line;
  out.spindle = now.angle;
  out.at_rest = now.at_rest;
  out.may_end = manual_.offset_at_rest();
  return out;
}

void ChannelCore::finish_thread() {
  if (!thread_.active()) return;
  const bool cut = thread_.cutting();
  const auto position = thread_.position();
  thread_.end();
  flow().set_threading(false);
  if (cut) path().start(position, path().transformation(), path().tool_length());
}

}  // namespace trunnion::channel
