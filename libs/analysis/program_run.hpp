// SPDX-License-Identifier: Apache-2.0
// A program text through interpreter and planner without a cluster, as the channel would run it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/offline_run.hpp"
#include "analysis/place_cost.hpp"
#include "channel_setup/channel_setup.hpp"
#include "language/interpreter.hpp"
#include "program_execution/move_guard.hpp"

namespace trunnion::analysis {

/// What would be sent in one cycle.
struct PlannedCycle {
  std::uint64_t cycle = 0;
  AxisValues machine{};   ///< axes after the transformation
  AxisValues tip{};       ///< X Y Z of the tool tip, rotary axes
  AxisValues position{};  ///< in the frame of the commands
  const motion::Setpoint* setpoint = nullptr;
};

/// What the moves between two places where the axes stand for another reason than the path begin with.
struct FrameMoves {
  AxisValues start{};
  language::Transformation transformation = language::Transformation::none;
  double tool_length = 0;
};

struct ProgramResult {
  bool good = false;         ///< ended without an alarm
  bool stopped = false;      ///< `stop` has ended it
  std::string alarm;         ///< one line, empty when good
  std::uint64_t blocks = 0;  ///< moves and dwells planned
  std::uint64_t cycles = 0;
};

/// Runs `text` from the machine position `start`: every cycle goes to `sink`, every stretch of moves to
/// `frames`, before its cycles; both may be empty. `most_cycles` ends a program that does not. `guard` looks
/// at the moves as in the channel; it may be null. `stop` is asked every few hundred cycles, where the axes
/// stand, and while a program repeats without a move; when it is true the run ends there.
ProgramResult run_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                          const AxisValues& start, const std::function<void(const PlannedCycle&)>& sink,
                          const std::function<void(const language::Command&, const FrameMoves&)>& moves,
                          std::uint64_t most_cycles = 100000000,
                          program_execution::MoveGuard* guard = nullptr,
                          const std::function<bool()>& stop = {});

/// Everything the command `plan` reports.
struct PlanReport {
  ProgramResult result;
  double motion_time = 0;           ///< s, from the first to the last change of any axis
  double bound = 0;                 ///< s, of acceleration_bound over the moves
  double least_time = 0;            ///< s, of LeastTime over the planned motion: its path under all limits
  std::vector<CostlyPlace> places;  ///< that cost most, the costliest first
  std::array<AxisRatios, language::axis_count> axes{};
  Deviation deviation;
};

PlanReport plan_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                        const AxisValues& start, const std::function<void(const PlannedCycle&)>& sink,
                        program_execution::MoveGuard* guard = nullptr);

}  // namespace trunnion::analysis
