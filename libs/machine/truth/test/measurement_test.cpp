// SPDX-License-Identifier: Apache-2.0
#include "truth/measurement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ac_report.hpp"
#include "circular_tests/ballbar_causes.hpp"

namespace trunnion::truth {
namespace {

TEST(Measurement, ABallbarWithNoiseStillFindsSquarenessAndBacklash) {
  const auto r = report("axes: {Y: {C0Y_urad: 40, EYY: [{reversal_um: -6}]}}\n");
  BallbarPath path;
  path.centre = {0, 0, -150};
  path.radius = 150;
  const auto exact = measure_ballbar(r, path, {});
  const auto causes = circular_tests::ballbar_causes(exact.ccw, exact.cw, path.radius);
  ASSERT_EQ(exact.ccw.size(), path.points);
  ASSERT_EQ(exact.cw.size(), path.points);
  EXPECT_NEAR(causes.squareness, 40e-6, 0.02 * 40e-6);
  EXPECT_NEAR(causes.reversal_second, 6e-3, 0.02 * 6e-3);
  EXPECT_NEAR(causes.reversal_first, 0, 1e-6);
  // 1 um of noise over 1440 readings of R / 2 sin 2a: 1e-3 * 2 / 150 * sqrt(2 / 1440) = 0.5 urad.
  const auto noisy = measure_ballbar(r, path, {1e-3, 1e-4, 3});
  EXPECT_NEAR(circular_tests::ballbar_causes(noisy.ccw, noisy.cw, path.radius).squareness, 40e-6, 5 * 0.5e-6);
}

TEST(Measurement, ALaserFindsScaleAndReversalOfAnAxis) {
  const auto r = report("axes: {X: {EXX: [{polynomial_um: [0, 25]}, {reversal_um: -4}]}}\n");
  LaserPlan plan;
  plan.from = -300, plan.to = 300;
  const auto measured = measure_laser(r, plan, {});
  ASSERT_EQ(measured.targets.size(), 11u);
  ASSERT_EQ(measured.targets[0].up.size(), 5u);
  // 25 um/m over 0.6 m, set to zero at the first target from below.
  EXPECT_NEAR(measured.targets[10].up[0], 15e-3, 1e-9);
  EXPECT_NEAR(measured.targets[10].down[0], 19e-3, 1e-9);
  EXPECT_NEAR(measured.accuracy.reversal, 4e-3, 1e-9);
  EXPECT_NEAR(measured.accuracy.mean_reversal, -4e-3, 1e-9);
  EXPECT_NEAR(measured.accuracy.repeatability, 4e-3, 1e-9) << "without noise it is the reversal";
  EXPECT_NEAR(measured.accuracy.accuracy, 19e-3, 1e-9);
}

TEST(Measurement, ALaserSeparatesStraightnessAndAngle) {
  const auto r =
      report("axes: {X: {EZX: [{polynomial_um: [0, 0, 100]}], EBX: [{polynomial_urad: [0, 60]}]}}\n");
  LaserPlan plan;
  plan.from = 0, plan.to = 300, plan.component = 2, plan.targets = 4;
  const auto straight = measure_laser(r, plan, {});
  // 100 um * 0.3^2; the angle moves the tip, which is at the reference point, by nothing.
  EXPECT_NEAR(straight.targets[3].up[0], 9e-3, 1e-9);
  plan.component = 4;
  EXPECT_NEAR(measure_laser(r, plan, {}).targets[3].up[0], 18e-6, 1e-11);
}

TEST(Measurement, TheNestSeesADisplacedTableAxisAsTwoCirclesOnOneAnother) {
  const auto r = report("axes: {C: {XOC_um: 20}}\n");
  const auto readings = measure_nest(r, 5, 0, 270, 4, {-100, -190, -400}, {});
  ASSERT_EQ(readings.size(), 4u);
  // The workpiece turns about an axis d beside the one the control knows: the ball is off by d - R(-C) d.
  const double d = 20e-3;
  const Vec3 expected[] = {{0, 0, 0}, {d, -d, 0}, {2 * d, 0, 0}, {d, d, 0}};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LE((readings[i].deviation - expected[i]).norm(), 1e-9) << readings[i].deviation.transpose();
}

}  // namespace
}  // namespace trunnion::truth
