// SPDX-License-Identifier: Apache-2.0
// G and M codes of the LinuxCNC dialect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "language/linuxcnc_codes.hpp"
#include "linuxcnc_program.hpp"

namespace trunnion::language::test {
namespace {

using ::testing::ElementsAre;

TestMachine machine_of_examples() {
  TestMachine machine = linuxcnc_machine();
  machine.lengths = {{1, 50.0}};
  machine.tools[1] = {50, 0, 2, 0};
  machine.further_references[2] = {50, 60, 70, 0, 0, 0, 0, 0, 0};
  machine.highest_speed = 10000;
  return machine;
}

/// G7 needs a machine with diameters.
void expect_example(const std::string& example) {
  TestMachine machine = machine_of_examples();
  machine.diameter = example == "G7";
  const Interpretation result = run(machine, example + "\nM2\n", {}, {}, {0, true, true});
  EXPECT_EQ(result.last, Step::end) << example << ": " << result.alarm.text.data();
}

TEST(LinuxcncCodes, EveryExampleIsAProgram) {
  for (const LinuxcncSharedCode& row : linuxcnc_shared_codes) expect_example(row.example);
  for (const GCode& row : linuxcnc_own_codes) expect_example(row.example);
}

TEST(LinuxcncCodes, EveryRowIsFoundByItsNumber) {
  for (const LinuxcncSharedCode& row : linuxcnc_shared_codes) {
    ASSERT_NE(linuxcnc_g_code(row.tenths), nullptr) << row.tenths;
    EXPECT_EQ(linuxcnc_g_code(row.tenths), g_code(row.code));
    EXPECT_EQ(linuxcnc_missing_g(row.tenths), nullptr);
  }
  for (const GCode& row : linuxcnc_own_codes) {
    const std::uint32_t number = row.tenths - own_code;
    EXPECT_EQ(linuxcnc_g_code(number), &row) << number;
    EXPECT_EQ(linuxcnc_missing_g(number), nullptr) << number;
  }
  for (const LinuxcncMissingCode& row : linuxcnc_missing_codes)
    EXPECT_EQ(linuxcnc_g_code(row.first), nullptr) << row.name;
}

TEST(LinuxcncCodes, WhatIsNotHereIsRefusedByItsName) {
  TestMachine machine = linuxcnc_machine();
  const auto text = [&](const std::string& block) {
    const Interpretation result = run(machine, block + "\nM2\n");
    return std::string(result.alarm.text.data());
  };
  EXPECT_EQ(text("G17.1"), "this control does not have this LinuxCNC function: G17.1, plane UV");
  EXPECT_EQ(text("M67 E0 Q1"), "this control does not have this LinuxCNC function: M67, analog outputs");
  EXPECT_EQ(text("M101 P1"),
            "M code that neither LinuxCNC nor the PLC of this machine has: M101, a user program of LinuxCNC");
  EXPECT_EQ(text("M10"), "M code that neither LinuxCNC nor the PLC of this machine has: M10");
  EXPECT_EQ(text("G32 Z1"), "G code that LinuxCNC does not have: G32");
  EXPECT_EQ(text("G68 R45"), "G code that LinuxCNC does not have: G68");
  EXPECT_EQ(text("G65 P1"), "G code that LinuxCNC does not have: G65");
  EXPECT_EQ(text("@5 ^30"), "this control does not have this LinuxCNC function: @, polar coordinates");
  EXPECT_EQ(text("M3 $1 S100"),
            "this control does not have this LinuxCNC function: $, spindles other than $0");
  EXPECT_EQ(text("M49"), "this control does not have this LinuxCNC function: M49, overrides off");
  EXPECT_EQ(text("M50 P0"),
            "this control does not have this LinuxCNC function: M50, overrides or feed stop switched off");
  EXPECT_EQ(text("M52"), "this control does not have this LinuxCNC function: M52, adaptive feed");
}

TEST(LinuxcncCodes, AMachineMayHaveMCodesOfItsOwn) {
  TestMachine machine = linuxcnc_machine();
  machine.functions.emplace();
  machine.functions->add("3 4 5; 6; 10; 101");
  EXPECT_THAT(stream(run(machine, "M10 M101\nM2\n")), ElementsAre("M10", "M101", "end 2"));
  EXPECT_THAT(stream(run(machine, "M11\nM2\n")), ElementsAre("alarm 1191 1:1"));
  EXPECT_THAT(stream(run(machine, "M8\nM2\n")), ElementsAre("alarm 1104 1:1"));
}

TEST(LinuxcncCodes, TheEndOfTheProgramStopsSpindleAndCoolant) {
  EXPECT_THAT(linuxcnc_stream("S100 M3 M7 M8\nM30\n"),
              ElementsAre("S100", "M3", "M7", "M8", "M5", "M9", "end 30"));
  EXPECT_THAT(linuxcnc_stream("S100 M4\nM5\nM2\n"), ElementsAre("S100", "M4", "M5", "end 2"));
  // A line of manual data input is no program that has ended.
  EXPECT_THAT(linuxcnc_stream("M3 S100"), ElementsAre("S100", "M3", "end 0"));
}

TEST(LinuxcncCodes, OverridesThatAlwaysActAreNoOrder) {
  EXPECT_THAT(linuxcnc_blocks("M48\nM50 P1 M51\nM52 P0\nM53 X1"), ElementsAre("rapid X1"));
  EXPECT_THAT(linuxcnc_blocks("S100 $0 M3"), ElementsAre("S100", "M3"));
}

TEST(LinuxcncCodes, MCodesActInTheirOrderAndBeforeTheMotion) {
  EXPECT_THAT(linuxcnc_blocks("G0 X1 M9 M5 S100 M6 T1"),
              ElementsAre("S100", "T1", "M6", "M5", "M9", "rapid X1"));
  EXPECT_THAT(linuxcnc_blocks("M7 M8 G0 X1 M0"), ElementsAre("M7", "M8", "rapid X1", "M0"));
  EXPECT_THAT(linuxcnc_blocks("M3 M5"), ElementsAre("alarm 1103 1:4"));
}

TEST(LinuxcncCodes, TheSpindleIsOrientedByRAlone) {
  EXPECT_THAT(linuxcnc_blocks("M19 R45 Q2 P0\nM19\nM19 Q1"), ElementsAre("M19 at 45", "M19", "M19"));
  EXPECT_THAT(linuxcnc_blocks("M19 R45 P1"), ElementsAre("alarm 1192 1:1"));
  EXPECT_THAT(linuxcnc_blocks("M19 R-5"), ElementsAre("alarm 1106 1:5"));
  EXPECT_THAT(linuxcnc_blocks("M19 R45 Q0"), ElementsAre("alarm 1106 1:9"));
}

TEST(LinuxcncCodes, ADwellIsInSecondsAndComesBeforeTheMotion) {
  EXPECT_THAT(linuxcnc_blocks("G1 X1 F100 G4 P0.5\nG4 P1 X3\nG4 P2."),
              ElementsAre("dwell 0.5", "line X1 F100", "dwell 1", "line X3 F100", "dwell 2"));
  EXPECT_THAT(linuxcnc_blocks("G4"), ElementsAre("alarm 1108 1:1"));
  EXPECT_THAT(linuxcnc_blocks("G4 P-1"), ElementsAre("alarm 1106 1:4"));
}

TEST(LinuxcncCodes, FIsTakenBeforeTheUnitsOfItsBlock) {
  // 10 mm/min, then 10 inch/min = 254 mm/min.
  EXPECT_THAT(linuxcnc_blocks("G20 F10\nG1 X1\nF10 X2\nG21 F10 X1"),
              ElementsAre("line X25.4 F10", "line X50.8 F254", "line X1 F254"));
}

TEST(LinuxcncCodes, AxisWordsBehindG80NeedACode) {
  EXPECT_THAT(linuxcnc_blocks("G0 X1\nG80\nX2"), ElementsAre("rapid X1", "alarm 1641 3:1"));
  EXPECT_THAT(linuxcnc_blocks("G80 X2"), ElementsAre("alarm 1641 1:5"));
  EXPECT_THAT(linuxcnc_blocks("G80\nG0 X2"), ElementsAre("rapid X2"));
  EXPECT_THAT(linuxcnc_blocks("G80\nG1 F100\nX2"), ElementsAre("line X2 F100"));
}

TEST(LinuxcncCodes, ArcsTakeTurnsByP) {
  // Half a circle, and two whole ones before: P counts begun turns.
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X2 I1 P3"), ElementsAre("arc X2 cw 1 0 0 900deg F100"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG3 I1"), ElementsAre("arc ccw 1 0 0 360deg F100"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X2 I1 P0"), ElementsAre("alarm 1106 2:10"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X2 I1 K1"), ElementsAre("alarm 1107 2:10"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X2 Z1 I1 K0.0"), ElementsAre("arc X2 Z1 cw 1 0 0 180deg F100"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X2 I1 L2"), ElementsAre("alarm 1107 2:10"));
}

