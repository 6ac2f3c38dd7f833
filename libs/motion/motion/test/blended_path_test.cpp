// SPDX-License-Identifier: Apache-2.0
#include "motion/blended_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trunnion::motion {
namespace {

BlendedPath polyline(const std::vector<AxisValues>& points, const BlendRules& rules) {
  BlendedPath path;
  for (std::size_t k = 1; k < points.size(); ++k) {
    PathBlock block;
    block.rules = rules;
    block.path = PathSegment::line(points[k - 1], points[k]);
    path.rate_join(block);
    block.stop = k == 1;
    path.push(block);
  }
  path.update(true);
  return path;
}

// The rounding of a right angle strays by |D| w / 6, |D| = sqrt 2: with 98 % of 0.01 mm w = 0.04158, and the
// point in the middle is at the corner + D w / 6.
TEST(BlendedPath, a_right_angle_uses_its_tolerance) {
  const BlendedPath path = polyline({{}, {10}, {10, 10}}, {0.01, 0.05});
  EXPECT_LE(path[1].reach, 0.0098 * 6 / std::sqrt(2.0) + 1e-12);
  EXPECT_GE(path[1].reach, 0.0098 * 6 / std::sqrt(2.0) * 0.85);
  const AxisValues middle = path.position(1, 10);
  EXPECT_NEAR(std::hypot(middle[0] - 10, middle[1]), std::sqrt(2.0) * path[1].reach / 6, 1e-12);
}

TEST(BlendedPath, derivatives_are_those_of_the_position_and_continuous_to_the_second) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<AxisValues> points{{}};
  for (int k = 1; k < 40; ++k)
    points.push_back({0.3 * k, 0.05 * unit(random), 0.05 * unit(random), 0.1 * k + 0.1 * unit(random)});
  const BlendedPath path = polyline(points, {0.02, 0.05});
  for (std::uint64_t index = 5; index < 30; ++index) {
    const double s = path[index].at;  // a join: where the programmed path has its corner
    const auto before = path.derivatives(index - 1, s, s - 1e-7),
               behind = path.derivatives(index, s, s + 1e-7);
    const double h = 1e-4, m = s + path[index].path.length() / 3;
    const auto there = path.derivatives(index, m, m);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(before[0][i], behind[0][i], 1e-9);
      EXPECT_NEAR(before[1][i], behind[1][i], 1e-9);
      const double ahead = path.position(index, m + h)[i], back = path.position(index, m - h)[i];
      EXPECT_NEAR(there[0][i], (ahead - back) / (2 * h), 1e-4);
      EXPECT_NEAR(there[1][i], (ahead - 2 * path.position(index, m)[i] + back) / (h * h), 5e-2);
    }
  }
}

TEST(BlendedPath, a_join_never_reaches_across_a_stop_or_the_end_and_tolerance_zero_has_no_reach_to_use) {
  std::vector<AxisValues> points{{}, {0.02}, {0.02, 0.03}};
  const BlendedPath path = polyline(points, {1, 1});
  EXPECT_LE(path[1].reach, 0.02);
  EXPECT_EQ(path.position(0, 0), points[0]);
  EXPECT_EQ(path.position(1, path.end()), points[2]);
  PathBlock block;
  block.rules = {0, 0};
  BlendedPath exact;
  block.path = PathSegment::line({}, {1});
  exact.rate_join(block);
  exact.push(block);
  block.path = PathSegment::line({1}, {1, 1});
  exact.rate_join(block);
  EXPECT_GE(block.weight, 1e290);
}

}  // namespace
}  // namespace trunnion::motion
