// SPDX-License-Identifier: Apache-2.0
#include "analysis/program_run.hpp"

#include <algorithm>
#include <memory>

#include "analysis/time_scaling.hpp"

#include "language/codes.hpp"
#include "motion/axis_motion.hpp"
#include "program_execution/program_flow.hpp"
#include "program_execution/tapping.hpp"

namespace trunnion::analysis {
namespace {

using language::Command;
using language::CommandKind;
using program_execution::FlowState;

bool is_move(const Command& command) {
  return command.kind == CommandKind::rapid || command.kind == CommandKind::line ||
         command.kind == CommandKind::arc || command.kind == CommandKind::dwell;
}

constexpr std::uint64_t no_limit = 100000000;  // cycles

// In a row, which may bring no move.
constexpr std::uint64_t most_lines = 100000000;

constexpr std::uint64_t cycles_between_stops = 256;

// The channel without a cluster: moves come through the same ProgramFlow, and what the channel asks of
// others while the axes stand is done at once.
class Runner {
 public:
  Runner(channel_setup::ChannelSetup& machine, const AxisValues& start,
         const std::function<void(const PlannedCycle&)>& sink,
         const std::function<void(const Command&, const FrameMoves&)>& moves, std::uint64_t most_cycles,
         program_execution::MoveGuard* guard, const std::function<bool()>& stop)
      : machine_(machine),
        sink_(sink),
        moves_(moves),
        most_(most_cycles),
        stop_(stop),
        trajectory_(machine.limits(), &machine.chain(), machine.cycle_seconds()),
        flow_(machine, {0, false}) {
    frame_.start = start;
    flow_.set_guard(guard);
    flow_.on_move = [this](const Command& move) {
      ++result_.blocks;
      if (moves_) moves_(move, frame_);
    };
  }

  ProgramResult run(language::TextSource& text) {
    trajectory_.start(frame_.start, frame_.transformation, 0);
    flow_.start(trajectory_, text, frame_.start, machine_.power_on(), variables_);
    do {
      flow_.set_cycle(result_.cycles);
      // Axes that follow without delay are in position in the first cycle whose feedback can be known.
      trajectory_.set_position_check(
          machine_.checks_exact_stops() && !tapping_.active() ? static_cast<int>(machine_.lead()) + 2 : 0);
      state_ = skip_on_its_way_ ? FlowState::full : flow_.fill(false);
    } while (state_ == FlowState::waiting ? go_on_reading()
             : trajectory_.at_rest()      ? go_on_at_rest()
                                          : step());
    return result_;
  }

 private:
  bool go_on_reading() {
    if (flow_.text_missing()) return fail("The text ends in the middle of reading");
    return (stop_ && stop_()) ? end_here() : true;
  }

  bool go_on_in_loop() {
    if (stop_ && stop_()) return end_here();
    if (flow_.lines_without_motion() > most_lines) return fail("The program repeats without a move");
    flow_.read_on();
    return true;
  }

  // As ChannelCore::run_pending.
  bool go_on_at_rest() {
    if (skip_on_its_way_) {
      skip_on_its_way_ = false;
      flow_.skip_ended({trajectory_.position(), trajectory_.position()});
      return true;
    }
    if (tapping_.active()) {
      tapping_.end();
      begin_tapping(false, machine_.limits());
      return true;
    }
    if (state_ == FlowState::alarm)
      return fail(flow_.alarm_text() + " (alarm " + std::to_string(flow_.alarm_number()) + ")");
    if (state_ == FlowState::end) {
      result_.good = true;
      return false;
    }
    if (state_ == FlowState::loop) return go_on_in_loop();
    return state_ != FlowState::command || take(flow_.pending());
  }

  bool take(const Command& command) {
    switch (command.kind) {
      case CommandKind::end:
        result_.good = true;
        return false;
      case CommandKind::skip:
        skip_on_its_way_ = flow_.push_pending() != FlowState::alarm;
        return true;
      case CommandKind::tap: {
        const auto& spindle = machine_.tapping_spindle(command.number);
        if (!spindle.axis) {
          flow_.refuse_pending(language::AlarmNumber::tapping_spindle_missing);
          return true;
        }
        tapping_.begin(trajectory_.position(), command);
        begin_tapping(true, tapping_.limits(machine_.limits(), spindle.acceleration));
        return true;
      }
      case CommandKind::transformation:
        frame_.transformation = command.modal.transformation;
        frame_.tool_length = command.modal.tool_length;
        trajectory_.start(command.target, frame_.transformation, frame_.tool_length);
        break;
      default:
        if (language::changes_machine(command))
          trajectory_.start(trajectory_.position(), frame_.transformation, frame_.tool_length);
        break;
    }
    frame_.start = trajectory_.position();
    if (moves_) moves_(command, frame_);
    flow_.finish_pending();
    return true;
  }

