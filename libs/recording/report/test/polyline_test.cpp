// SPDX-License-Identifier: Apache-2.0
#include "report/polyline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace trunnion::report {
namespace {

TEST(Polyline, DistanceToALineAndBeyondItsEnds) {
  Polyline path;
  path.start({0, 0, 0});
  path.add({{10, 0, 0}, 1, false});
  path.build();
  EXPECT_DOUBLE_EQ(path.nearest({5, 3, 4}, 0).distance, 5);
  EXPECT_EQ(path.nearest({5, 3, 4}, 0).point, Vec3(5, 0, 0));
  EXPECT_DOUBLE_EQ(path.nearest({13, 4, 0}, 0).distance, 5);
  EXPECT_DOUBLE_EQ(path.nearest({-3, 0, 4}, 0).distance, 5);
}

TEST(Polyline, APathWithoutLengthIsAPoint) {
  Polyline path;
  path.start({1, 2, 3});
  path.build();
  EXPECT_DOUBLE_EQ(path.nearest({1, 2, 5}, 7).distance, 2);
  path.add({{1, 2, 3}, 1, false});
  path.build();
  EXPECT_DOUBLE_EQ(path.nearest({1, 2, 5}, 0).distance, 2);
}

// The tree finds the same as a search over every piece, for any initial guess.
TEST(Polyline, FindsTheNearestPieceOfRandomPaths) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-10, 10);
  const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  for (int pieces : {1, 2, 7, 8, 9, 63, 200, 1000}) {
    Polyline path;
    path.start(point());
    for (int i = 0; i < pieces; ++i) path.add({point(), 0, false});
    path.build();
    for (int k = 0; k < 200; ++k) {
      const Vec3 p = 1.5 * point();
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < path.pieces().size(); ++i) {
        const Vec3& a = path.begin_of(i);
        const Vec3 d = path.pieces()[i].end - a;
        const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
        best = std::min(best, (p - a - t * d).norm());
      }
      const auto near = path.nearest(p, random() % (static_cast<unsigned>(pieces) + 5));
      EXPECT_NEAR(near.distance, best, 1e-12);
      EXPECT_NEAR((near.point - p).norm(), near.distance, 1e-12);
    }
  }
}

}  // namespace
}  // namespace trunnion::report
