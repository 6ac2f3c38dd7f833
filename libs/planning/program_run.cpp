#include "planning/program_run.hpp"

#include <algorithm>
#include <memory>

#include "language/codes.hpp"
#include "motion/axis_motion.hpp"

namespace trunnion::planning {
namespace {

using language::Command;
using language::CommandKind;
using language::Step;

bool is_move(const Command& command) {
  return command.kind == CommandKind::rapid || command.kind == CommandKind::line ||
         command.kind == CommandKind::arc || command.kind == CommandKind::dwell;
}

Command per_minute(Command command) {
  if (command.modal.feed_mode == language::FeedMode::per_revolution) {
    command.modal.feed *= command.modal.spindle_speed;
    command.modal.feed_mode = language::FeedMode::per_minute;
  }
  return command;
}

class Runner {
 public:
  Runner(setup::ChannelSetup& machine, const AxisValues& start,
         const std::function<void(const PlannedCycle&)>& sink,
         const std::function<void(const Command&, const FrameMoves&)>& moves, std::uint64_t most_cycles)
      : machine_(machine),
        sink_(sink),
        moves_(moves),
        most_(most_cycles),
        trajectory_(machine.limits(), &machine.chain(), machine.cycle_seconds()) {
    interpreting_.repeat = false;
    interpreter_ = std::make_unique<language::Interpreter>(machine, interpreting_);
    frame_.start = start;
    trajectory_.start(start, frame_.transformation, 0);
  }

  ProgramResult run(language::TextSource& text) {
    interpreter_->start(text, frame_.start, {});
    while (result_.alarm.empty()) {
      const Step step = interpreter_->next(command_);
      if (step == Step::working) continue;
      if (step == Step::command) {
        if (is_move(command_) ? push() : other()) continue;
        break;
      }
      settle();
      if (step == Step::position) {
        interpreter_->set_position(command_.target);
        continue;
      }
      if (step == Step::end) {
        result_.good = result_.alarm.empty();
      } else if (step == Step::alarm) {
        const auto& alarm = interpreter_->alarm();
        result_.alarm = std::to_string(alarm.line) + ":" + std::to_string(alarm.column) + ": " +
                        std::to_string(static_cast<unsigned>(alarm.number)) + ": " + alarm.text.data();
      } else {
        result_.alarm = "The text ends in the middle of reading";
      }
      break;
    }
    return result_;
  }

 private:
  bool fail(const std::string& why) {
    settle();
    if (result_.alarm.empty()) result_.alarm = std::to_string(command_.line) + ": " + why;
    return false;
  }

  bool push() {
    if (command_.kind != CommandKind::dwell) {
      const std::string travel = machine_.travel_error(trajectory_.end_position(), command_);
      if (!travel.empty()) {
        settle();
        result_.alarm = travel;
        return false;
      }
    }
    const Command move = per_minute(command_);
    while (!trajectory_.can_accept()) {
      if (!step()) return false;
    }
    if (!trajectory_.push(move))
      return fail("feed must be above zero (per revolution: with the spindle turning)");
    ++result_.blocks;
    if (moves_) moves_(move, frame_);
    return true;
  }

  // What is no move happens at rest. Skip and tapping moves run as lines to their ends.
  bool other() {
    if (command_.kind == CommandKind::skip || command_.kind == CommandKind::tap) {
      command_.kind = CommandKind::line;
      if (!push()) return false;
      settle();
      return true;
    }
    settle();
    if (!result_.alarm.empty()) return false;
    if (command_.kind == CommandKind::transformation) {
      frame_.transformation = command_.modal.transformation;
      frame_.tool_length = command_.modal.tool_length;
      trajectory_.start(command_.target, frame_.transformation, frame_.tool_length);
    }
    if (language::changes_machine(command_))
      trajectory_.start(trajectory_.end_position(), frame_.transformation, frame_.tool_length);
    frame_.start = trajectory_.end_position();
    if (moves_) moves_(command_, frame_);
    return true;
  }

  void settle() {
    trajectory_.finish();
    while (!trajectory_.at_rest()) {
      if (!step()) return;
    }
  }

  bool step() {
    if (result_.cycles >= most_) {
      result_.alarm = "The program has not ended after " + std::to_string(most_) + " cycles";
      return false;
    }
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

  setup::ChannelSetup& machine_;
  const std::function<void(const PlannedCycle&)>& sink_;
  const std::function<void(const Command&, const FrameMoves&)>& moves_;
  std::uint64_t most_;
  motion::Trajectory trajectory_;
  language::InterpreterOptions interpreting_;
  std::unique_ptr<language::Interpreter> interpreter_;
  Command command_;
  FrameMoves frame_;
  ProgramResult result_;
};

}  // namespace

ProgramResult run_program(language::TextSource& text, setup::ChannelSetup& machine, const AxisValues& start,
                          const std::function<void(const PlannedCycle&)>& sink,
                          const std::function<void(const Command&, const FrameMoves&)>& moves,
                          std::uint64_t most_cycles) {
  return std::make_unique<Runner>(machine, start, sink, moves, most_cycles)->run(text);
}

PlanReport plan_program(language::TextSource& text, setup::ChannelSetup& machine, const AxisValues& start,
                        const std::function<void(const PlannedCycle&)>& sink) {
  PlanReport report;
  const motion::Limits& limits = machine.limits();
  LimitCheck check(limits, start, machine.cycle_seconds());
  ContourCheck contour(start, limits.contour_tolerance, limits.orientation_tolerance);
  MachineModel model{limits, machine.chain(), machine.cycle_seconds()};
  FrameMoves group;
  group.start = start;
  const auto close = [&](const FrameMoves& next) {
    if (!group.commands.empty())
      report.bound +=
          command_bound(model, group.start, group.transformation, group.tool_length, group.commands);
    group = next;
    group.commands.clear();
    contour.jump(next.start);
  };
  report.result = run_program(
      text, machine, start,
      [&](const PlannedCycle& cycle) {
        check.add(cycle.machine, cycle.setpoint->rapid);
        const Deviation d = contour.of(cycle.position, cycle.setpoint->sequence);
        report.deviation.contour = std::max(report.deviation.contour, d.contour);
        report.deviation.orientation = std::max(report.deviation.orientation, d.orientation);
        if (sink) sink(cycle);
      },
      [&](const Command& command, const FrameMoves& frame) {
        if (!is_move(command)) return close(frame);
        group.commands.push_back(command);
        contour.add(command);
      });
  close(group);
  report.motion_time = static_cast<double>(check.moving_cycles()) * machine.cycle_seconds();
  report.axes = check.axes();
  return report;
}

}  // namespace trunnion::planning
