// SPDX-License-Identifier: Apache-2.0
// A program text through interpreter and planner without a cluster, as the channel would run it.
#pragma once

#include <functional>
#include <string>

#include "channel_setup/channel_setup.hpp"
#include "language/interpreter.hpp"
#include "motion/interpolation.hpp"
#include "program_execution/move_guard.hpp"

namespace trunnion::analysis {

using language::AxisValues;

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
  language::ProgramDialect dialect = language::ProgramDialect::iso;  ///< of the text
};

/// A rapid, line, arc or dwell.
bool is_move(const language::Command& command);

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

}  // namespace trunnion::analysis