TEST(LinuxcncCodes, ArcCentresMayBeCoordinates) {
  EXPECT_THAT(linuxcnc_blocks("F100\nG0 X5 Y5\nG90.1 G2 X7 I6 J5\nG91.1 X5 I-1"),
              ElementsAre("rapid X5 Y5", "arc X7 Y5 cw 6 5 0 180deg F100", "arc X5 Y5 cw 6 5 0 180deg F100"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG90.1 G2 X2 I1"), ElementsAre("alarm 1108 2:13"));
}

TEST(LinuxcncCodes, ArcsHaveTheToleranceOfLinuxCnc) {
  // Radii of 25 apart by 0.02 and 0.04 mm: 0.0283 mm is allowed, since a thousandth is 0.025.
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X50 I24.99"), ElementsAre("arc X50 cw 24.99 0 0 180deg F100"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X50 I24.98"), ElementsAre("alarm 1204 2:8"));
  // Of 1000 mm, 1 mm is: a thousandth.
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X2000 I999.55"), ElementsAre("arc X2000 cw 999.55 0 0 180deg F100"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X10 R4.998"), ElementsAre("alarm 1205 2:8"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG2 X10 R4.999"), ElementsAre("arc X10 cw 5 0 0 180deg F100"));
}

TEST(LinuxcncCodes, SurfaceSpeedHasItsLimitInD) {
  TestMachine machine = linuxcnc_machine();
  machine.highest_speed = 4000;
  const Interpretation result = run(machine, "G96 S150 D2000\nG97 S500\nM2\n");
  EXPECT_THAT(stream(result), ElementsAre("S150", "S500", "end 2"));
  EXPECT_EQ(result.commands[0].modal.spindle_limit, 2000);
  EXPECT_EQ(result.commands[0].modal.spindle_mode, SpindleMode::surface);
  EXPECT_THAT(stream(run(machine, "G96 D2000\nM2\n")), ElementsAre("alarm 1114 1:1"));
  // Without D the spindle has the limit of the machine, which a check may not know.
  EXPECT_THAT(linuxcnc_blocks("G96 S150\nG97"), ElementsAre("S150", "S0"));
  machine.highest_speed = 0;
  machine.functions.emplace();
  machine.functions->add("3 4 5; 6");
  EXPECT_THAT(stream(run(machine, "G96 S150\nM2\n")), ElementsAre("alarm 1134 1:1"));
}

TEST(LinuxcncCodes, DiametersAreAMatterOfTheMachine) {
  TestMachine machine = linuxcnc_machine();
  EXPECT_THAT(stream(run(machine, "G8\nG7\nM2\n")), ElementsAre("alarm 1192 2:1"));
  machine.diameter = true;
  EXPECT_THAT(stream(run(machine, "G7 G0 X10\nG8\nM2\n")), ElementsAre("rapid X5", "alarm 1192 2:1"));
}

}  // namespace
}  // namespace trunnion::language::test
