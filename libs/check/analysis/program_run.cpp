// SPDX-License-Identifier: Apache-2.0
#include "analysis/program_run.hpp"

#include <memory>

#include "motion/trajectory.hpp"
#include "program_execution/program_reader.hpp"

namespace trunnion::analysis {
namespace {

using language::Command;
using language::CommandKind;
using program_execution::Ending;

constexpr std::uint64_t cycles_between_stops = 256;

program_execution::ReadingOptions planning(program_execution::MoveGuard* guard) {
  program_execution::ReadingOptions options;
  options.guard = guard;
  options.find_repetition = false;
  return options;
}

// The channel's motion without a cluster: it steps while there is something to do.
class Runner final : public program_execution::ProgramMotion {
 public:
  Runner(channel_setup::ChannelSetup& machine, const std::function<void(const PlannedCycle&)>& sink,
         const std::function<void(const Command&, const FrameMoves&)>& moves, std::uint64_t most_cycles,
         program_execution::MoveGuard* guard, const std::function<bool()>& stop)
      : machine_(machine),
        sink_(sink),
        moves_(moves),
        most_(most_cycles),
        stop_(stop),
        trajectory_(machine.limits(), &machine.chain(), machine.cycle_seconds()),
        reader_(machine, planning(guard), this) {
    reader_.stop = stop;
    reader_.on_command = [this](const Command& command, const Command& move) { pass(command, move); };
  }

  ProgramResult run(language::TextSource& text, const AxisValues& start) {
    frame_.start = start;
    const Ending ending = reader_.read(text, start);
    result_.dialect = reader_.interpreter().dialect();
    switch (ending) {
      case Ending::end:
      case Ending::repeats:
        result_.good = true;
        break;
      case Ending::alarm:
        result_.alarm = reader_.alarm_text() + " (alarm " +
                        std::to_string(static_cast<unsigned>(reader_.alarm().number)) + ")";
        break;
      case Ending::returns:
        result_.alarm = "The program returns to earlier lines repeatedly and does not end";
        break;
      case Ending::idle:
        result_.alarm = "The program repeats without a move";
        break;
      case Ending::text_missing:
        result_.alarm = "The text ends in the middle of reading";
        break;
      case Ending::stopped:
        result_.stopped = result_.alarm.empty();
        break;
    }
    return result_;
  }

  motion::MoveTaker& moves() override { return trajectory_; }
  void prepare(program_execution::ProgramFlow& flow, bool tapping) override {
    flow.set_cycle(result_.cycles);
    // Axes that follow without delay are in position in the first cycle whose feedback can be known.
    trajectory_.set_position_check(
        machine_.checks_exact_stops() && !tapping ? static_cast<int>(machine_.lead()) + 2 : 0);
  }
  bool at_rest() const override { return trajectory_.at_rest(); }
  const AxisValues& position() const override { return trajectory_.position(); }
  void set_limits(const motion::Limits& limits) override { trajectory_.set_limits(limits); }

  bool step() override {
    if (stop_ && result_.cycles % cycles_between_stops == 0 && stop_()) return false;
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

 private:
  void pass(const Command& command, const Command& move) {
    if (is_move(move)) {
      ++result_.blocks;
    } else if (command.kind == CommandKind::end) {
      return;
    } else {
      frame_ = {trajectory_.position(), reader_.transformation(), reader_.tool_length()};
    }
    if (moves_) moves_(move, frame_);
  }

  channel_setup::ChannelSetup& machine_;
  const std::function<void(const PlannedCycle&)>& sink_;
  const std::function<void(const Command&, const FrameMoves&)>& moves_;
  std::uint64_t most_;
  const std::function<bool()>& stop_;
  motion::Trajectory trajectory_;
  program_execution::ProgramReader reader_;
  FrameMoves frame_;
  ProgramResult result_;
};

}  // namespace

bool is_move(const Command& command) {
  return command.kind == CommandKind::rapid || command.kind == CommandKind::line ||
         command.kind == CommandKind::arc || command.kind == CommandKind::dwell;
}

ProgramResult run_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                          const AxisValues& start, const std::function<void(const PlannedCycle&)>& sink,
                          const std::function<void(const Command&, const FrameMoves&)>& moves,
                          std::uint64_t most_cycles, program_execution::MoveGuard* guard,
                          const std::function<bool()>& stop) {
  return std::make_unique<Runner>(machine, sink, moves, most_cycles, guard, stop)->run(text, start);
}

}  // namespace trunnion::analysis
