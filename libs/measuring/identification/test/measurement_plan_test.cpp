// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing_support/refusal.hpp"

#include "ac_machine.hpp"

namespace trunnion::identification {
namespace {

using testing::HasSubstr;

const machine::MachineOutline& outline() {
  static const DrawnMachine machine("ac-table", "new_machine", 1);
  return machine.outline;
}

std::string refusal(const std::string& text) {
  return testing_support::refusal_of([&] { parse_plan(text, "plan.yaml", outline()); });
}

TEST(MeasurementPlan, ReadsItsKeys) {
  const auto plan = parse_plan(
      "tool_length_mm: 80\nmeasurements:\n"
      "  - {instrument: laser, error: EBX, from_mm: -100, to_mm: 200, points: 5, runs: 3, at_mm: [0, 1, 2],\n"
      "     uncertainty_urad: 2}\n"
      "  - {instrument: rtest, axis: C, tool_length_mm: 120}\n",
      "plan.yaml", outline());
  ASSERT_EQ(plan.measurements.size(), 2u);
  const auto& laser = plan.measurements[0];
  EXPECT_EQ(laser.laser.component, 4u);
  EXPECT_EQ(laser.laser.to, 200);
  EXPECT_EQ(laser.laser.runs, 3u);
  EXPECT_DOUBLE_EQ(laser.uncertainty, 2e-6);
  EXPECT_EQ(laser.tool_length, 80);
  EXPECT_EQ(plan.measurements[1].tool_length, 120);
  EXPECT_EQ(plan.measurements[1].axis, 5u);
}

TEST(MeasurementPlan, AFaultIsOneLineWithItsPlace) {
  const auto with = [](const std::string& entry) { return refusal("measurements:\n  - " + entry + "\n"); };
  EXPECT_THAT(refusal("measure: []"), HasSubstr("plan.yaml:1:1: error: unknown key 'measure'"));
  EXPECT_THAT(refusal("{}"), HasSubstr("measurements are missing"));
  EXPECT_THAT(refusal("structure: X\nmeasurements: []"), HasSubstr("plan.yaml:1:12: "));
  EXPECT_THAT(with("{instrument: lidar}"), HasSubstr("'lidar' is none of ballbar, laser, rtest"));
  EXPECT_THAT(with("{instrument: laser}"), HasSubstr("error is missing"));
  EXPECT_THAT(with("{instrument: laser, error: EXQ}"), HasSubstr("plan.yaml:2:32: error: 'EXQ'"));
  EXPECT_THAT(with("{instrument: laser, error: ECX}"), HasSubstr("does not move the tool's axis"));
  EXPECT_THAT(with("{instrument: laser, error: EXX, to_mm: 401}"),
              HasSubstr("401 is not within -400 .. 400"));
  EXPECT_THAT(with("{instrument: laser, error: EXX, uncertainty_urad: 1}"), HasSubstr("unknown key"));
  EXPECT_THAT(with("{instrument: rtest, axis: B}"), HasSubstr("the machine has no rotary axis 'B'"));
  EXPECT_THAT(with("{instrument: rtest, axis: A, from_deg: 5, to_deg: 5}"),
              HasSubstr("from_deg must be below"));
  EXPECT_THAT(
      with("{instrument: rtest, axis: C, from_deg: 10, to_deg: 300}"),
      HasSubstr("axis C counts modulo 360, so its table is that of a whole turn: to_deg must be 370"));
  EXPECT_THAT(with("{instrument: ballbar, points: 18}"), HasSubstr("a multiple of 4"));
}

TEST(LinearAxisErrors, HaveTheirNamesFromTheStandard) {
  const auto error = linear_axis_error("EBX");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->component, 4u);
  EXPECT_EQ(error->axis, 0u);
  for (const auto* name : {"", "EX", "EXXX", "AXX", "EXA", "EUX", "EX?"})
    EXPECT_FALSE(linear_axis_error(name)) << name;
  EXPECT_TRUE(laser_shows(*error, truth::Vec3::UnitZ()));
  EXPECT_FALSE(laser_shows(*error, truth::Vec3::UnitY()));
  EXPECT_TRUE(laser_shows(*linear_axis_error("EYX"), truth::Vec3::UnitY()));
}

}  // namespace
}  // namespace trunnion::identification
