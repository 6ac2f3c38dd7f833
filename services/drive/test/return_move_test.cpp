// SPDX-License-Identifier: Apache-2.0
#include "return_move.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trunnion::drive {
namespace {

TEST(ReturnMove, EndsExactlyAtItsPointWithinTheLimitsOfItsAxis) {
  constexpr double period = 0.001;
  for (const double distance : {0.001, 1.0, 700.0}) {
    constexpr double fastest = 500, steepest = 4000;  // mm/s, mm/s2
    ReturnMove move;
    move.configure(2);
    move.start({0.1, 5}, {0.1 + distance, 5}, quintic_seconds(distance, fastest, steepest), period);
    std::vector<double> place = {0.1, 5};
    double velocity = 0, largest_velocity = 0, largest_acceleration = 0;
    bool ended = false;
    for (int i = 0; i < 100000 && !ended; ++i) {
      const double before = place[0], velocity_before = velocity;
      ended = move.step(place);
      velocity = (place[0] - before) / period;
      largest_velocity = std::max(largest_velocity, std::abs(velocity));
      largest_acceleration = std::max(largest_acceleration, std::abs(velocity - velocity_before) / period);
      EXPECT_EQ(place[1], 5) << "it is there already";
    }
    EXPECT_TRUE(ended);
    EXPECT_EQ(place[0], 0.1 + distance);
    EXPECT_LE(largest_velocity, fastest * (1 + 1e-9));
    EXPECT_LE(largest_acceleration, steepest * (1 + 1e-9));
  }
}

// 1.875 * 100 / 500 = 0.375 s are longer than the root of 5.774 * 100 / 5774 = 0.316 s; of 1 mm the second
// is.
TEST(ReturnMove, IsAsLongAsVelocityOrAccelerationAskFor) {
  EXPECT_DOUBLE_EQ(quintic_seconds(100, 500, 5774), 0.375);
  EXPECT_DOUBLE_EQ(quintic_seconds(1, 500, 5774), std::sqrt(0.001));
  ReturnMove move;
  move.configure(1);
  move.start({0}, {1}, 0.0025, 0.001);
  std::vector<double> place = {0};
  EXPECT_FALSE(move.step(place));
  EXPECT_FALSE(move.step(place));
  EXPECT_TRUE(move.step(place)) << "2.5 periods are three";
}

}  // namespace
}  // namespace trunnion::drive
