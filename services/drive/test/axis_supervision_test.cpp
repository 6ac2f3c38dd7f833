// SPDX-License-Identifier: Apache-2.0
#include "axis_supervision.hpp"

#include <gtest/gtest.h>

#include "machine/alarm_constants.hpp"

namespace trunnion::drive {
namespace {

// X follows within 2 mm between -100 and 100 mm.
struct SupervisedX {
  SupervisedX() { supervision.configure(1); }
  SupervisedAxis now() const { return {info, limits, status, command, velocity}; }
  // Number of the alarm, 0 for none.
  std::uint32_t finding() {
    const auto event = supervision.finding(0, now());
    return event ? event->alarm->number : 0;
  }
  bool runs_away(bool moves) { return supervision.does_not_follow(0, now(), moves, row, row - queue); }

  machine::AxisInfo info{0, "X", machine::axis_type_linear};
  AxisLimits limits{1000, 4000, 100, -100, 2, 0.1, 0, 0, 20, 1, 0};
  AxisStatus status;
  double command = 0, velocity = 0;
  std::uint64_t row = 100, queue = 5;
  AxisSupervision supervision;
};

TEST(AxisSupervision, ReportsAFaultOnceUntilItIsAcknowledged) {
  SupervisedX x;
  EXPECT_EQ(x.finding(), 0u);
  x.status.following_error = -2.1;
  EXPECT_EQ(x.finding(), alarm::following_error.number);
  EXPECT_EQ(x.finding(), 0u);
  x.supervision.acknowledge();
  EXPECT_EQ(x.finding(), alarm::following_error.number) << "it is there still";
  x.status.following_error = 0, x.status.encoder_difference = -0.2;
  x.supervision.acknowledge();
  EXPECT_EQ(x.finding(), alarm::encoder_difference.number);
}

TEST(AxisSupervision, BeyondTheTravelOnlyTheWayOnIsAFault) {
  SupervisedX x;
  x.command = x.status.position = 100.6;
  EXPECT_EQ(x.finding(), 0u);
  x.velocity = -0.1;
  EXPECT_EQ(x.finding(), 0u) << "it returns";
  x.velocity = 0.1;
  EXPECT_EQ(x.finding(), alarm::over_travel.number);
  x.supervision.acknowledge();
  x.command = -99, x.velocity = 0, x.status.position = -100.6, x.status.velocity = -1;
  EXPECT_EQ(x.finding(), alarm::over_travel.number) << "the encoder runs away from its setpoint";
  x.supervision.acknowledge();
  x.status.homed = false;
  EXPECT_EQ(x.finding(), 0u) << "the position has no reference";
}

TEST(AxisSupervision, AnErrorAtRestCountsFromTheRowThatIsInForce) {
  SupervisedX x;
  x.status.following_error = 3;
  EXPECT_FALSE(x.runs_away(true));
  int periods = 0;
  do {
    ++x.row, ++periods;
  } while (!x.runs_away(false) && periods < 1000);
  // Row 100 moved it last and is in force with row 105: those of row 106 on count, and the 251st is too many.
  EXPECT_EQ(periods, 5 + static_cast<int>(settling_periods) + 1);
  x.status.following_error = 1;
  EXPECT_FALSE(x.runs_away(false));
  x.status.following_error = 4.1;
  EXPECT_TRUE(x.runs_away(true)) << "twice the limit, at once";
  EXPECT_EQ(excessive_following_error(x.now()).alarm->number, alarm::following_error_excessive.number);
}

}  // namespace
}  // namespace trunnion::drive
