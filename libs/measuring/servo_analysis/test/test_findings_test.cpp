// SPDX-License-Identifier: Apache-2.0
// The limits of the manual: what is just within them is reached, what is beyond is not.
#include "servo_analysis/test_findings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "machine/parameter_constants.hpp"

namespace trunnion::servo_analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const TestFigure& figure(const TestFindings& findings, const std::string& name) {
  static const TestFigure none;
  for (const auto& f : findings.figures)
    if (f.name == name) return f;
  ADD_FAILURE() << name << " is not among the figures";
  return none;
}

// 0.2 mm at 1000 mm/min, without feed-forward 0.1 mm at 500: Kv 83.3 1/s.
TEST(TestFindings, OfThePositionLoopHaveTheErrorInProportionToTheSpeed) {
  const TestedAxis axis;
  MotionFigures moved, bare;
  moved.following_error = -0.19;
  bare.following_error = 0.09, bare.velocity_gain = 90;
  const auto good = position_findings(axis, 1000, moved, 500, bare, 400);
  EXPECT_TRUE(good.reached());
  EXPECT_EQ(figure(good, "following error").value, 0.19);
  EXPECT_THAT(good.notes.at(0), HasSubstr("at 500 mm/min"));
  bare.following_error = 0.11;
  EXPECT_FALSE(position_findings(axis, 1000, moved, 500, bare, 400).reached());
  bare.following_error = 0.09, bare.velocity_gain = 83;
  EXPECT_FALSE(figure(position_findings(axis, 1000, moved, 500, bare, 400), "Kv").reached());
  bare.velocity_gain = 500;
  EXPECT_FALSE(figure(position_findings(axis, 1000, moved, 500, bare, 400), "Kv").reached()) << "no gain";
}

TEST(TestFindings, OfTheSpeedLoopHaveTenMillimetresPerMinuteOfRipple) {
  TestedAxis axis;
  axis.turns = true;
  MotionFigures moved;
  moved.ripple = 9.9 / per_minute;
  EXPECT_TRUE(speed_findings(axis, moved).reached());
  EXPECT_EQ(speed_findings(axis, moved).figures.size(), 4u) << "no acceleration, no difference";
  EXPECT_EQ(figure(speed_findings(axis, moved), "speed ripple").unit, "deg/min");
  moved.ripple = 10.1 / per_minute, moved.acceleration_peak = 3, moved.deceleration_peak = 1;
  const auto findings = speed_findings(axis, moved);
  EXPECT_FALSE(findings.reached());
  // 2 of the mean, 2.
  EXPECT_EQ(figure(findings, "difference of the peaks").value, 100);
}

TEST(TestFindings, OfTheOvershootAreMilderInFullClosedLoopAtLowFeeds) {
  MotionFigures moved;
  moved.overshoot = 50 / per_minute;
  const auto findings = overshoot_findings({}, {{500.0, moved}, {1000.0, moved}}, true);
  EXPECT_TRUE(figure(findings, "overshoot at F500").reached());
  EXPECT_FALSE(figure(findings, "overshoot at F1000").reached());
  EXPECT_FALSE(overshoot_findings({}, {{500.0, moved}}, false).reached());
}

TEST(TestFindings, OfACircleHaveAMillisecondAndTenMicrometres) {
  RoundnessFigures circle, bare;
  circle.mismatch = -0.9, bare.mismatch = 0.9, circle.quadrant_jump[2] = 0.009;
  const auto good = roundness_findings('X', 'Y', circle, bare);
  EXPECT_TRUE(good.reached());
  EXPECT_THAT(good.notes, ElementsAre("a mismatch above zero: X lags behind Y; make the position gains "
                                      "(10a900, PA0) equal"));
  bare.mismatch = 1.1;
  EXPECT_FALSE(roundness_findings('X', 'Y', circle, bare).reached());
  bare.mismatch = 0, circle.quadrant_jump[2] = 0.011;
  EXPECT_FALSE(figure(roundness_findings('X', 'Y', circle, bare), "quadrant jump at 180 deg").reached());
}

TEST(TestFindings, UnderTheToolTipControlHaveAMillisecondBetweenTheLags) {
  const SimultaneousFigures turn;
  EXPECT_TRUE(rtcp_findings(turn, {{'X', 0.0120}, {'C', 0.0129}}).reached());
  const auto bad = rtcp_findings(turn, {{'X', 0.0120}, {'Y', 0.0110}, {'C', 0.0125}});
  EXPECT_NEAR(figure(bad, "servo mismatch without feed-forward").value, 1.5, 1e-9);
  EXPECT_FALSE(bad.reached());
  EXPECT_NEAR(figure(bad, "time lag of Y").value, 11, 1e-9);
}

TEST(TestFindings, OfTheCurrentLoopAreForInformation) {
  const auto findings = current_findings(0.0004);
  EXPECT_TRUE(findings.reached());
  EXPECT_NEAR(figure(findings, "bandwidth").value, 2500, 1e-6);
}

TEST(TestFindings, OfFrictionHaveTheInertiaOfTheRatedTorque) {
  TestedAxis axis;
  axis.acceleration = 1000;
  // The rated torque accelerates the nominal inertia by 1.5 times that.
  EXPECT_NEAR(figure(friction_findings(axis, {}, 0.001), "inertia over the nominal one").value, 1.5, 1e-12);
}

// 131072 pulses for a revolution of 10 mm: 13 times 10000 and 1072.
TEST(TestFindings, OfTheEncodersProposeDirectionAndPulses) {
  TestedAxis axis;
  axis.number = 1;
  machine::Parameters p;
  const auto set = [&](const machine::ParameterKey& key, double value) {
    p.values[key.number(axis.number)] = {value, ""};
  };
  set(parameter::travel_per_revolution, 10000);
  set(parameter::motor_encoder_pulses, 131072);
  set(parameter::load_encoder_pulses, 4000);
  set(parameter::load_encoder_reversed, 0);
  const auto opposite = encoder_findings(p, axis, {-0.5, -1});
  EXPECT_NEAR(figure(opposite, "motor encoder").value, -131072, 1e-6);
  EXPECT_EQ(figure(opposite, "DP-PFH").value, -13);
  EXPECT_EQ(figure(opposite, "DP-PFL").value, -1072);
  EXPECT_FALSE(opposite.reached());
  ASSERT_EQ(opposite.proposal.size(), 2u);
  EXPECT_EQ(opposite.proposal[0].number, parameter::load_encoder_reversed.number(1));
  EXPECT_EQ(opposite.proposal[0].value, 1);
  EXPECT_EQ(opposite.proposal[1].number, parameter::load_encoder_pulses.number(1));
  EXPECT_EQ(opposite.proposal[1].value, 2000);
  const auto good = encoder_findings(p, axis, {1, 1});
  EXPECT_TRUE(good.reached());
  EXPECT_TRUE(good.proposal.empty());
  EXPECT_THAT(good.notes.at(0), HasSubstr("signs and pulses agree"));
  const auto dead = encoder_findings(p, axis, {0.001, 1});
  EXPECT_TRUE(dead.proposal.empty());
  EXPECT_THAT(dead.notes.at(0), HasSubstr("does not move"));
}

}  // namespace
}  // namespace trunnion::servo_analysis
