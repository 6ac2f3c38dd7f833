// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/plan_report.hpp"

#include <algorithm>

#include "motion_analysis/offline_run.hpp"
#include "motion_analysis/time_scaling.hpp"

namespace trunnion::analysis {
namespace {

constexpr std::uint64_t no_limit = 100000000;  // cycles

}  // namespace

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
      [&](const language::Command& command, const FrameMoves& frame) {
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
