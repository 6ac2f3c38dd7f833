// SPDX-License-Identifier: Apache-2.0
// Distances against closed forms and against projections from one body to the other.
#include "collision/shape_distance.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>

#include "geometry/random_source.hpp"
#include "projected_distance.hpp"
#include "touch_probe/solid.hpp"

namespace trunnion::collision {
namespace {

constexpr double tolerance = 0.002;  // mm, as stated

double distance(const Shape& a, const Placement& pa, const Shape& b, const Placement& pb) {
  Vec3 on_a, on_b;
  const double found = distance_between(ShapeGeometry(a), pa, ShapeGeometry(b), pb, on_a, on_b);
  if (found > 0) {
    EXPECT_NEAR((on_a - on_b).norm(), found, 1e-3);
  }
  return found;
}

struct Random {
  geometry::RandomSource source;
  double operator()(double low, double high) { return low + (high - low) * source.uniform(); }
  Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  Placement placement(double size) {
    Eigen::Quaterniond q((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
    return {q.normalized().toRotationMatrix(), vector(size)};
  }
};

Hull hull_of(const Vec3& half) {
  Hull hull;
  for (int i = 0; i < 8; ++i)
    hull.points.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                             i & 4 ? half.z() : -half.z());
  return hull;
}

TEST(ShapeDistance, OfASphereFromABoxACylinderAndAHullInClosedForm) {
  Random random{geometry::RandomSource(3)};
  int overlapping = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 half(random(1, 200), random(1, 200), random(0.5, 60));
    const double radius = random(0.5, 20), size = 120;
    const auto place = random.placement(size), ball = random.placement(size);
    const touch_probe::CuboidGauge box{place.translation, half, place.rotation};
    const touch_probe::CylinderGauge cylinder{place.translation, place.rotation.col(2), half.x(), half.z()};
    const double to_box = touch_probe::signed_distance(touch_probe::Solid(box), ball.translation) - radius;
    const double to_cylinder =
        touch_probe::signed_distance(touch_probe::Solid(cylinder), ball.translation) - radius;
    overlapping += to_box < 0;
    for (const auto& [shape, expected] : {std::pair<Shape, double>{Box{half}, to_box},
                                          {hull_of(half), to_box},
                                          {Cylinder{half.x(), half.z()}, to_cylinder}}) {
      const double found = distance(shape, place, Sphere{radius}, ball);
      if (expected > tolerance) {
        ASSERT_NEAR(found, expected, tolerance) << i << ", shape " << shape.index();
      } else {
        ASSERT_LE(found, tolerance) << i << ", shape " << shape.index();
      }
    }
  }
  EXPECT_GT(overlapping, 100);
}

TEST(ShapeDistance, OfBoxesAndCylindersAsProjectionsFromOneToTheOtherFindIt) {
  Random random{geometry::RandomSource(5)};
  int apart = 0;
  for (int i = 0; i < 150; ++i) {
    const auto shape = [&]() -> Shape {
      if (random(0, 1) < 0.5) return Box{Vec3(random(1, 100), random(1, 100), random(1, 100))};
      return Cylinder{random(1, 80), random(1, 120)};
    };
    const Shape a = shape(), b = shape();
    const auto pa = random.placement(200), pb = random.placement(200);
    const double expected = projected_distance(a, pa, b, pb, 2000), found = distance(a, pa, b, pb);
    if (expected < 1) continue;  // slow convergence near a contact
    ++apart;
    ASSERT_LE(found, expected + tolerance) << i;
    ASSERT_GE(found, expected - 0.01) << i << ": the projections are not finished";
  }
  EXPECT_GT(apart, 70);
}

TEST(ShapeDistance, OfSpheresIsNegativeByTheDepth) {
  EXPECT_NEAR(distance(Sphere{10}, {}, Sphere{5}, {Mat3::Identity(), Vec3(12, 0, 0)}), -3, 1e-9);
  EXPECT_NEAR(distance(Sphere{10}, {}, Sphere{5}, {Mat3::Identity(), Vec3(0, 16, 0)}), 1, 1e-9);
}

TEST(ShapeDistance, OfBodiesThatOverlapIsNeverAboveZero) {
  Random random{geometry::RandomSource(8)};
  for (int i = 0; i < 2000; ++i) {
    const Shape a = Cylinder{random(1, 80), random(1, 120)}, b = Box{Vec3(random(1, 90), random(1, 90), 20)};
    auto pa = random.placement(50), pb = random.placement(50);
    // A common point: the centre of b is in a.
    pb.translation = pa * Vec3(random(-0.6, 0.6) * std::get<Cylinder>(a).radius, 0,
                               random(-0.9, 0.9) * std::get<Cylinder>(a).half_height);
    ASSERT_LE(distance(a, pa, b, pb), 0) << i;
  }
}

TEST(ShapeDistance, BoundsContainTheShape) {
  const ShapeGeometry hull(Hull{{{0, 0, 0}, {10, 0, 0}, {0, 20, 0}, {0, 0, 30}, {2, 2, 2}}});
  EXPECT_EQ(hull.centre(), Vec3(5, 10, 15));
  // The farthest point from X5 Y10 Z15 is a corner, sqrt(5^2 + 10^2 + 15^2) away.
  EXPECT_NEAR(hull.radius(), std::sqrt(350.0), 1e-12);
  EXPECT_EQ(hull.corners()[7], Vec3(10, 20, 30));
  EXPECT_NEAR(ShapeGeometry(Cylinder{3, 4}).radius(), 5, 1e-12);
}

}  // namespace
}  // namespace trunnion::collision
