// SPDX-License-Identifier: Apache-2.0
#include "core/planned_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trunnion::gateway {
namespace {

constexpr double tau = 6.283185307179586;

PathPoint at(double x, double y, double seconds, std::uint32_t line = 1, bool rapid = false) {
  return {{x, y, 0}, line, rapid, seconds};
}

/// Of a point, from the polyline.
double distance(const std::vector<PathPoint>& points, const Eigen::Vector3d& p) {
  double least = 1e9;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector3d a = points[i - 1].tip, way = points[i].tip - a;
    const double share =
        way.squaredNorm() > 0 ? std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
    least = std::min(least, (p - a - share * way).norm());
  }
  return least;
}

TEST(PlannedPath, OfAStraightLineKeepsItsEnds) {
  PlannedPath path(100);
  for (int i = 0; i <= 1000; ++i) path.add(at(0.01 * i, 0, i));
  const auto points = path.points();
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1].tip.x(), 10);
  EXPECT_EQ(points[1].seconds, 1000);
}

TEST(PlannedPath, IsNowhereFartherFromTheMotionThanItsToleranceAllows) {
  PlannedPath path(10000, 0.01);
  std::vector<PathPoint> all;
  for (int i = 0; i <= 5000; ++i) {
    const double angle = tau * i / 5000;
    all.push_back(at(50 * std::cos(angle), 20 * std::sin(2 * angle), i));
    path.add(all.back());
  }
  const auto points = path.points();
  EXPECT_LT(points.size(), 500u);
  // A strip is as wide as the tolerance on both sides of its direction, and ends somewhere in it: the line
  // between its ends is at most two tolerances from what it leaves out.
  for (const auto& one : all) EXPECT_LE(distance(points, one.tip), 0.02) << one.seconds;
}

TEST(PlannedPath, KeepsTheEndOfEachLineAndTurnsBack) {
  PlannedPath path(100);
  for (int i = 0; i <= 10; ++i) path.add(at(i, 0, i, i < 5 ? 1 : 2, i < 5));
  for (int i = 11; i <= 20; ++i) path.add(at(20 - i, 0, i, 2));
  const auto points = path.points();
  ASSERT_EQ(points.size(), 4u);
  EXPECT_EQ(points[1].tip.x(), 4);
  EXPECT_TRUE(points[1].rapid);
  EXPECT_EQ(points[1].line, 1u);
  EXPECT_EQ(points[2].tip.x(), 10) << "the turning point";
  EXPECT_FALSE(points[2].rapid);
  EXPECT_EQ(points[3].tip.x(), 0);
  EXPECT_TRUE(path.whole());
}

TEST(PlannedPath, OfManyLinesHasFewerPointsThanAllowedAndSaysHowCoarseItIs) {
  PlannedPath path(200, 0.01);
  for (int i = 0; i < 100000; ++i) {
    const double angle = tau * i / 1000;
    path.add(at((50 - i / 4000.0) * std::cos(angle), (50 - i / 4000.0) * std::sin(angle), i, 1 + i / 3));
  }
  EXPECT_LT(path.points().size(), 201u);
  EXPECT_GT(path.points().size(), 20u);
  EXPECT_FALSE(path.whole());
  EXPECT_GT(path.tolerance(), 0.01);
  EXPECT_EQ(path.points().back().seconds, 99999);
}

}  // namespace
}  // namespace trunnion::gateway
