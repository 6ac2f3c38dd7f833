// SPDX-License-Identifier: Apache-2.0
// The checker is what everything else is judged by, so it is tried on motions whose answers are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "acceleration_bound.hpp"
#include "motion_analysis/contour_check.hpp"
#include "motion_analysis/limit_check.hpp"

namespace trunnion::analysis {
namespace {

motion::Limits limits_of(double velocity, double acceleration, double jerk) {
  motion::Limits limits;
  limits.axes.fill({velocity, 2 * velocity, acceleration, jerk});
  return limits;
}

// x = J t^3 / 6 with J = 6000: the third difference of a cubic is J exactly; after 1 s v = 3000, a = 6000.
TEST(LimitCheck, a_cubic_has_the_jerk_the_acceleration_and_the_velocity_of_its_derivatives) {
  LimitCheck check(limits_of(3000, 6000, 6000), {}, 0.001);
  for (int k = 1; k <= 1000; ++k) check.add({std::pow(k * 0.001, 3) * 1000}, false);
  EXPECT_NEAR(check.axes()[0].jerk, 1, 1e-4);
  EXPECT_NEAR(check.axes()[0].acceleration, 0.999, 1e-4);  // the mean over two cycles before the end
  EXPECT_NEAR(check.axes()[0].velocity, 0.999, 1e-4);
  EXPECT_EQ(check.axes()[1].jerk, 0);
}

TEST(LimitCheck, a_step_is_seen_in_every_derivative_and_rapid_has_its_own_limit) {
  LimitCheck feed(limits_of(100, 1e5, 1e8), {}, 0.001), rapid(limits_of(100, 1e5, 1e8), {}, 0.001);
  feed.add({0.1}, false);
  rapid.add({0.1}, true);
  EXPECT_NEAR(feed.worst().velocity, 1, 1e-12);
  EXPECT_NEAR(rapid.worst().velocity, 0.5, 1e-12);
  EXPECT_NEAR(feed.worst().acceleration, 1, 1e-12);
  EXPECT_NEAR(feed.worst().jerk, 1, 1e-12);
}

TEST(LimitCheck, motion_counts_from_the_first_to_the_last_change) {
  LimitCheck check(limits_of(100, 1000, 1e6), {}, 0.001);
  for (const double x : {0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0}) check.add({x}, false);
  EXPECT_EQ(check.moving_cycles(), 3U);
}

TEST(ContourCheck, distance_to_a_line_an_arc_and_the_turn_of_a_rotary_axis) {
  ContourCheck check({}, 0.01, 0.05);
  language::Command c;
  c.kind = language::CommandKind::line;
  c.sequence = 1;
  c.target = {10, 0, 0, 20};
  check.add(c);
  c.kind = language::CommandKind::arc;
  c.sequence = 2;
  c.target = {10, 20, 0, 20};
  c.arc = {language::Plane::xy, false, {10, 10, 0}, 180};
  check.add(c);
  EXPECT_NEAR(check.of({5, 0.003, 0, 10}, 1).contour, 0.003, 1e-9);
  // A leads by 0.5 degrees, which is 0.25 mm of travel: nowhere are both closer than a mixture of the two.
  const Deviation off = check.of({5, 0, 0, 10.5}, 1);
  EXPECT_NEAR(off.contour / 0.01, off.orientation / 0.05, 1e-3);
  EXPECT_NEAR(off.orientation + 2 * off.contour, 0.5, 1e-6);
  EXPECT_NEAR(check.of({20.02, 10, 0, 20}, 2).contour, 0.02, 1e-9);
}

// 100 mm at 3000 mm/s^2 up to 500 mm/s: 83.33 mm of ramps in 0.3333 s, 16.67 mm in 0.0333 s.
// The circle begins where it ends, and which of the two is nearer in floating point depends on its centre.
TEST(ContourCheck, just_behind_the_start_and_before_the_end_of_a_full_circle_is_on_it) {
  for (const double x : {0.0, 14.0, -3.7, 1e3}) {
    for (const bool clockwise : {true, false}) {
      AxisValues start{x, 19, -100};
      ContourCheck check(start, 0.01, 0.05);
      language::Command c;
      c.kind = language::CommandKind::arc;
      c.sequence = 1;
      c.target = start;
      c.arc.centre = {x + 2, 19, -100};
      c.arc.sweep = 360;
      c.arc.clockwise = clockwise;
      check.add(c);
      for (const double angle : {0.0256, -0.0256})
        EXPECT_LT(check.of({x + 2 - 2 * std::cos(angle), 19 - 2 * std::sin(angle), -100}, 1).contour, 1e-6);
    }
  }
}

TEST(LowerBound, a_line_takes_the_time_of_its_trapezoid) {
  std::vector<PathSample> path;
  for (int k = 0; k <= 2000; ++k) path.push_back({0.05 * k, {0.05 * k}, 500});
  EXPECT_NEAR(acceleration_bound(path, limits_of(500, 3000, 6e4)), 0.36667, 2e-4);
}

// A circle of R 10 with 3000 mm/s^2 on each axis cannot be run faster than sqrt(a R) = 173.2 mm/s for long;
// the bound of two revolutions is close to that and not above (at 45 degrees the axes together allow more).
TEST(LowerBound, a_circle_is_bound_by_the_centripetal_acceleration) {
  std::vector<PathSample> path;
  const double length = 40 * std::numbers::pi;
  for (int k = 0; k <= 4000; ++k) {
    const double f = 4 * std::numbers::pi * k / 4000;
    path.push_back({length * k / 4000, {10 * std::cos(f), 10 * std::sin(f)}, 1e6});
  }
  const double time = acceleration_bound(path, limits_of(500, 3000, 6e4));
  EXPECT_LT(time, length / 173.2 + 0.06);
  EXPECT_GT(time, length / 173.2 * 0.95);
}

}  // namespace
}  // namespace trunnion::analysis
