// SPDX-License-Identifier: Apache-2.0
// Coordinate systems, tool lengths and tables of the LinuxCNC dialect. The numbers are those that LinuxCNC's
// own tests of G10, G52 and rotations expect, or that rs274 gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linuxcnc_program.hpp"

namespace trunnion::language::test {
namespace {

using ::testing::ElementsAre;

TEST(LinuxcncFrames, G92ShiftsTheAxesThatAreNamed) {
  EXPECT_THAT(linuxcnc_messages("G0 X5 Y6\nG92 X1\n(DEBUG,%d#5420 #5421 #5210 #5211 #5212)\n"
                                "G92 Y1\n(DEBUG,%d#5420 #5421 #5211 #5212)\n"
                                "G52 X3\n(DEBUG,%d#5420 #5421 #5211 #5212)\n"
                                "G92.2\n(DEBUG,%d#5420 #5210 #5211)\nG92.3\n(DEBUG,%d#5420)\n"
                                "G91 G92 X0\n(DEBUG,%d#5420)\nG52 X1\n(DEBUG,%d#5420 #5211)\n"
                                "G92.1\n(DEBUG,%d#5420 #5211)"),
              ElementsAre("1 6 1 4 0", "1 1 4 5", "2 1 3 5", "5 0 3", "2", "0", "4 1", "5 0"));
  EXPECT_THAT(linuxcnc_blocks("G92 X10\nG0 X0\nG92.2 X1"), ElementsAre("rapid X-10", "rapid X1"));
  EXPECT_THAT(linuxcnc_blocks("G92.3"), ElementsAre("alarm 1643 1:1"));
  EXPECT_THAT(linuxcnc_blocks("G92"), ElementsAre("alarm 1108 1:1"));
}

TEST(LinuxcncFrames, G10L2SetsAnOffsetAndItsRotation) {
  EXPECT_THAT(linuxcnc_messages("G10 L2 P1 X1\n(DEBUG,%d#5420 #5421)\nG10 L2 P1 R-45\nG0 Y SQRT[2]\n"
                                "G10 L2 P1 X2 Y1 R90\nG0 X0 Y3\n(DEBUG,%d#5420 #5421)\nG10 L2 P1 X0 Y0\n"
                                "(DEBUG,%d#5420 #5421 #5230)\nG10 L2 P1 R0\n(DEBUG,%d#5021 #5022)"),
              // Y3 of axes turned by 90 degrees about (2, 1): machine (-1, 1); about (0, 0): X1 Y1.
              ElementsAre("-1 0", "0 3", "1 1 90", "-1 1"));
  EXPECT_THAT(linuxcnc_blocks("G91 G10 L2 P2 X5\nG90 G55 G0 X1\nG10 L2 P0 X1\nX1"),
              ElementsAre("table1 1 X5", "rapid X6", "table1 1 X1", "rapid X2"));
  EXPECT_THAT(linuxcnc_blocks("G10 L2 P1 R90\nG0 X1\nG17 G2 X2 I.5 F100\nG10 L2 P1 R0"),
              ElementsAre("rapid Y1", "arc Y2 cw 0 1.5 0 180deg F100"));
  EXPECT_THAT(linuxcnc_blocks("G10 L2 P1 R30"), ElementsAre("alarm 1644 2:1"));
  EXPECT_THAT(linuxcnc_stream("%\nG10 L2 P1 R30\n%\n"), ElementsAre("alarm 1644 3:1"));
  EXPECT_THAT(linuxcnc_blocks("G10 L2 P10 X1"), ElementsAre("alarm 1106 1:8"));
  EXPECT_THAT(linuxcnc_blocks("G10 L2 X1"), ElementsAre("alarm 1108 1:1"));
}

TEST(LinuxcncFrames, TheShiftLiesInTheRotatedAxes) {
  EXPECT_THAT(linuxcnc_messages("G10 L2 P1 X5 R90\nG0 X1\n(DEBUG,%d#5420 #5421 #5021)\nG92 X0 Y0\n"
                                "(DEBUG,%d#5211 #5212)\nG0 X1\n(DEBUG,%d#5420 #5421)\nG52 X2 Y0\n"
                                "(DEBUG,%d#5420 #5421)\nG10 L2 P1 R0"),
              // From machine (0, 0) X1 goes to X1 Y5 of the turned axes: machine (0, 1).
              ElementsAre("1 5 0", "1 5", "1 0", "0 5"));
}

TEST(LinuxcncFrames, G10L20GivesThePositionItsCoordinates) {
  EXPECT_THAT(linuxcnc_messages("G10 L2 P1 R45\nG0 G53 X0 Y0\nG10 L20 P1 X-1\n(DEBUG,%d#5420 #5421)\n"
                                "G10 L20 P1 Y-1\n(DEBUG,%d#5420 #5421)\nG10 L20 P1 X1 Y1\n"
                                "(DEBUG,%d#5420 #5421)\nG10 L2 P1 R0"),
              ElementsAre("-1 0", "-1 -1", "1 1"));
  EXPECT_THAT(linuxcnc_blocks("G0 X4\nG10 L20 P1 X3\nG10 L20 P2 X3 Y1\nX0"),
              ElementsAre("rapid X4", "table1 0 X1", "table1 1 X1 Y-1", "rapid X1"));
  // The tool length is no part of it.
  TestMachine machine = linuxcnc_machine();
  machine.lengths = {{1, 50.0}};
  EXPECT_THAT(stream(run(machine, "G43 H1 G0 Z10\nG10 L20 P1 Z3\nM2\n")),
              ElementsAre("frame none L50", "rapid Z60", "table1 0 Z7", "end 2"));
}

TEST(LinuxcncFrames, TheLastSystemsAreTheFirstAdditionalOnes) {
  TestMachine machine = linuxcnc_machine();
  machine.more_offsets[1] = {7, 0, 0, 0, 0, 0, 0, 0, 0};
  machine.more_offsets[3] = {9, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_THAT(stream(run(machine, "G59.1 G0 X1\nG59.3 X1\nM2\n")),
              ElementsAre("rapid X8", "rapid X10", "end 2"));
}

TEST(LinuxcncFrames, WithoutWordsAllAxesGoToTheReference) {
  TestMachine machine = machine_with_references();
  machine.dialect = ProgramDialect::linuxcnc;
  machine.axis_mask = 0b111;
  EXPECT_THAT(stream(run(machine, "G28 Z5\nG28\nG30\nM2\n")),
              ElementsAre("rapid Z5", "rapid Z300", "rapid X500 Y400 Z300", "rapid X50 Y60 Z70", "end 2"));
  EXPECT_THAT(stream(run(machine, "G91 G28 X1 Y2\nM2\n")),
              ElementsAre("rapid X1 Y2", "rapid X500 Y400", "end 2"));
}

TestMachine machine_with_frames() {
  TestMachine machine = linuxcnc_machine();
  machine.tools[1] = {50, 1, 4, 0.5};
  machine.tools[2] = {30, 0, 2, 0};
  return machine;
}

TEST(LinuxcncTools, LengthsAreThoseOfTheToolInTheSpindle) {
  TestMachine machine = machine_with_frames();
  EXPECT_THAT(stream(run(machine, "T1 M6 G43\nG0 Z0\nG43 H2\nZ0\nG49\nM2\n")),
              ElementsAre("T1", "M6", "frame none L51", "rapid Z51", "frame none L30 Z51", "rapid Z30",
                          "frame none L0 Z30", "end 2"));
  EXPECT_THAT(stream(run(machine, "G43.1 Z5\nG0 Z1\nG43.2 H2\nZ1\nG43.2 Z1\nZ1\nM2\n")),
              ElementsAre("frame none L5", "rapid Z6", "frame none L35 Z6", "rapid Z36", "frame none L36 Z36",
                          "rapid Z37", "end 2"));
  EXPECT_THAT(stream(run(machine, "G43.1 X1\nM2\n")), ElementsAre("alarm 1192 1:7"));
  EXPECT_THAT(stream(run(machine, "G43.1 Z1 G0\nM2\n")), ElementsAre("alarm 1113 1:10"));
  EXPECT_THAT(stream(run(machine, "G43 H9\nM2\n")), ElementsAre("alarm 1303 1:5"));
  EXPECT_THAT(stream(run(machine, "G43 H1\nH2\nM2\n")), ElementsAre("frame none L51", "alarm 1107 2:1"));
}

TEST(LinuxcncTools, TheTableIsSetByPosition) {
  TestMachine machine = machine_with_frames();
  machine.more_offsets[3] = {0, 0, -27, 0, 0, 0, 0, 0, 0};
  // The wear of 1 mm stays: 10 - 1. The radius is 3 with its wear of 0.5.
  EXPECT_THAT(stream(run(machine, "G10 L1 P1 Z10 R3\nG43 H1\nM2\n")),
              ElementsAre("table2 1 9", "table4 1 2.5", "frame none L10", "end 2"));
  // At machine Z-30 the coordinate becomes 1 with a length of -31, in G59.3 with -4.
  EXPECT_THAT(stream(run(machine, "G0 Z-30\nG10 L10 P2 Z1\nG43 H2\nM2\n")),
              ElementsAre("rapid Z-30", "table2 2 -31", "frame none L-31 Z-30", "end 2"));
  EXPECT_THAT(stream(run(machine, "G0 Z-30\nG92 Z7\nG10 L11 P2 Z1\nM2\n")),
              ElementsAre("rapid Z-30", "table2 2 -4", "end 2"));
  EXPECT_THAT(stream(run(machine, "G10 L1 P9 Z1\nM2\n")), ElementsAre("alarm 1306 1:8"));
  EXPECT_THAT(stream(run(machine, "G10 L1 P1 X1\nM2\n")), ElementsAre("alarm 1192 1:11"));
  EXPECT_THAT(stream(run(machine, "G10 L1 P1 Z1 Q3\nM2\n")), ElementsAre("alarm 1107 1:14"));
  EXPECT_THAT(stream(run(machine, "G10 L0\nM2\n")), ElementsAre("alarm 1192 1:1"));
  EXPECT_THAT(stream(run(machine, "G10 L12 P1\nM2\n")), ElementsAre("alarm 1106 1:5"));
}

TEST(LinuxcncTools, CompensationTakesToolsOrDiameters) {
  TestMachine machine = machine_with_frames();
  // Tool 2 has the radius 2.
  const auto path = [&](const std::string& on) {
    return stream(run(machine, "F100\n" + on + "\nG1 X10\nX20 Y1\nX30\nG40 X40 Y20\nM2\n"));
  };
  const auto by_number = path("G41 D2");
  EXPECT_EQ(path("G41.1 D4"), by_number);
  EXPECT_THAT(stream(run(machine, "G41 D2 G1 X10 F100\nG42 D2\nM2\n")).back(), "alarm 1707 2:1");
  EXPECT_THAT(stream(run(machine, "G19 G41 D2\nM2\n")), ElementsAre("alarm 1192 1:5"));
  EXPECT_THAT(stream(run(machine, "G41.1\nM2\n")), ElementsAre("alarm 1108 1:1"));
  EXPECT_THAT(stream(run(machine, "G41 D9\nM2\n")), ElementsAre("alarm 1701 1:5"));
  EXPECT_THAT(stream(run(machine, "G42.1 D4 L3\nM2\n")), ElementsAre("alarm 1192 1:10"));
  EXPECT_EQ(by_number.back(), "end 2");
  const auto in_spindle = path("T2 M6 G41");
  EXPECT_THAT(std::vector<std::string>(in_spindle.begin() + 2, in_spindle.end()), by_number);
}

}  // namespace
}  // namespace trunnion::language::test
