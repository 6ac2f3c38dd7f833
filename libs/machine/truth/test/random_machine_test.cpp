// SPDX-License-Identifier: Apache-2.0
#include "truth/random_machine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "outline.hpp"

namespace trunnion::truth {
namespace {

const Grade& grade(const std::string& name) {
  for (const auto& g : grades())
    if (g.name == name) return g;
  throw std::runtime_error(name);
}

TEST(RandomMachine, ASeedGivesTheSameBitsAndAnotherSeedAnotherMachine) {
  MachinePose pose;
  pose.positions = {120, -80, -200, 30, 0, 70, 0, 0, 0};
  pose.approach = {1, -1, 1, 1, 0, -1, 0, 0, 0};
  pose.tool_length = 120;
  const auto tip = [&](std::uint64_t seed) {
    const auto made = TrueGeometry::make(ac.design, draw_machine(grade("worn_trunnion"), seed, ac));
    return std::get<TrueGeometry>(made).pose(pose).tip;
  };
  EXPECT_EQ(tip(7), tip(7));
  EXPECT_GT((tip(7) - tip(8)).norm(), 1e-4);
}

TEST(RandomMachine, TheErrorsHaveTheDeviationsOfTheirGrade) {
  const Grade& g = grade("worn_trunnion");
  constexpr int machines = 400;
  double squareness = 0, straightness = 0, tilt = 0;
  for (int seed = 0; seed < machines; ++seed) {
    const auto truth = draw_machine(g, static_cast<std::uint64_t>(seed), ac);
    squareness += std::pow(truth.axes[1].inclination[2] * 1e6, 2);
    // Mean square over the travel of EYX and over a turn of EBC.
    for (int i = 0; i < 50; ++i) {
      straightness +=
          std::pow(truth.axes[0].errors[1].function.value(-400 + 800 * (i + 0.5) / 50, 0) * 1e3, 2) / 50;
      tilt += std::pow(truth.axes[5].errors[4].function.value(7.2 * i, 0) * 1e6, 2) / 50;
    }
  }
  // A sample of 400 squares of normal numbers has a deviation of sqrt(2 / 400) = 7 % of its mean.
  EXPECT_NEAR(squareness / machines, g.linear.squareness_urad * g.linear.squareness_urad,
              0.25 * g.linear.squareness_urad * g.linear.squareness_urad);
  EXPECT_NEAR(straightness / machines, g.linear.straightness_um * g.linear.straightness_um,
              0.25 * g.linear.straightness_um * g.linear.straightness_um);
  EXPECT_NEAR(tilt / machines, g.rotary.tilt_urad * g.rotary.tilt_urad,
              0.25 * g.rotary.tilt_urad * g.rotary.tilt_urad);
}

TEST(RandomMachine, OnlyAxesThatTheMachineHasGetErrors) {
  const auto truth = draw_machine(grade("new_machine"), 3, ac);
  EXPECT_FALSE(truth.axes[3].errors.empty());
  EXPECT_TRUE(truth.axes[4].errors.empty());
  EXPECT_TRUE(truth.axes[6].errors.empty());
}

TEST(RandomMachine, EveryGradeWarmsUpAndHasASpindleThatGrows) {
  ASSERT_EQ(grades().size(), 3u);
  for (const auto& g : grades()) {
    EXPECT_FALSE(g.about.empty());
    const auto truth = draw_machine(g, 1, ac);
    EXPECT_GT(truth.heat[0].rise_per_speed, 0) << g.name;
    EXPECT_LT(truth.heat[spindle_source].shift.z(), 0) << g.name;
  }
}

}  // namespace
}  // namespace trunnion::truth
