// SPDX-License-Identifier: Apache-2.0
// Canned cycles of the LinuxCNC dialect. The moves are those that rs274 of LinuxCNC 2.9 gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linuxcnc_program.hpp"

namespace trunnion::language::test {
namespace {

using ::testing::ElementsAre;

TEST(LinuxcncCycles, ReturnToRUnlessG98) {
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z3\nG98 G81 X1 Y1 Z-1 R2\nX2 Z-2\nG99 X3\nX4"),
              ElementsAre("rapid Z3", "rapid X1 Y1 Z3", "rapid X1 Y1 Z2", "line X1 Y1 Z-1 F100",
                          "rapid X1 Y1 Z3", "rapid X2 Y1 Z3", "rapid X2 Y1 Z2", "line X2 Y1 Z-2 F100",
                          "rapid X2 Y1 Z3", "rapid X3 Y1 Z3", "rapid X3 Y1 Z2", "line X3 Y1 Z-2 F100",
                          "rapid X3 Y1 Z2", "rapid X4 Y1 Z2", "line X4 Y1 Z-2 F100", "rapid X4 Y1 Z2"));
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z3\nG81 X1 Z-1 R2"),
              ElementsAre("rapid Z3", "rapid X1 Z3", "rapid X1 Z2", "line X1 Z-1 F100", "rapid X1 Z2"));
}

TEST(LinuxcncCycles, IncrementsCountFromTheLevelBeforeAndFromR) {
  // R-1 from Z3 is 2, Z-3 from there -1; two holes at a step of 1.
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z3 X4\nG91 G81 X1 Z-3 R-1 L2"),
              ElementsAre("rapid X4 Z3", "rapid X5 Z3", "rapid X5 Z2", "line X5 Z-1 F100", "rapid X5 Z2",
                          "rapid X6 Z2", "line X6 Z-1 F100", "rapid X6 Z2"));
}

TEST(LinuxcncCycles, TheToolRisesToRBeforeItGoesToTheHole) {
  EXPECT_THAT(linuxcnc_blocks("F100\nG98 G81 X1 Z-1 R2\nX2"),
              ElementsAre("rapid Z2", "rapid X1 Z2", "line X1 Z-1 F100", "rapid X1 Z2", "rapid X2 Z2",
                          "line X2 Z-1 F100", "rapid X2 Z2"));
}

TEST(LinuxcncCycles, PecksLeaveAQuarterOfAMillimetre) {
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z3\nG83 X1 Z-1 R1 Q.7"),
              ElementsAre("rapid Z3", "rapid X1 Z3", "rapid X1 Z1", "line X1 Z0.3 F100", "rapid X1 Z1",
                          "rapid X1 Z0.554", "line X1 Z-0.4 F100", "rapid X1 Z1", "rapid X1 Z-0.146",
                          "line X1 Z-1 F100", "rapid X1 Z1"));
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z1\nG73 X2 Z-1 R1 Q.7"),
              ElementsAre("rapid Z1", "rapid X2 Z1", "line X2 Z0.3 F100", "rapid X2 Z0.554",
                          "line X2 Z-0.4 F100", "rapid X2 Z-0.146", "line X2 Z-1 F100", "rapid X2 Z1"));
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z1\nG73 X2 Z-.5 R1 Q1 D.5"),
              ElementsAre("rapid Z1", "rapid X2 Z1", "line X2 F100", "rapid X2 Z0.5", "line X2 Z-0.5 F100",
                          "rapid X2 Z1"));
}

TEST(LinuxcncCycles, DwellsAreSecondsAndKeepTheirValue) {
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z2\nG82 X1 Z-1 R2 P1.5\nX2"),
              ElementsAre("rapid Z2", "rapid X1 Z2", "line X1 Z-1 F100", "dwell 1.5", "rapid X1 Z2",
                          "rapid X2 Z2", "line X2 Z-1 F100", "dwell 1.5", "rapid X2 Z2"));
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z3\nG98 G89 X1 Z-1 R2 P1"),
              ElementsAre("rapid Z3", "rapid X1 Z3", "rapid X1 Z2", "line X1 Z-1 F100", "dwell 1",
                          "line X1 Z3 F100"));
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z2 S100 M3\nG86 X1 Z-1 R2 P1"),
              ElementsAre("S100", "M3", "rapid Z2", "rapid X1 Z2", "line X1 Z-1 F100", "dwell 1", "M5",
                          "rapid X1 Z2", "M3"));
  EXPECT_THAT(linuxcnc_blocks("F100 G0 Z3\nG98 G85 X1 Z-1 R2"),
              ElementsAre("rapid Z3", "rapid X1 Z3", "rapid X1 Z2", "line X1 Z-1 F100", "line X1 Z2 F100",
                          "rapid X1 Z3"));
}

