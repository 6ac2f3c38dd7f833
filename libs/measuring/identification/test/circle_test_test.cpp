// SPDX-License-Identifier: Apache-2.0
#include "identification/circle_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "testing_support/refusal.hpp"

namespace trunnion::identification {
namespace {

using testing_support::refusal_of;

const circular_tests::ProgrammedCircle circle_of_50{{10, -20}, 50};

// Along the circle in steps of 0.1 deg from `from` to `to` deg, counted in steps; the position loops are on a
// circle that is 2 um larger.
void go(servo_analysis::ChannelMotion& motion, int from, int to) {
  const int sense = to > from ? 1 : -1;
  for (int i = from; i != to + sense; i += sense) {
    const double angle = 0.1 * i * std::numbers::pi / 180;
    const double directions[] = {std::cos(angle), std::sin(angle)}, centre[] = {10, -20};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      motion.traces[axis].setpoint.push_back(centre[axis] + 50 * directions[axis]);
      motion.traces[axis].feedback.push_back(centre[axis] + 50.002 * directions[axis]);
    }
    ++motion.count;
  }
}

CircleTest by_the_position_loops(const servo_analysis::ChannelMotion& motion) {
  return evaluate_circle(motion, "XY", circle_of_50, encoder_points(motion, {0, 1}), {});
}

// 50 mm times 0.1 deg in 1 ms are 87.27 mm/s.
TEST(CircleTests, FindTheDeviationOfBothSenses) {
  servo_analysis::ChannelMotion motion;
  go(motion, -450, 3600 + 450);
  go(motion, 3600 + 450, -450);
  const auto test = by_the_position_loops(motion);
  EXPECT_NEAR(test.feed, 50 * 0.1 * std::numbers::pi / 180 * 1000 * 60, 5);
  EXPECT_NEAR(test.overrun, 45, 0.11);
  EXPECT_NEAR(test.servo_mismatch, 0, 1e-4);
  EXPECT_NEAR(test.report.causes.radius, 0.002, 1e-6);
  EXPECT_NEAR(test.report.figures.deviation_ccw, 0, 1e-6);
  ASSERT_FALSE(test.readings.cw.empty());
  EXPECT_NEAR(test.readings.cw.front().deviation, 0.002, 1e-9);
}

TEST(CircleTests, NeedAWholeTurnInEachSense) {
  servo_analysis::ChannelMotion motion;
  go(motion, 0, 1800);
  EXPECT_EQ(refusal_of([&] { by_the_position_loops(motion); }), "the axes have not made a whole turn");
  servo_analysis::ChannelMotion one_sense;
  go(one_sense, -450, 3600 + 450);
  EXPECT_EQ(refusal_of([&] { by_the_position_loops(one_sense); }),
            "the circle was run in one sense only (counter-clockwise): a circular test needs both");
}

TEST(CircleTests, StayInTheTravelAndBelowTheHighestFeed) {
  circular_tests::CircleMotion motion;  // XY, 100 mm about 0
  std::array<servo_analysis::TestedAxis, 3> linear;
  for (std::size_t i = 0; i < 3; ++i) {
    linear[i].letter = "XYZ"[i];
    linear[i].low = -200, linear[i].high = 200, linear[i].highest_feed = 1000;
  }
  const auto refusal = [&] { return refusal_of([&] { check_circle(motion, linear); }); };
  linear[2].low = linear[2].high = 0;  // Z rests
  EXPECT_EQ(refusal(), "taken");
  motion.feed = 1200;
  EXPECT_EQ(refusal(), "--feed 1200: axis X moves with up to 1000 mm/min");
  linear[1].high = 90;
  linear[0].highest_feed = 2000;
  EXPECT_EQ(refusal(),
            "axis Y: the circle goes from -100.000 to 100.000 mm, its travel is -200.000 .. 90.000: choose "
            "another --at or --radius");
}

}  // namespace
}  // namespace trunnion::identification
