// SPDX-License-Identifier: Apache-2.0
#include "calibration/virtual_gauges.hpp"

#include <gtest/gtest.h>

#include "calibration/virtual_dial.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration::virtual_gauges_test {
namespace {

MeasurementInputs expected() {
  MeasurementInputs inputs;
  inputs.probe_length = 150, inputs.ball_diameter = 5;
  inputs.sphere = Vec3(1, 2, 3), inputs.sphere_diameter = 20;
  return inputs;
}

TEST(VirtualGauges, AreAsExpectedWithoutATruth) {
  const auto probe = true_probe({}, expected(), {});
  EXPECT_EQ(probe.length, 150);
  EXPECT_EQ(probe.ball_radius, 2.5);
  EXPECT_EQ(probe.repeatability, 0);
  const auto solids = true_solids({}, expected(), {});
  ASSERT_EQ(solids.size(), 1u);
  EXPECT_EQ(std::get<touch_probe::SphereGauge>(solids[0]).radius, 10);
}

TEST(VirtualGauges, AreThoseOfTheTruthWithTheChanges) {
  truth::Truth truth;
  truth.probe.emplace();
  truth.probe->length = 180, truth.probe->pre_travel = 0.004;
  truth.solids.push_back(touch_probe::SphereGauge{Vec3(5, 5, 5), 12});
  GaugeChanges changes;
  changes.repeatability = 0.001, changes.seed = 7, changes.sphere = Vec3(6, 5, 5);
  const auto probe = true_probe(truth, expected(), changes);
  EXPECT_EQ(probe.length, 180);
  EXPECT_EQ(probe.pre_travel, 0.004);
  EXPECT_EQ(probe.repeatability, 0.001);
  EXPECT_EQ(probe.seed, 7u);
  const auto solids = true_solids(truth, expected(), changes);
  ASSERT_EQ(solids.size(), 1u);
  const auto& sphere = std::get<touch_probe::SphereGauge>(solids[0]);
  EXPECT_EQ(sphere.radius, 12);
  EXPECT_EQ(sphere.centre.x(), 6);
}

ChainParameters table(double y) {
  ChainParameters p;
  p.table_1 = geometry::RotaryAxis{{-1, 0, 0}, {0, y, 0}, 0};
  p.table_2 = geometry::RotaryAxis{{0, 0, -1}, {-200, -190, -516}, 2};
  return p;
}

// 0.4 mm of A move the ball by more than 0.02 mm; the displacement is linear in the offsets.
TEST(VirtualChecks, CorrectTheModelUntilItIsAccepted) {
  const TrueMachine machine(table(0.1), table(0.5));
  VirtualCheck check;
  check.place = Vec3(-140, -150, -420);
  const auto checks = check_and_correct(ManualKind::ac_table, machine.report, machine.measured.model, check);
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_FALSE(checks[0].acceptance.accepted());
  EXPECT_TRUE(checks[1].acceptance.accepted());
  EXPECT_NEAR(checks[1].model.table_1->offset.y(), 0.1, 1e-8);
}

TEST(VirtualChecks, CompareRtcpBeforeAndAfter) {
  const TrueMachine machine(table(0.1), table(0.5));
  auto inputs = expected();
  inputs.sphere = Vec3(-140, -150, -420);
  AxisRange a;
  a.angle = 0, a.start = -30, a.end = 30;
  inputs.axes = {a};
  const auto check = check_rtcp(machine.report, machine.measured, inputs, table(0.5), table(0.1), 20, 1);
  EXPECT_EQ(check.poses, 20u);
  EXPECT_GT(check.before.root_mean_square, 0.01);
  EXPECT_LT(check.after.root_mean_square, 1e-8);
}

}  // namespace
}  // namespace trunnion::calibration::virtual_gauges_test
