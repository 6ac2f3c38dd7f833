// SPDX-License-Identifier: Apache-2.0
#include "identification/ball_setting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "ac_machine.hpp"

namespace trunnion::identification {
namespace {

using testing::HasSubstr;

// C of the AC trunnion machine: direction -Z through X0 Y0, the point of the axis at Z-400.
TurnedBall around_c() {
  const auto parameters = DrawnMachine::parameters_of("ac-table");
  TurnedBall set{machine::outline_of(parameters, 0), machine::make_chain(parameters, 0)};
  set.axis = 5;
  set.tool_length = 100;
  return set;
}

BallProgram axes_at_zero() {
  BallProgram program;
  for (const char letter : {'X', 'Y', 'Z', 'A', 'C'}) {
    servo_analysis::TestedAxis axis;
    axis.letter = letter;
    program.axes.push_back(axis);
  }
  return program;
}

TEST(BallSetting, IsBesideAnAxisAlongTheTool) {
  auto set = around_c();
  ASSERT_FALSE(place_ball(set, {}, 0, truth::Vec3::Zero()));
  EXPECT_LT((set.ball - truth::Vec3(72.411, 0, -350)).norm(), 1e-9);
  EXPECT_NEAR(set.radius, 72.411, 1e-6);
  EXPECT_LT((set.direction + truth::Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_LT(set.centre.head<2>().norm(), 1e-6);
  // A tool of 100 mm.
  EXPECT_LT((place_at(set, 0) - truth::Vec3(72.411, 0, -250)).norm(), 1e-9);
  set.held[0] = -30;
  EXPECT_EQ(angles_at(set, 45), (geometry::Angles{-30, 0, 45, 0, 0, 0}));
}

TEST(BallSetting, TakesAPlaceAndRefusesOneOnTheAxis) {
  auto set = around_c();
  WantedBall wanted;
  wanted.place = truth::Vec3(0, 40, -300);
  ASSERT_FALSE(place_ball(set, wanted, 0, truth::Vec3::Zero()));
  EXPECT_NEAR(set.radius, 40, 1e-6);
  wanted.place = truth::Vec3(0, 0, -350);
  EXPECT_TRUE(place_ball(set, wanted, 0, truth::Vec3::Zero()));
}

TEST(BallSetting, HoldsAnotherRotaryAxisOfTheMachine) {
  auto set = around_c();
  EXPECT_TRUE(hold_axis(set, "A-30.5"));
  EXPECT_EQ(set.held[0], -30.5);
  for (const auto* word : {"", "A", "A30x", "C30", "B30", "X30"}) EXPECT_FALSE(hold_axis(set, word)) << word;
  EXPECT_EQ(set.held[0], -30.5);
}

// The ball goes round at 72.411 mm about X0 Y0; at 90 degrees Y has gone to -72.411 or 72.411.
TEST(BallSetting, NamesTheLinearAxisThatLeavesItsTravel) {
  auto set = around_c();
  ASSERT_FALSE(place_ball(set, {}, 0, truth::Vec3::Zero()));
  std::array<servo_analysis::TestedAxis, 3> linear;
  for (std::size_t i = 0; i < 3; ++i) linear[i].letter = "XYZ"[i], linear[i].low = -500, linear[i].high = 500;
  EXPECT_FALSE(left_travel(set, linear, 0));
  linear[1].low = -60, linear[1].high = 60;
  const auto left = left_travel(set, linear, 0);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->axis.letter, 'Y');
  EXPECT_GT(std::abs(left->place), 60);
  // asin(60 / 72.411) is 55.96 degrees, the next of 72 steps is 60.
  EXPECT_NEAR(left->angle, 60, 1e-9);
}

TEST(BallPrograms, TurnUnderTheToolTipControlAndBack) {
  auto set = around_c();
  ASSERT_FALSE(place_ball(set, {}, 0, truth::Vec3::Zero()));
  const auto program = ball_turn_program(set, axes_at_zero(), 0, 1000);
  EXPECT_THAT(program, HasSubstr("G17 G90 G94\nG53 G1 A0.000000 C0.000000 F3000\nG53 G1 X72.411000 Y"));
  EXPECT_THAT(program, HasSubstr(" Z-250.000000 F3000\nG43.4 H1\nG4 P500\n"
                                 "G91 G1 C360.000000 F1000.000000\nG4 P500\nG1 C-360.000000\nG90\n"
                                 "G4 P500\nG49\nG53 G1 X0.000000 Y0.000000 Z0.000000 F3000\n"
                                 "G53 G1 A0.000000 C0.000000 F3000\nM30\n"));
}

TEST(BallPrograms, StopAtEqualAngles) {
  auto set = around_c();
  ASSERT_FALSE(place_ball(set, {}, 0, truth::Vec3::Zero()));
  EXPECT_THAT(ball_stops_program(set, axes_at_zero(), 0, 4),
              HasSubstr("G91\nG1 C0.000000 F3000\nG4 P400\nG1 C90.000000 F3000\nG4 P400\n"
                        "G1 C90.000000 F3000\nG4 P400\nG1 C90.000000 F3000\nG4 P400\nG90\nG4 P500\n"));
}

}  // namespace
}  // namespace trunnion::identification
