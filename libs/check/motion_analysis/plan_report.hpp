// SPDX-License-Identifier: Apache-2.0
// A program as it is planned, with its times, its costly places, the use of the limits and its deviations.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "analysis/program_run.hpp"
#include "motion_analysis/contour_check.hpp"
#include "motion_analysis/limit_check.hpp"
#include "motion_analysis/place_cost.hpp"

namespace trunnion::analysis {

/// Everything the command `plan` reports.
struct PlanReport {
  ProgramResult result;
  double motion_time = 0;           ///< s, from the first to the last change of any axis
  double bound = 0;                 ///< s, of AccelerationBound over the moves
  double least_time = 0;            ///< s, of LeastTime over the planned motion: its path under all limits
  std::vector<CostlyPlace> places;  ///< that cost most, the costliest first
  std::array<AxisRatios, language::axis_count> axes{};
  Deviation deviation;
};

PlanReport plan_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                        const AxisValues& start, const std::function<void(const PlannedCycle&)>& sink,
                        program_execution::MoveGuard* guard = nullptr);

}  // namespace trunnion::analysis
