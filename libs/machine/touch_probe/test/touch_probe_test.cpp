// SPDX-License-Identifier: Apache-2.0
#include "touch_probe/touch_probe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trunnion::touch_probe {
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
  const CylinderGauge cylinder{{0, 0, 5}, {0, 0, 1}, 10, 5};
  EXPECT_DOUBLE_EQ(signed_distance(cylinder, {0, 0, 5}), -5) << "the ends are nearer than the side";
  EXPECT_DOUBLE_EQ(signed_distance(cylinder, {13, 0, 14}), 5) << "from its edge: 3 and 4";
  EXPECT_DOUBLE_EQ(signed_distance(cylinder, {0, 12, 5}), 2);
}

TEST(Solid, ADistanceChangesNoFasterThanThePointMoves) {
  std::mt19937_64 engine(5);
  const auto random = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53 * 160 - 80; };
  for (const Solid& solid :
       {Solid(SphereGauge{}), Solid(CuboidGauge{}), Solid(RingGauge{}), Solid(CylinderGauge{}),
        Solid(SphereGauge{Vec3::Zero(), 12.5, Vec3(0, 0.6, -0.8), 5, 60})})
    for (int i = 0; i < 20000; ++i) {
      const Vec3 a(random(), random(), random()), b(random(), random(), random());
      EXPECT_LE(std::abs(signed_distance(solid, a) - signed_distance(solid, b)), (a - b).norm() + 1e-12);
    }
}

/// One probe and the place of the edge on its way, as the drive's latch would have it.
struct Touch {
  Touch(const TouchProbeTruth& truth, const Solid& solid) : probe(truth, {solid}) {}
  /// In `steps` even motions of `duration` s each; the ball at the edge.
  std::optional<Vec3> move(const Vec3& from, const Vec3& to, int steps = 1, double duration = 1) {
    probe.place({from});
    std::optional<Vec3> edge;
    for (int i = 1; i <= steps; ++i) {
      const Vec3 a = from + (i - 1.0) / steps * (to - from), b = from + 1.0 * i / steps * (to - from);
      if (const auto share = probe.move({b}, duration)) {
        EXPECT_FALSE(edge) << "a second edge";
        edge = a + *share * (b - a);
      }
    }
    return edge;
  }
  TouchProbe probe;
};

TEST(TouchProbe, TouchesAPlaneOneRadiusBeforeItAndOpensAfterThePreTravel) {
  TouchProbeTruth truth;
  truth.pre_travel = 0.012;
  // A cuboid whose face is at X = -25; the ball of 3 mm moves from: touch at X-28.
  for (const int steps : {1, 7, 20000}) {
    Touch touch(truth, CuboidGauge{});
    const auto edge = touch.move({-40, 0, 0}, {-20, 0, 0}, steps);
    ASSERT_TRUE(edge);
    EXPECT_NEAR(edge->x(), -27.988, 2e-9) << steps;
    EXPECT_TRUE(touch.probe.signal());
  }
}

TEST(TouchProbe, ObliquelyThePreTravelIsLongerAlongTheWay) {
  TouchProbeTruth truth;
  truth.pre_travel = 0.01;
  const auto edge = Touch(truth, CuboidGauge{}).move({-40, 0, 0}, {-20, 20, 0});
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->x(), -27.99, 2e-9);
}

TEST(TouchProbe, TheDelayAddsTimeAndTheRadiusOfASphereAddsToTheBall) {
  TouchProbeTruth truth;
  truth.delay = 0.002;
  // At 1000 mm/min the tip moves 0.0333 mm in 2 ms. It comes from above to a sphere of 12.5 mm.
  const double speed = 1000.0 / 60;
  for (const int steps : {1, 600}) {  // of 1 ms: the edge comes two motions behind the contact
    const auto edge = Touch(truth, SphereGauge{}).move({0, 0, 20}, {0, 0, 10}, steps, 10 / speed / steps);
    ASSERT_TRUE(edge);
    EXPECT_NEAR(edge->z(), 15.5 - speed * 0.002, 1e-8) << steps;
  }
}

TEST(TouchProbe, ABallThatLeavesTheSurfaceWithinTheDelayGivesNoEdge) {
  TouchProbeTruth truth;
  truth.delay = 0.01;
  TouchProbe probe(truth, {SphereGauge{}});
  probe.place({{0, 0, 16}});
  EXPECT_FALSE(probe.move({{0, 0, 15.4}}, 0.001));
  EXPECT_FALSE(probe.move({{0, 0, 16}}, 0.001));
  EXPECT_FALSE(probe.move({{0, 0, 17}}, 1));
  EXPECT_FALSE(probe.signal());
}

TEST(TouchProbe, TheSignalIsOnUntilTheBallIsOffTheSurfaceAndTheNextTouchHasItsOwnEdge) {
  TouchProbe probe({}, {SphereGauge{}});
  probe.place({{0, 0, 16}});
  EXPECT_TRUE(probe.move({{0, 0, 15}}, 1));
  EXPECT_FALSE(probe.move({{0, 0, 14.8}}, 1)) << "deeper is no edge";
  EXPECT_FALSE(probe.move({{0, 0, 15.5005}}, 1));
  EXPECT_TRUE(probe.signal()) << "0.5 um off the surface it has not reseated";
  EXPECT_FALSE(probe.move({{0, 0, 15.6}}, 1));
  EXPECT_FALSE(probe.signal());
  const auto edge = probe.move({{0, 0, 15.4}}, 1);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(*edge, 0.5, 1e-7);
}

