// SPDX-License-Identifier: Apache-2.0
#include "spindle_status.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace trunnion::cli {
namespace {

using idl::stream::SpindleCondition;

const std::vector<machine::AxisInfo> spindles{{3, "S1", machine::axis_type_spindle},
                                              {4, "S2", machine::axis_type_spindle}};

// -0.25 rev are at 270 deg, -0.00125 rev are -0.45 deg.
idl::stream::Feedback synchronized() {
  idl::stream::Feedback feedback;
  feedback.spindle_speed = {-1000.2, 998.6};
  feedback.spindles.resize(2);
  auto& leader = feedback.spindles[0];
  leader.condition = SpindleCondition::SPINDLE_AT_SPEED;
  leader.homed = true, leader.gear = 2, leader.reference = -1000, leader.master = -1, leader.angle = -0.25;
  auto& sub = feedback.spindles[1];
  sub.condition = SpindleCondition::SPINDLE_SYNCHRONIZED;
  sub.homed = true, sub.reference = 999, sub.master = 0, sub.angle = 3.5;
  sub.synchronization_error = -0.00125, sub.correction = 1.256;
  return feedback;
}

TEST(SpindleStatus, EverySpindleHasALineWithSpeedConditionGearAndAngleAndASlaveItsMasterAndError) {
  const auto all = spindle_status(spindles, synchronized());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].line(), "S1       -1000 of -1000 1/min, at speed, gear 2, 270.00 deg");
  EXPECT_EQ(all[1].line(),
            "S2       999 of 999 1/min, synchronized, 180.00 deg, follows S1, error -0.450 deg");
}

TEST(SpindleStatus, ItsJsonHasTheUnitsInTheNames) {
  const auto all = spindle_status(spindles, synchronized());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].json()["master"], "");
  const bus::Json expected = {{"spindle", "S2"},
                              {"condition", "SPINDLE_SYNCHRONIZED"},
                              {"speed_per_min", 998.6},
                              {"reference_per_min", 999.0},
                              {"homed", true},
                              {"angle_deg", 180.0},
                              {"gear", 0},
                              {"master", "S1"},
                              {"synchronization_error_deg", -0.45},
                              {"correction_per_min", 1.26}};
  EXPECT_EQ(all[1].json(), expected) << all[1].json();
}

TEST(SpindleStatus, ASpindleAtRestHasNoMinusAndOneWithoutIndexMarkNoAngle) {
  auto feedback = synchronized();
  feedback.spindle_speed[0] = -0.3;
  auto& leader = feedback.spindles[0];
  leader.condition = SpindleCondition::SPINDLE_STOPPED;
  leader.homed = false, leader.gear = 0, leader.reference = 0;
  EXPECT_EQ(spindle_status(spindles, feedback)[0].line(),
            "S1       0 of 0 1/min, stopped, no index mark yet");
}

TEST(SpindleStatus, ThereAreNoMoreThanTheDriveAndTheParametersHave) {
  EXPECT_TRUE(spindle_status(spindles, {}).empty());
  EXPECT_TRUE(spindle_status({}, synchronized()).empty());
  auto feedback = synchronized();
  feedback.spindles[1].master = 4;  // of a message that is wrong
  EXPECT_NE(spindle_status(spindles, feedback)[1].line().find("follows spindle 5"), std::string::npos);
}

}  // namespace
}  // namespace trunnion::cli
