// SPDX-License-Identifier: Apache-2.0
#include "spindles.hpp"

#include <gtest/gtest.h>

namespace trunnion::drive {
namespace {

TEST(Spindles, TheStreamGoesBeforeTheOrientationAndThatBeforeTheSpeed) {
  machine::Parameters p;
  p.values[105000] = {0, "S"}, p.values[105001] = {machine::axis_type_spindle, ""};
  Spindles spindles;
  spindles.configure(p, 0.001);
  ASSERT_EQ(spindles.size(), 1u);
  EXPECT_EQ(spindles.axes()[0].number, 5);
  std::vector<SpindleStatus> status(1);
  std::vector<SpindleSetpoint> out(1);
  idl::stream::Feedback feedback;
  status[0].angle = 7;
  spindles.demand_speeds({300});
  spindles.demand_orientations({1});

  spindles.coupling(0).couple(0, status[0].angle);
  spindles.coupling(0).couple(0.1, status[0].angle);
  spindles.step(status, true, out);
  EXPECT_TRUE(out[0].coupled);
  EXPECT_DOUBLE_EQ(out[0].angle, 7.1);
  spindles.lead_on(0.5);
  spindles.step(status, true, out);
  EXPECT_DOUBLE_EQ(out[0].angle, 7.15) << "half a cycle on";
  spindles.fill(status, feedback);
  EXPECT_EQ(feedback.spindle_oriented[0], 0);

  spindles.coupling(0).release();
  spindles.step(status, true, out);
  EXPECT_TRUE(out[0].coupled) << "held where it is: at 0 deg after 7 turns";
  EXPECT_EQ(out[0].angle, 7);
  spindles.fill(status, feedback);
  EXPECT_EQ(feedback.spindle_oriented[0], 1);

  spindles.demand_orientations({});
  spindles.step(status, true, out);
  EXPECT_FALSE(out[0].coupled);
  EXPECT_EQ(out[0].speed, 300);
  spindles.demand_speeds({});
  spindles.step(status, true, out);
  EXPECT_EQ(out[0].speed, 0);
}

}  // namespace
}  // namespace trunnion::drive
