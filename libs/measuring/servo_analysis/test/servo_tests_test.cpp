// SPDX-License-Identifier: Apache-2.0
// The programs of the servo tests, and what is found in their traces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "servo_analysis/loop_figures.hpp"
#include "servo_analysis/rtcp_turn.hpp"
#include "servo_analysis/test_programs.hpp"
#include "servo_analysis/tuning_task.hpp"
#include "testing_support/refusal.hpp"
#include "trace.hpp"

namespace trunnion::servo_analysis {
namespace {

using testing::HasSubstr;
using testing_support::refusal_of;

TestedAxis linear_axis(char letter, double place, double low, double high) {
  TestedAxis axis;
  axis.letter = letter, axis.number = static_cast<std::uint16_t>(letter - 'X');
  axis.place = place, axis.low = low, axis.high = high;
  axis.highest_feed = 10000, axis.acceleration = 1000;
  return axis;
}

TEST(TestedAxis, MovesTowardsTheFartherEndOfItsTravel) {
  EXPECT_EQ(linear_axis('X', 10, 0, 100).into_travel(50), 50);
  EXPECT_EQ(linear_axis('X', 90, 0, 100).into_travel(-50), -50);
  EXPECT_EQ(linear_axis('X', 60, 0, 100).into_travel(30), -30);
  EXPECT_EQ(refusal_of([] { linear_axis('X', 10, 0, 100).into_travel(200); }),
            "axis X at 10.000 mm cannot move by 200.000: its travel is 0.000 .. 100.000");
}

TEST(ServoPrograms, GoToAndFroByAnEvenNumberOfStrokes) {
  EXPECT_EQ(to_and_fro_program(linear_axis('Y', 0, 0, 100), 5, 1000, 1),
            "G91\nG1 Y5.000000 F1000.000\nG1 Y-5.000000 F1000.000\nG90\nM30\n");
}

// 10 mm/s for 0.5 s and 0.1 s to settle are 6 mm, 10^2 / 1000 mm more to accelerate and to stop.
TEST(ServoPrograms, HaveTheTimeAtConstantSpeedThatTheTravelPermits) {
  EXPECT_THAT(stroke_program(linear_axis('X', 0, 0, 100), 600, 0.5), HasSubstr("G1 X6.100000 F600.000\n"));
  EXPECT_THAT(stroke_program(linear_axis('X', 0, 0, 4), 600, 0.5), HasSubstr("G1 X4.000000 F600.000\n"));
}

TEST(ServoPrograms, OfACircleBeginWhereTheFirstAxisReverses) {
  const auto x = linear_axis('X', 0, -100, 100), z = linear_axis('Z', 0, -50, 50);
  const std::string turn = "G3 I10.000000 K0 F1000.000\n";
  EXPECT_EQ(circle_program(x, z, 10, 1000), "G18\n" + turn + turn + "G17\nM30\n");
  EXPECT_EQ(refusal_of([&] { circle_program(x, linear_axis('Z', 45, -50, 50), 10, 1000); }),
            "axis Z at 45.000 mm has no space for a circle of radius 10.000 mm");
  EXPECT_EQ(refusal_of([&] { circle_program(x, linear_axis('A', 0, -50, 50), 10, 1000); }),
            "a circle needs two of the axes X, Y, Z");
}

TEST(ServoPrograms, UnderTheToolTipControlTurnAndComeBack) {
  RtcpMotion motion;
  motion.start = 10, motion.end = 100, motion.tool = 2;
  EXPECT_EQ(rtcp_program(motion),
            "G90 G94\nG1 C10.0000 F3000.000\nG4 P500\nG43.4 H2\n"
            "G91 G1 C90.0000 F1000.000\nG4 P500\nG1 C-90.0000 F3000.000\nG90 G49\nM30\n");
}

// C rests, turns with 100 deg/s for half a second and rests; X moves by a millimetre in a degree, Y by a
// hundredth of it.
std::vector<AxisTrace> motion_under_rtcp() {
  std::vector<AxisTrace> traces(3);
  double c = 0;
  for (int i = 0; i < 1000; ++i) {
    if (i >= 300 && i < 800) c += 0.1;
    add(traces[0], c, c), add(traces[1], c / 100, c / 100), add(traces[2], c, c);
  }
  return traces;
}

TEST(RtcpTurn, IsTheTimeInWhichTheRotaryAxisHasItsSpeed) {
  const auto turn = turn_under_rtcp(motion_under_rtcp(), 100);
  ASSERT_EQ(turn.linear.size(), 2u);
  EXPECT_NEAR(static_cast<double>(turn.rotary.size()), 500, 2);
  EXPECT_EQ(turn.linear[0].size(), turn.rotary.size());
  EXPECT_NEAR(linear_way(turn), 50, 0.3);
  EXPECT_NEAR(peak_speed(turn.rotary), 100, 1e-6);
  EXPECT_THAT(refusal_of([] { turn_under_rtcp(motion_under_rtcp(), -100); }),
              HasSubstr("did not reach its feed"));
}

TEST(RtcpTurn, HasLagsOfTheAxesThatMove) {
  const auto turn = turn_under_rtcp(motion_under_rtcp(), 100);
  const auto lags = lags_of(turn, {0.011, 0.5, 0.012}, "XYC");
  ASSERT_EQ(lags.size(), 2u);
  EXPECT_EQ(lags[0].letter, 'X');
  EXPECT_EQ(lags[0].time, 0.011);
  EXPECT_EQ(lags[1].letter, 'C');
  EXPECT_EQ(lags[1].time, 0.012);
}

// Steps of 0.2 every 40 samples; in each sample the torque gains a share of what is missing, the sample over
// the time constant: 0.125 ms / 0.4 ms. 40 samples later (1 - 0.3125)^40 = 3e-7 of the step is missing.
TEST(CurrentLoop, HasItsTimeConstantInTheFirstSampleOfAStep) {
  AxisTrace trace;
  trace.interval = 0.000125;
  double torque = -0.1;
  for (int i = 0; i < 400; ++i) {
    const double excitation = i / 40 % 2 == 0 ? -0.1 : 0.1;
    torque += (excitation - torque) * trace.interval / 0.0004;
    add(trace, 0, 0, 0, torque);
    trace.excitation.back() = excitation;
  }
  EXPECT_NEAR(current_time_constant(trace), 0.0004, 1e-9);
  trace.torque.assign(trace.torque.size(), 0);
  EXPECT_EQ(refusal_of([&] { current_time_constant(trace); }), "the torque does not follow its setpoint");
}

// The load stands still in the first 300 ms, the backlash, and then goes half the way to the other side.
TEST(Encoders, AreComparedBehindTheBacklash) {
  for (const int sense : {1, -1}) {
    AxisTrace trace;
    for (int i = 0; i <= 1000; ++i) {
      const double way = sense * 0.01 * i;
      add(trace, way, way);
      trace.load.back() = i < 300 ? 0 : -0.5 * (way - sense * 3.0);
    }
    const auto compared = compare_encoders(trace);
    EXPECT_NEAR(compared.ratio, -0.5, 1e-9);
    EXPECT_EQ(compared.motor_sense, sense);
  }
  AxisTrace resting;
  for (int i = 0; i < 1000; ++i) add(resting, 1, 1);
  EXPECT_EQ(refusal_of([&] { compare_encoders(resting); }), "the motion had no constant speed");
}

TEST(TuningTask, UsesTheTravelThatTheCirclesHave) {
  const machine::Parameters parameters{};
  const std::vector<TestedAxis> axes = {linear_axis('X', 0, -100, 100), linear_axis('Y', 95, -100, 105)};
  const auto* partner = partner_of(axes, axes[0]);
  ASSERT_EQ(partner, &axes[1]);
  // Y has 10 mm to its end: a circle of X has 20 mm at most.
  const auto task = tuning_task(parameters, axes[0], partner, 0.02);
  EXPECT_TRUE(task.circles);
  EXPECT_EQ(task.travel, 20);
  EXPECT_EQ(task.rated_acceleration, 1500);
  const auto alone = tuning_task(parameters, axes[0], nullptr, 0.02);
  EXPECT_FALSE(alone.circles);
  EXPECT_EQ(alone.travel, 40);
  const auto narrow = linear_axis('Y', 102, -100, 105);
  EXPECT_FALSE(tuning_task(parameters, axes[0], &narrow, 0.02).circles) << "less than 5 mm";
  auto rotary = axes[0];
  rotary.turns = true;
  EXPECT_EQ(partner_of(axes, rotary), nullptr);
  EXPECT_EQ(partner_of({axes[0]}, axes[0]), nullptr);
}

}  // namespace
}  // namespace trunnion::servo_analysis
