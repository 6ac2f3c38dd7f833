// SPDX-License-Identifier: Apache-2.0
// The reference motions with their numbers, and the limits under overrides and holds at random cycles.
#include <gtest/gtest.h>

#include <random>

#include "motion_analysis/lower_bound.hpp"
#include "motion_analysis/reference_paths.hpp"
#include "testing_support/rounds.hpp"

namespace trunnion::analysis {
namespace {

RunReport run(const ReferencePath& p, const OverrideHistory& overrides = {}) {
  const RunReport r = run_commands(p.machine, p.start, p.transformation, p.tool_length, p.program, overrides);
  EXPECT_TRUE(r.stopped) << p.name;
  EXPECT_LE(r.worst.velocity, 1.001) << p.name;
  EXPECT_LE(r.worst.acceleration, 1.001) << p.name;
  EXPECT_LE(r.worst.jerk, 1.001) << p.name;
  EXPECT_LE(r.deviation.contour, p.machine.limits.contour_tolerance + 1e-9) << p.name;
  EXPECT_LE(r.deviation.orientation, p.machine.limits.orientation_tolerance) << p.name;
  return r;
}

// Peak speed v with v^2 / 3000 + v / 20 = 100 is 477.8: 2 (477.8 / 3000 + 0.05) = 0.4186 s; cycles round up.
TEST(Reference, a_line_of_100_mm_takes_the_time_of_its_s_curve) {
  EXPECT_NEAR(run(single_line()).motion_time, 0.4186, 0.002);
}

// A circle of R 10 mm with 3000 mm/s2 and 60000 mm/s3. Centripetal: v = sqrt(3000 * 10) = 173.2 mm/s, where
// the circle alone takes v^3 / r^2 = 51,960 of the jerk. 62.832 / 173.2 = 0.3628 s; a ramp with nothing but
// its own acceleration and jerk adds v / a + a / j = 0.1077 s in all: 0.4705 s. But the ramps share the
// limits with the circle: of the jerk 3 v u / r goes across the path when the speed grows by u, so at 100
// mm/s u may be 2000 at most and at 173.2 mm/s only 8,040 mm/s3 are left along the path. With that each ramp
// takes 0.1786 s over 19.64 mm: 2 * 0.1786 + (62.832 - 2 * 19.64) / 173.2 = 0.4932 s.
TEST(Reference, a_circle_is_within_3_percent_of_its_centripetal_and_jerk_bound) {
  const double bound = circle_time(10, 3000, 60000);
  EXPECT_NEAR(bound, 0.4932, 0.0005);
  EXPECT_LE(run(circle(500)).motion_time, 1.03 * bound);
}

// 50 mm at 100 mm/s with ramps of 2 sqrt(100 / 60000) s = 81.65 ms: 0.58165 s each. Overlapping by
// 2 (6 tol / 60000)^(1/3) gains 20 and 43 ms; three quarters of it are asked for.
TEST(Reference, a_corner_is_as_fast_as_its_tolerance_allows) {
  EXPECT_NEAR(run(corner(0)).motion_time, 1.1633, 0.002);
  EXPECT_LE(run(corner(0.01)).motion_time, 1.149);
  EXPECT_LE(run(corner(0.1)).motion_time, 1.130);
}

TEST(Reference, a_five_axis_path_stays_close_to_the_bound_without_jerk) {
  const ReferencePath p = wavy_cap(100);
  const double bound = command_bound(p.machine, p.start, p.transformation, p.tool_length, p.program);
  EXPECT_LE(run(p).motion_time, 1.06 * bound);
}

TEST(Reference, a_dense_path_runs_at_its_feed) {
  const ReferencePath p = dense_three_axis(100);
  EXPECT_LE(run(p).motion_time, 1.03 * p.feed_time);
}

TEST(Reference, limits_hold_under_any_overrides_and_holds) {
  for (std::uint64_t seed = 1; seed <= testing_support::rounds(24); ++seed) {
    std::mt19937_64 random(seed);
    const ReferencePath p = seed % 4 == 0   ? wavy_cap(20)
                            : seed % 4 == 1 ? dense_three_axis(20)
                            : seed % 4 == 2 ? corner(0.05)
                                            : circle(200);
    const std::uint64_t pause = 1 + random() % 120;
    motion::Overrides now;
    run(p, [&](std::size_t) {
      if (random() % pause == 0) now.feed = 1.5 * static_cast<double>(random() % 6) / 5;
      if (random() % pause == 0) now.hold = random() % 3 == 0;
      return now;
    });
  }
}

TEST(Reference, an_override_of_zero_for_long_loses_nothing) {
  const RunReport r = run(corner(0.01), [](std::size_t cycle) {
    return motion::Overrides{cycle > 300 && cycle < 200000 ? 0.0 : 1.0, 1, false};
  });
  EXPECT_GT(r.motion_time, 199);
}

}  // namespace
}  // namespace trunnion::analysis