TEST(TouchProbe, AContactThatIsThereFromTheBeginningHasNoEdge) {
  TouchProbe probe({}, {SphereGauge{}});
  probe.place({{0, 0, 15}});
  EXPECT_TRUE(probe.signal());
  EXPECT_FALSE(probe.move({{0, 0, 14}}, 1));
}

TEST(TouchProbe, LobesChangeThePreTravelThreeTimesAroundTheProbe) {
  TouchProbeTruth truth;
  truth.pre_travel = 0.01, truth.lobing = 0.003, truth.lobing_phase = 20;
  for (double direction = 5; direction < 360; direction += 15) {
    const double a = direction * std::numbers::pi / 180;
    const Vec3 out(std::cos(a), std::sin(a), 0);
    // From the middle of the ring outwards: the normal of the bore points inwards.
    const auto edge = Touch(truth, RingGauge{}).move(Vec3::Zero(), 30 * out);
    ASSERT_TRUE(edge);
    const double expected = 0.01 + 0.003 * std::cos(3 * (direction + 180 - 20) * std::numbers::pi / 180);
    EXPECT_NEAR(edge->norm() - 22, expected, 1e-7) << direction;
    // A probe that is turned by 30 degrees about its axis has its lobes there.
    TouchProbe turned(truth, {RingGauge{}});
    const double b = 30 * std::numbers::pi / 180;
    turned.place({Vec3::Zero(), {std::cos(b), std::sin(b), 0}});
    const auto share = turned.move({30 * out, {std::cos(b), std::sin(b), 0}}, 1);
    ASSERT_TRUE(share);
    EXPECT_NEAR(*share * 30 - 22,
                0.01 + 0.003 * std::cos(3 * (direction + 180 - 50) * std::numbers::pi / 180), 1e-7);
  }
}

TEST(TouchProbe, RepeatsWithinItsRepeatabilityAndItsSeed) {
  TouchProbeTruth truth;
  truth.pre_travel = 0.02, truth.repeatability = 0.001;
  TouchProbe a(truth, {CuboidGauge{}}), b(truth, {CuboidGauge{}});
  a.place({{0, 0, 40}}), b.place({{0, 0, 40}});
  double squares = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const auto share = a.move({{0, 0, 20}}, 1);
    ASSERT_TRUE(share);
    EXPECT_EQ(share, b.move({{0, 0, 20}}, 1));
    squares += std::pow(40 - 20 * *share - 27.98, 2);
    EXPECT_FALSE(a.move({{0, 0, 40}}, 1));
    EXPECT_FALSE(b.move({{0, 0, 40}}, 1));
  }
  // The standard error of a standard deviation of n values is sigma / sqrt(2 n).
  EXPECT_NEAR(std::sqrt(squares / n), 0.001, 5 * 0.001 / std::sqrt(2.0 * n));
}

TEST(TouchProbe, APassWithoutATouchAndARetreatOpenNothing) {
  EXPECT_FALSE(Touch({}, SphereGauge{}).move({-40, 0, 16}, {40, 0, 16})) << "0.5 mm above the ball's reach";
  EXPECT_FALSE(Touch({}, SphereGauge{}).move({0, 0, 15.6}, {0, 0, 30}));
  EXPECT_FALSE(Touch({}, SphereGauge{}).move({0, 0, 20}, {0, 0, 15.6}));
  EXPECT_FALSE(Touch({}, SphereGauge{}).move({0, 0, 20}, {0, 0, 20}));
}

TEST(TouchProbe, ALongMoveDoesNotPassThroughAThinPart) {
  // 80 mm in one motion through a shaft of 4 mm: touch 5 mm before its axis.
  const auto edge =
      Touch({}, CylinderGauge{Vec3::Zero(), Vec3::UnitZ(), 2, 50}).move({-40, 0, 0}, {40, 0, 0});
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->x(), -5, 1e-8);
}

TEST(TouchProbe, FaultsBeginAtTheirTouch) {
  TouchProbeTruth broken;
  broken.no_signal_from = 2;
  Touch wire(broken, SphereGauge{});
  EXPECT_TRUE(wire.move({0, 0, 20}, {0, 0, 10}));
  wire.probe.move({{0, 0, 20}}, 1);
  EXPECT_FALSE(wire.move({0, 0, 20}, {0, 0, 10}));
  EXPECT_FALSE(wire.probe.signal());
  TouchProbeTruth hasty;
  hasty.early = 2, hasty.early_from = 2;
  Touch early(hasty, SphereGauge{});
  EXPECT_NEAR(early.move({0, 0, 20}, {0, 0, 10})->z(), 15.5, 1e-8);
  early.probe.move({{0, 0, 16}}, 1);
  EXPECT_FALSE(early.probe.signal())
      << "the touch before was not early: 0.5 mm off the surface it has reseated";
  EXPECT_NEAR(early.move({0, 0, 20}, {0, 0, 10})->z(), 17.5, 1e-8);
}

}  // namespace
}  // namespace trunnion::touch_probe
