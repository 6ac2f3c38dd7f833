// SPDX-License-Identifier: Apache-2.0
// A program of canonical commands through the planner without a cluster, with everything that is judged.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "motion/trajectory.hpp"
#include "motion_analysis/contour_check.hpp"
#include "motion_analysis/limit_check.hpp"
#include "motion_analysis/lower_bound.hpp"

namespace trunnion::analysis {

/// What a path is run with: limits, transformation, cycle.
struct MachineModel {
  motion::Limits limits;
  std::optional<geometry::Chain> chain;  ///< Transformation::rtcp goes through it
  double cycle_seconds = 0.001;
};

/// Overrides of cycle k.
using OverrideHistory = std::function<motion::Overrides(std::size_t cycle)>;

struct RunReport {
  bool stopped = false;    ///< came to rest by itself on the last point
  double motion_time = 0;  ///< s, from the first to the last change of any axis
  std::size_t cycles = 0;
  std::array<AxisRatios, language::axis_count> axes{};
  AxisRatios worst;
  Deviation deviation;  ///< largest of the run
};

/// Runs `program` (moves and dwells of one frame) from `start` under `overrides` for at most `most_cycles`.
RunReport run_commands(const MachineModel& machine, const AxisValues& start,
                       language::Transformation transformation, double tool_length,
                       const std::vector<language::Command>& program, const OverrideHistory& overrides = {},
                       std::size_t most_cycles = 10000000, bool check_contour = true);

/// AccelerationBound of the same program, sampled every `step` mm (or degrees) or closer; rapids
/// and feeds as programmed at override 1.
double command_bound(const MachineModel& machine, const AxisValues& start,
                     language::Transformation transformation, double tool_length,
                     const std::vector<language::Command>& program, double step = 0.1);

/// The same command after command, in constant memory.
class CommandBound {
 public:
  /// `machine` must outlive the bound.
  explicit CommandBound(const MachineModel& machine) : machine_(machine), bound_(machine.limits) {}
  void begin(const AxisValues& start, language::Transformation transformation, double tool_length);
  void add(const language::Command& command, double step = 0.1);
  /// Seconds of the commands since begin().
  double finish() { return bound_.finish(); }

 private:
  const MachineModel& machine_;
  AccelerationBound bound_;
  const geometry::Chain* active_ = nullptr;
  double tool_length_ = 0, s_ = 0;
  AxisValues end_{};
};

}  // namespace trunnion::analysis