  void begin_tapping(bool on, const motion::Limits& limits) {
    trajectory_.set_limits(limits);
    trajectory_.start(trajectory_.position(), frame_.transformation, frame_.tool_length);
    flow_.set_tapping(on);
  }

  bool end_here() {
    result_.stopped = true;
    return false;
  }

  bool fail(const std::string& why) {
    result_.alarm = why;
    return false;
  }

  bool step() {
    if (stop_ && result_.cycles % cycles_between_stops == 0 && stop_()) return end_here();
    if (result_.cycles >= most_)
      return fail("The program has not ended after " + std::to_string(most_) + " cycles");
    const motion::Setpoint setpoint = trajectory_.step(1, 1, false);
    if (sink_) {
      PlannedCycle cycle;
      cycle.cycle = result_.cycles;
      cycle.setpoint = &setpoint;
      cycle.position = setpoint.position;
      const bool rtcp = frame_.transformation == language::Transformation::rtcp;
      cycle.machine =
          rtcp ? machine_.machine_from_tip(setpoint.position, frame_.tool_length) : setpoint.position;
      cycle.tip = rtcp ? setpoint.position : machine_.tip_from_machine(setpoint.position, frame_.tool_length);
      sink_(cycle);
    }
    ++result_.cycles;
    return true;
  }

  channel_setup::ChannelSetup& machine_;
  const std::function<void(const PlannedCycle&)>& sink_;
  const std::function<void(const Command&, const FrameMoves&)>& moves_;
  std::uint64_t most_;
  const std::function<bool()>& stop_;
  motion::Trajectory trajectory_;
  language::VariableStore variables_;
  program_execution::ProgramFlow flow_;
  FlowState state_ = FlowState::full;
  program_execution::Tapping tapping_;
  bool skip_on_its_way_ = false;
  FrameMoves frame_;
  ProgramResult result_;
};

}  // namespace

ProgramResult run_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                          const AxisValues& start, const std::function<void(const PlannedCycle&)>& sink,
                          const std::function<void(const Command&, const FrameMoves&)>& moves,
                          std::uint64_t most_cycles, program_execution::MoveGuard* guard,
                          const std::function<bool()>& stop) {
  return std::make_unique<Runner>(machine, start, sink, moves, most_cycles, guard, stop)->run(text);
}

PlanReport plan_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                        const AxisValues& start, const std::function<void(const PlannedCycle&)>& sink,
                        program_execution::MoveGuard* guard) {
  PlanReport report;
  const motion::Limits& limits = machine.limits();
  LimitCheck check(limits, start, machine.cycle_seconds());
  ContourCheck contour(start, limits.contour_tolerance, limits.orientation_tolerance);
  motion::Limits effective = limits;
  for (motion::AxisLimits& axis : effective.axes)
    axis.jerk = std::min(axis.jerk, axis.acceleration / (limits.smoothing_cycles * machine.cycle_seconds()));
  LeastTime least(effective, machine.cycle_seconds());
  MachineModel model{limits, machine.chain(), machine.cycle_seconds()};
  CommandBound bound(model);
  bound.begin(start, language::Transformation::none, 0);
  PlaceCost places(effective, machine.cycle_seconds());
  const auto close = [&](const FrameMoves& next) {
    report.bound += bound.finish();
    bound.begin(next.start, next.transformation, next.tool_length);
    contour.jump(next.start);
  };
  report.result = run_program(
      text, machine, start,
      [&](const PlannedCycle& cycle) {
        check.add(cycle.machine, cycle.setpoint->rapid);
        const motion::Setpoint& now = *cycle.setpoint;
        least.add(
            {cycle.machine, now.programmed_speed > 0 ? now.path_speed / now.programmed_speed : 0, now.rapid});
        const Deviation d = contour.of(cycle.position, cycle.setpoint->sequence);
        report.deviation.contour = std::max(report.deviation.contour, d.contour);
        report.deviation.orientation = std::max(report.deviation.orientation, d.orientation);
        contour.forget(cycle.setpoint->sequence);
        places.add(cycle.machine, now);
        if (sink) sink(cycle);
      },
      [&](const Command& command, const FrameMoves& frame) {
        if (!is_move(command)) return close(frame);
        bound.add(command);
        contour.add(command);
      },
      no_limit, guard);
  report.bound += bound.finish();
  report.places = places.finish();
  report.motion_time = static_cast<double>(check.moving_cycles()) * machine.cycle_seconds();
  report.least_time = least.finish();
  report.axes = check.axes();
  return report;
}

}  // namespace trunnion::analysis
