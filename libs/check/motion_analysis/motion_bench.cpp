// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/motion_bench.hpp"

#include "motion_analysis/lower_bound.hpp"

namespace trunnion::analysis {
namespace {

constexpr double most_ratio = 1.001;

double acceleration_time(const ReferencePath& p) {
  return command_bound(p.machine, p.start, p.transformation, p.tool_length, p.program);
}

}  // namespace

std::vector<ReferenceCase> reference_cases() {
  const motion::AxisLimits axis = reference_limits().axes[0];
  std::vector<ReferenceCase> cases;
  // Peak speed v with v^2 / a + v a / j = 100 mm is 477.8 mm/s: 2 (v / a + a / j).
  cases.push_back({single_line(), 0.4186, "S-curve", 0.4206});
  // 50 mm at 100 mm/s with ramps of 2 sqrt(v / j), twice.
  cases.push_back({corner(0), 1.1633, "two S-curves", 1.1653});
  cases.push_back({corner(0.01), 1.1633, "two S-curves", 1.149});
  cases.push_back({corner(0.1), 1.1633, "two S-curves", 1.130});
  const double round = circle_time(10, axis.acceleration, axis.jerk);
  cases.push_back({circle(500), round, "centripetal and jerk", 1.03 * round});
  ReferencePath cap = wavy_cap(), dense = dense_three_axis();
  const double cap_time = acceleration_time(cap), feed_time = dense.feed_time;
  cases.push_back({std::move(cap), cap_time, "acceleration only", 1.06 * cap_time});
  cases.push_back({std::move(dense), feed_time, "feed only", 1.03 * feed_time});
  return cases;
}

ReferenceResult run_case(const ReferenceCase& reference) {
  const ReferencePath& p = reference.path;
  ReferenceResult result;
  result.run = run_commands(p.machine, p.start, p.transformation, p.tool_length, p.program);
  const RunReport& r = result.run;
  result.good = r.stopped && r.motion_time <= reference.allowed && r.worst.velocity <= most_ratio &&
                r.worst.acceleration <= most_ratio && r.worst.jerk <= most_ratio &&
                r.deviation.contour <= p.machine.limits.contour_tolerance + 1e-9 &&
                r.deviation.orientation <= p.machine.limits.orientation_tolerance;
  return result;
}

}  // namespace trunnion::analysis