TEST(LinuxcncCycles, TappingIsRigid) {
  // 125 mm/min at 100 1/min: 1.25 mm; the spindle turns again when the cycle ends.
  EXPECT_THAT(linuxcnc_blocks("F125 G0 Z2 S100 M3\nG84 X1 Z-1 R2 P.5\nG0 X2"),
              ElementsAre("S100", "M3", "rapid Z2", "M5", "rapid X1 Z2", "tap X1 Z-1 lead1.25", "dwell 0.5",
                          "tap X1 Z2 lead1.25", "M3", "rapid X2 Z2"));
  EXPECT_THAT(
      linuxcnc_blocks("F125 G0 Z2 S100 M4\nG74 X1 Z-1 R2\nX2"),
      ElementsAre("S100", "M4", "rapid Z2", "M5", "rapid X1 Z2", "tap X1 Z-1 lead-1.25",
                  "tap X1 Z2 lead-1.25", "rapid X2 Z2", "tap X2 Z-1 lead-1.25", "tap X2 Z2 lead-1.25"));
}

TEST(LinuxcncCycles, OtherPlanesDrillAlongTheirNormal) {
  EXPECT_THAT(
      linuxcnc_blocks("G18 F100 G0 Y2\nG81 X1 Z1 Y-1 R1"),
      ElementsAre("rapid Y2", "rapid X1 Y2 Z1", "rapid X1 Y1 Z1", "line X1 Y-1 Z1 F100", "rapid X1 Y1 Z1"));
}

TEST(LinuxcncCycles, WordsThatAreMissingOrWrongAreAlarms) {
  EXPECT_THAT(linuxcnc_blocks("F100\nG81 X1 Z-1"), ElementsAre("alarm 1601 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG81 X1 R1"), ElementsAre("alarm 1601 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG81 Z-1 R1 X0\nG0 X5\nG81 X6"),
              ElementsAre("rapid Z1", "line Z-1 F100", "rapid Z1", "rapid X5 Z1", "alarm 1601 4:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG81 X1 Z1 R-1"), ElementsAre("alarm 1609 2:11"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG83 X1 Z-1 R1"), ElementsAre("alarm 1602 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG83 X1 Z-1 R1 Q-1"), ElementsAre("alarm 1602 2:15"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG82 X1 Z-1 R1"), ElementsAre("alarm 1108 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG81 X1 Z-1 R1 L0"), ElementsAre("alarm 1106 2:15"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG81 X1 Z-1 R1 A9"), ElementsAre("alarm 1107 2:15"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG81 X1 Z-1 R1 P1"), ElementsAre("alarm 1107 2:15"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG81"), ElementsAre("alarm 1108 2:1"));
  EXPECT_THAT(linuxcnc_blocks("G81 X1 Z-1 R1"), ElementsAre("alarm 1111 1:1"));
  EXPECT_THAT(linuxcnc_blocks("G93 F1\nG81 X1 Z-1 R1 F1"), ElementsAre("alarm 1603 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100 S100\nG84 X1 Z-1 R1"), ElementsAre("S100", "alarm 1642 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100 S100 M3\nG74 X1 Z-1 R1"), ElementsAre("S100", "M3", "alarm 1642 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG86 X1 Z-1 R1 P1"), ElementsAre("alarm 1642 2:1"));
  EXPECT_THAT(linuxcnc_blocks("F100\nG87 X1 Z-1 R1"), ElementsAre("alarm 1192 2:1"));
}

}  // namespace
}  // namespace trunnion::language::test
