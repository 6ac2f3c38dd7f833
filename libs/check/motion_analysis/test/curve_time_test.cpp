// SPDX-License-Identifier: Apache-2.0
// Curves run as fast as the axes go, in points 0.1 mm apart and as arcs: time against the least there can be.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "acceleration_bound.hpp"
#include "motion_analysis/reference_paths.hpp"

namespace trunnion::analysis {
namespace {

using Curve = std::function<AxisValues(double)>;

struct DenseCase {
  const char* name;
  Curve curve;                                ///< by its parameter
  double velocity, acceleration, jerk, feed;  ///< of every axis, and programmed; mm, s
};

struct DensePath {
  std::vector<language::Command> program;
  std::vector<PathSample> samples;  ///< of the curve itself
  AxisValues start{};
};

// Points 0.1 mm of travel apart to second order, rounded to 0.0001 mm as a post-processor writes them. Only
// the samples of the bound are not rounded: over 0.1 mm that would count as curvature.
DensePath points_of(const Curve& curve, double length, double feed) {
  constexpr double step = 0.1, h = 1e-5;
  const auto speed = [&](double u) {
    const AxisValues a = curve(u), b = curve(u + h);
    return std::hypot(b[0] - a[0], b[1] - a[1]) / h;
  };
  const auto rounded = [](AxisValues p) {
    for (double& v : p) v = std::round(v * 1e4) / 1e4;
    return p;
  };
  DensePath path;
  path.start = rounded(curve(0));
  const int count = static_cast<int>(std::lround(length / step));
  double u = 0;
  for (int k = 0; k <= count; ++k) {
    path.samples.push_back({step * k, curve(u), feed});
    if (k > 0) {
      language::Command c;
      c.kind = language::CommandKind::line;
      c.line = c.sequence = static_cast<std::uint32_t>(k);
      c.target = rounded(curve(u));
      c.modal.feed = 60 * feed;
      path.program.push_back(c);
    }
    u += step / speed(u + 0.5 * step / speed(u));
  }
  return path;
}

Curve circle_of(double radius) {
  return [=](double u) { return AxisValues{radius * std::cos(u), radius * std::sin(u)}; };
}

Curve wave_of(double height, double pitch) {
  return [=](double u) { return AxisValues{u, height * std::sin(2 * std::numbers::pi * u / pitch)}; };
}

// The bound knows no jerk. A ramp to the speed v that reaches the acceleration a takes a / j longer for it,
// and half of that way is travelled at full speed in the meantime: both ramps cost a / j, at most 0.05 s of
// the 2.7 to 3.1 s here. Gaining speed level by level costs about as much again: 4 % in all, and 2 % are for
// the curves.
const DenseCase cases[] = {
    {"circle of R 300 mm at the speed of the axes", circle_of(300), 300, 3000, 60000, 500},
    {"circle of R 100 mm at the speed of weaker axes", circle_of(100), 100, 1000, 20000, 100},
    {"gentle wave at the speed of the axes", wave_of(1, 100), 300, 3000, 60000, 500},
    {"long wave at the speed of the axes", wave_of(5, 200), 300, 3000, 60000, 500},
    {"wave at the speed of strong axes", wave_of(2, 60), 250, 5000, 200000, 250},
};

constexpr double allowed = 1.06;  // time by that of the bound

TEST(DenseCurve, a_curve_in_short_chords_near_the_limits_is_close_to_the_time_optimal_sweep) {
  for (const DenseCase& c : cases) {
    SCOPED_TRACE(c.name);
    MachineModel machine;
    machine.limits = reference_limits();
    machine.limits.axes.fill({c.velocity, c.velocity, c.acceleration, c.jerk});
    const double length = 300 * c.velocity / 100;
    const DensePath path = points_of(c.curve, length, c.feed);
    const RunReport r =
        run_commands(machine, path.start, language::Transformation::none, 0, path.program, {}, 20000, false);
    EXPECT_TRUE(r.stopped);
    EXPECT_LE(r.worst.velocity, 1.001);
    EXPECT_LE(r.worst.acceleration, 1.001);
    EXPECT_LE(r.worst.jerk, 1.001);
    const double bound = acceleration_bound(path.samples, machine.limits);
    EXPECT_LE(r.motion_time, allowed * bound);
  }
}

// Full circles of the references' axes (3000 mm/s2, 60000 mm/s3, 500 mm/s), each axis by itself: least times
// from a barrier method over the square of the speed at 800 places, which does not know this planner. From
// the point where one axis stands still, and from 45 degrees beside it.
TEST(ArcTime, full_circles_are_within_2_percent_of_the_least_time_under_limits_of_each_axis) {
  struct Least {
    double radius, angle, time;
  };
  for (const Least& least : {Least{1, 0, 0.2205},
                             {3, 0, 0.3179},
                             {10, 0, 0.4832},
                             {10, -45, 0.4754},
                             {30, 0, 0.7711},
                             {100, 0, 1.4712}}) {
    const double angle = least.angle * std::numbers::pi / 180;
    ReferencePath p = circle(500);
    p.start = {least.radius * std::cos(angle), least.radius * std::sin(angle)};
    p.program.front().target = p.start;
    const RunReport r =
        run_commands(p.machine, p.start, p.transformation, p.tool_length, p.program, {}, 5000);
    SCOPED_TRACE(least.radius);
    EXPECT_TRUE(r.stopped);
    EXPECT_LE(r.worst.velocity, 1.001);
    EXPECT_LE(r.worst.acceleration, 1.001);
    EXPECT_LE(r.worst.jerk, 1.001);
    EXPECT_LE(r.deviation.contour, 1e-6);
    EXPECT_LE(r.motion_time, 1.02 * least.time);
  }
}

}  // namespace
}  // namespace trunnion::analysis
