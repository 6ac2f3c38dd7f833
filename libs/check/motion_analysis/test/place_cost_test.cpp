// SPDX-License-Identifier: Apache-2.0
// Where time is lost: a motion written by hand, and the text of a place.
#include "motion_analysis/place_cost.hpp"

#include <gtest/gtest.h>

namespace trunnion::analysis {
namespace {

motion::Limits limits() {
  motion::Limits limits;
  limits.axes.fill({500, 500, 3000, 60000});
  return limits;
}

// Half of the programmed speed for 100 cycles of 1 ms loses 50 ms. Y alternates by 0.01 mm every cycle: third
// differences of 0.08 mm are 8e7 mm/s3, 1333 times 60000; second ones of 0.04 mm are 13 times 3000.
TEST(PlaceCost, names_lines_time_axis_and_limit) {
  PlaceCost cost(limits(), 0.001);
  for (int k = 0; k < 300; ++k) {
    motion::AxisValues machine{};
    machine[0] = 0.1 * k;
    machine[1] = k % 2 == 0 ? 0.005 : -0.005;
    motion::Setpoint setpoint;
    setpoint.at_rest = false;
    setpoint.line = k < 150 ? 7 : 9;
    setpoint.programmed_speed = 100;
    setpoint.path_speed = k >= 100 && k < 200 ? 50 : 100;
    cost.add(machine, setpoint);
  }
  const auto places = cost.finish();
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].first_line, 7U);
  EXPECT_EQ(places[0].last_line, 9U);
  EXPECT_NEAR(places[0].begin, 0.1, 1e-12);
  EXPECT_NEAR(places[0].end, 0.2, 1e-12);
  EXPECT_NEAR(places[0].lost, 0.05, 1e-12);
  EXPECT_EQ(places[0].axis, 1U);
  EXPECT_EQ(places[0].limit, BindingLimit::jerk);
}

TEST(PlaceCost, a_place_is_one_line_of_text) {
  CostlyPlace place{12, 18, 3.21, 3.4, 0.1234, 2, BindingLimit::jerk, 0.981};
  EXPECT_EQ(to_text(place), "12-18: 0.123 s lost from 3.210 s on, axis Z uses 98 % of its jerk on average");
  place.last_line = 12;
  place.limit = BindingLimit::velocity;
  EXPECT_EQ(to_text(place), "12: 0.123 s lost from 3.210 s on, axis Z uses 98 % of its velocity on average");
}

}  // namespace
}  // namespace trunnion::analysis
