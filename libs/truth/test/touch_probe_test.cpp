// SPDX-License-Identifier: Apache-2.0
#include "truth/touch_probe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trunnion::truth {
namespace {

TEST(Solid, DistancesOfSphereCuboidAndRing) {
  EXPECT_DOUBLE_EQ(signed_distance(SphereGauge{{1, 2, 3}, 10}, {1, 2, 18}), 5);
  EXPECT_DOUBLE_EQ(signed_distance(SphereGauge{{1, 2, 3}, 10}, {1, 2, 4}), -9);
  const CuboidGauge cuboid{{0, 0, 0}, {10, 20, 30}};
  EXPECT_DOUBLE_EQ(signed_distance(cuboid, {13, 24, 0}), 5) << "from an edge: 3 and 4";
  EXPECT_DOUBLE_EQ(signed_distance(cuboid, {9, 0, 0}), -1);
  const RingGauge ring{{0, 0, 0}, {0, 0, 1}, 25, 60, 10};
  EXPECT_DOUBLE_EQ(signed_distance(ring, {15, 20, 0}), 0) << "on the bore";
  EXPECT_DOUBLE_EQ(signed_distance(ring, {0, 0, 0}), 25);
  EXPECT_DOUBLE_EQ(signed_distance(ring, {42.5, 0, 6}), -4);
  EXPECT_DOUBLE_EQ(signed_distance(ring, {0, 63, 14}), 5);
}

TEST(Solid, ADistanceChangesNoFasterThanThePointMoves) {
  std::mt19937_64 engine(5);
  const auto random = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53 * 160 - 80; };
  for (const Solid& solid : {Solid(SphereGauge{}), Solid(CuboidGauge{}), Solid(RingGauge{})})
    for (int i = 0; i < 20000; ++i) {
      const Vec3 a(random(), random(), random()), b(random(), random(), random());
      EXPECT_LE(std::abs(signed_distance(solid, a) - signed_distance(solid, b)), (a - b).norm() + 1e-12);
    }
}

TEST(TouchProbe, TouchesAPlaneOneRadiusBeforeItAndOpensAfterThePreTravel) {
  TouchProbeTruth truth;
  truth.pre_travel = 0.012;
  TouchProbe probe(truth);
  // A cuboid whose face is at X = -25; the ball of 3 mm moves from: touch at X-28.
  const auto edge = probe.move(CuboidGauge{}, {-40, 0, 0}, {-20, 0, 0}, 1);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->contact.x(), -28, 1e-8);
  EXPECT_NEAR(-40 + 20 * edge->share, -27.988, 1e-8);
}

TEST(TouchProbe, ObliquelyThePreTravelIsLongerAlongTheWay) {
  TouchProbeTruth truth;
  truth.pre_travel = 0.01;
  TouchProbe probe(truth);
  const Vec3 from(-40, 0, 0), to(-20, 20, 0);
  const auto edge = probe.move(CuboidGauge{}, from, to, 1);
  ASSERT_TRUE(edge);
  EXPECT_NEAR((from + edge->share * (to - from)).x(), -27.99, 1e-8);
}

TEST(TouchProbe, TheDelayAddsTimeAndTheRadiusOfASphereAddsToTheBall) {
  TouchProbeTruth truth;
  truth.delay = 0.002;
  TouchProbe probe(truth);
  // At 1000 mm/min the tip moves 0.0333 mm in 2 ms. It comes from above to a sphere of 12.5 mm.
  const double duration = 10 / (1000.0 / 60);
  const auto edge = probe.move(SphereGauge{}, {0, 0, 20}, {0, 0, 10}, duration);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(20 - 10 * edge->share, 15.5 - 1000.0 / 60 * 0.002, 1e-8);
}

TEST(TouchProbe, LobesChangeThePreTravelThreeTimesAround) {
  TouchProbeTruth truth;
  truth.pre_travel = 0.01, truth.lobing = 0.003, truth.lobing_phase = 20;
  TouchProbe probe(truth);
  for (double direction = 5; direction < 360; direction += 15) {
    const double a = direction * std::numbers::pi / 180;
    const Vec3 out(std::cos(a), std::sin(a), 0);
    // From the middle of the ring outwards: the normal of the bore points inwards.
    const auto edge = probe.move(RingGauge{}, Vec3::Zero(), 30 * out, 1);
    ASSERT_TRUE(edge);
    const double expected = 0.01 + 0.003 * std::cos(3 * (direction + 180 - 20) * std::numbers::pi / 180);
    EXPECT_NEAR(30 * edge->share - 22, expected, 1e-7) << direction;
  }
}

TEST(TouchProbe, RepeatsWithinItsRepeatabilityAndItsSeed) {
  TouchProbeTruth truth;
  truth.pre_travel = 0.02, truth.repeatability = 0.001;
  TouchProbe a(truth), b(truth);
  double squares = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const auto edge = a.move(CuboidGauge{}, {0, 0, 40}, {0, 0, 20}, 1);
    EXPECT_EQ(edge->share, b.move(CuboidGauge{}, {0, 0, 40}, {0, 0, 20}, 1)->share);
    squares += std::pow(40 - 20 * edge->share - 27.98, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / n), 0.001, 5 * 0.001 / std::sqrt(2.0 * n));
}

TEST(TouchProbe, APassWithoutATouchAndARetreatOpenNothing) {
  TouchProbe probe({});
  EXPECT_FALSE(probe.move(SphereGauge{}, {-40, 0, 16}, {40, 0, 16}, 1)) << "0.5 mm above the ball's reach";
  EXPECT_FALSE(probe.move(SphereGauge{}, {0, 0, 15.5}, {0, 0, 30}, 1));
  EXPECT_FALSE(probe.move(SphereGauge{}, {0, 0, 20}, {0, 0, 15.6}, 1));
  EXPECT_FALSE(probe.move(SphereGauge{}, {0, 0, 20}, {0, 0, 20}, 1));
}

}  // namespace
}  // namespace trunnion::truth
