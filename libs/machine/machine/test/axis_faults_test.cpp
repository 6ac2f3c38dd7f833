// SPDX-License-Identifier: Apache-2.0
#include "machine/axis_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "machine/machine.hpp"

namespace trunnion::machine {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Parameters delivered(const std::string& name) {
  Parameters p;
  p.values = machine_parameters(load_machine(std::string(TRUNNION_MACHINES) + "/" + name));
  return p;
}

struct Change {
  std::uint32_t number;
  double value;
  std::string text;
};

std::vector<std::string> faults_of(const std::string& name, const std::vector<Change>& changes) {
  auto p = delivered(name);
  for (const auto& change : changes) p.values[change.number] = {change.value, change.text};
  std::vector<std::string> texts;
  for (const auto& fault : axis_faults(p)) {
    EXPECT_FALSE(fault.numbers.empty()) << fault.text;
    texts.push_back(fault.text);
  }
  return texts;
}

// ac-table: X Y Z A C are axes 0 .. 4, axis 5 is the spindle.
TEST(AxisFaults, TwoLettersOfAChannelOnOneAxis) {
  EXPECT_THAT(faults_of("ac-table", {{40002, 0, ""}}),
              ElementsAre("parameter 040002 (channel_axis): Y of channel 0 is axis 0 (X), which is X of "
                          "channel 0 already (parameter 040001): an axis has one letter of one channel"));
}

TEST(AxisFaults, AnAxisInTwoChannels) {
  EXPECT_THAT(faults_of("two-channel", {{41002, 1, ""}}),
              ElementsAre("parameter 041002 (channel_axis): Y of channel 1 is axis 1 (Y1), which is Y of "
                          "channel 0 already (parameter 040002): an axis has one letter of one channel"));
}

TEST(AxisFaults, ALetterOnAnAxisThatDoesNotExist) {
  EXPECT_THAT(faults_of("ac-table", {{40007, 9, ""}, {40008, 40, ""}}),
              ElementsAre("parameter 040007 (channel_axis): U of channel 0 is axis 9, which does not exist: "
                          "it has no name (parameter 109000)",
                          "parameter 040008 (channel_axis): V of channel 0 is axis 40, which does not "
                          "exist: the axes are 0 .. 31 (parameter 010049)"));
  EXPECT_THAT(faults_of("ac-table", {{10049, 4, ""}}),
              ElementsAre("parameter 040006 (channel_axis): C of channel 0 is axis 4 (C), which does not "
                          "exist: the axes are 0 .. 3 (parameter 010049)"));
}

TEST(AxisFaults, ALetterOnASpindleByItsNumber) {
  EXPECT_THAT(faults_of("ac-table", {{40007, 5, ""}}),
              ElementsAre("parameter 040007 (channel_axis): U of channel 0 is axis 5 (S), which is a spindle "
                          "(parameter 105001 is 10)"));
}

TEST(AxisFaults, ASpindleThatIsNoneOrBelongsToTwoChannels) {
  EXPECT_THAT(faults_of("ac-table", {{40913, 2, ""}}),
              ElementsAre("parameter 040913 (tapping_spindle): axis 2 (Z) is no spindle of the machine"));
  EXPECT_THAT(faults_of("two-channel", {{40913, 6, ""}, {41913, 7, ""}}), IsEmpty());
  EXPECT_THAT(faults_of("two-channel", {{40913, 6, ""}, {41913, 6, ""}}),
              ElementsAre("parameter 041913 (tapping_spindle): axis 6 (S1) is the spindle of channel 0 "
                          "already (parameter 040913): two channels must not couple one spindle"));
}

// ac-table has one spindle, which is that of the first letter.
TEST(AxisFaults, MoreSpindleLettersThanSpindles) {
  EXPECT_THAT(faults_of("ac-table", {{40008, -2, ""}}), IsEmpty());
  EXPECT_THAT(faults_of("ac-table", {{40008, -2, ""}, {40009, -2, ""}}),
              ElementsAre("parameter 040009 (channel_axis): W of channel 0 is a spindle (-2), and the "
                          "machine has no further one: it has 1"));
}

TEST(AxisFaults, AMotorMayTurnTheOtherWayButMustMoveItsAxis) {
  EXPECT_THAT(faults_of("gantry-cb-head", {{102004, -12000, ""}}), IsEmpty());
  EXPECT_THAT(faults_of("ac-table", {{100004, 0, ""}}),
              ElementsAre("parameter 100004 (travel_per_revolution): axis 0 (X) travels 0 um for one "
                          "revolution of its motor: at least 1, or -1 when the motor turns the other way"));
}

// The units of PB64 are 1: synchronization is on.
TEST(AxisFaults, ADriveOfAGantryIsOnTheSideThatItsAxisIs) {
  EXPECT_THAT(faults_of("gantry-cb-head", {{101942, 1, ""}, {102942, 11, ""}}), IsEmpty());
  EXPECT_THAT(faults_of("gantry-cb-head", {{102942, 100, ""}}), IsEmpty()) << "off";
  EXPECT_THAT(faults_of("gantry-cb-head", {{101942, 1, ""}, {102942, 101, ""}}),
              ElementsAre("parameter 102942 (drive_synchronization): PB64 of axis 2 (Y2), a slave of a "
                          "gantry, is 101, and its tens make the drive a master: enter 111"));
  EXPECT_THAT(faults_of("gantry-cb-head", {{101942, 11, ""}, {102942, 11, ""}}),
              ElementsAre("parameter 101942 (drive_synchronization): PB64 of axis 1 (Y), a master of a "
                          "gantry, is 11, and its tens make the drive a slave: enter 1"));
}

// gantry-cb-head: axis 2 is the slave of axis 1, which is Y.
TEST(AxisFaults, ASlaveThatIsAnAxisOfAChannel) {
  EXPECT_THAT(faults_of("gantry-cb-head", {{40007, 2, ""}}),
              ElementsAre("parameter 010051 (gantry_slave_axis): axis 2 (Y2) is the slave of axis 1 (Y) and "
                          "U of channel 0 (parameter 040007): a slave is an axis of no channel"));
}

TEST(AxisFaults, AGantryWithoutAMasterThatMoves) {
  EXPECT_THAT(faults_of("gantry-cb-head", {{102101, 2, ""}}),
              ElementsAre("parameter 102101 (gantry_master): axis 2 follows axis 2, and an axis cannot "
                          "follow itself"));
  EXPECT_THAT(faults_of("gantry-cb-head", {{102101, 9, ""}}),
              ElementsAre("parameter 102101 (gantry_master): axis 2 follows axis 9, and one of them does "
                          "not exist"));
  EXPECT_THAT(faults_of("gantry-cb-head", {{40002, -1, ""}}),
              ElementsAre("parameter 102101 (gantry_master): axis 1 (Y), the master of axis 2 (Y2), is an "
                          "axis of no channel (parameters 04c001 .. 04c009)"));
}

TEST(AxisFaults, ASlaveThatIsOneTwiceOrAMasterToo) {
  EXPECT_THAT(faults_of("gantry-cb-head", {{10050, 2, ""}, {10052, 2, ""}}),
              ElementsAre("parameter 010052 (gantry_slave_axis): axis 2 (Y2) is a slave already (parameter "
                          "010051)"));
  EXPECT_THAT(
      faults_of("gantry-cb-head",
                {{10050, 2, ""}, {10052, 7, ""}, {107000, 0, "Y3"}, {107100, 1, ""}, {107101, 2, ""}}),
      ElementsAre("parameter 107101 (gantry_master): axis 2 (Y2), the master of axis 7 (Y3), is "
                  "itself a slave (parameter 010051)"));
}

TEST(AxisFaults, ASlaveThatIsSwitchedOffIsAnAxisLikeOthers) {
  EXPECT_THAT(faults_of("gantry-cb-head", {{102100, 0, ""}, {40007, 2, ""}}), IsEmpty());
}

// Y of ac-table travels -300 .. 300 mm, A -110 .. 110 deg.
TEST(AxisFaults, TravelLimitsTheWrongWayRound) {
  EXPECT_THAT(
      faults_of("ac-table", {{101006, -300, ""}, {101007, 300, ""}}),
      ElementsAre("parameter 101007 (negative_limit): axis 1 (Y) has its negative travel limit at 300 "
                  "mm, which is not below the positive one at -300 mm (parameter 101006)"));
  EXPECT_THAT(
      faults_of("ac-table", {{103007, 110, ""}}),
      ElementsAre("parameter 103007 (negative_limit): axis 3 (A) has its negative travel limit at 110 "
                  "deg, which is not below the positive one at 110 deg (parameter 103006)"));
}

TEST(AxisFaults, AReferencePointOutsideTheTravel) {
  EXPECT_THAT(faults_of("ac-table", {{101012, 300.5, ""}}),
              ElementsAre("parameter 101012 (reference_coordinate): axis 1 (Y) has its reference point at "
                          "300.5 mm, outside its travel of -300 mm .. 300 mm (parameters 101007, 101006)"));
  EXPECT_THAT(faults_of("ac-table", {{101007, 10, ""}}),
              ElementsAre("parameter 101012 (reference_coordinate): axis 1 (Y) has its reference point at 0 "
                          "mm, outside its travel of 10 mm .. 300 mm (parameters 101007, 101006)"));
  EXPECT_THAT(faults_of("ac-table", {{101961, -400, ""}}),
              ElementsAre("parameter 101961 (numbered_reference): axis 1 (Y) has reference point 3 at -400 "
                          "mm, outside its travel of -300 mm .. 300 mm (parameters 101007, 101006)"));
}

TEST(AxisFaults, ASkipInputThatNoAxisSwitches) {
  EXPECT_THAT(faults_of("ac-table", {{10931, 5, ""}}),
              ElementsAre("parameter 010931 (skip_input_axis): skip input 2 is switched by axis 5 (S), which "
                          "is a spindle (parameter 105001 is 10)"));
}

TEST(AxisFaults, AllAreNamedAtOnce) {
  EXPECT_EQ(faults_of("ac-table", {{40002, 0, ""}, {40913, 2, ""}, {102006, -600, ""}}).size(), 3u);
}

}  // namespace
}  // namespace trunnion::machine
