// SPDX-License-Identifier: Apache-2.0
// M70 to M73 of the LinuxCNC dialect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linuxcnc_program.hpp"

namespace trunnion::language::test {
namespace {

using ::testing::ElementsAre;

TEST(LinuxcncModalState, M73RestoresAtTheEndOfItsSubroutine) {
  // In the subroutine X1 is an inch from where the tool is; F5 is still in mm.
  const std::string sub =
      "o1 sub\nM73\nG20 G91 F5 S300 G55 G61 G98\nG1 X1\no2 if [#1]\no3 return\no2 endif\nX1\no1 endsub\n";
  TestMachine machine = linuxcnc_machine();
  machine.offsets[1] = {10, 0, 0, 0, 0, 0, 0, 0, 0};
  const Interpretation result = run(machine, sub + "S2500 M3 F200\no1 call [1]\nG1 X2\nM2\n");
  EXPECT_THAT(stream(result),
              ElementsAre("S2500", "M3", "S300", "line X25.4 F5", "S2500", "line X2 F200", "M5", "end 2"));
  EXPECT_EQ(result.modal.path_control, PathControl::continuous);
  EXPECT_FALSE(result.modal.return_to_initial);
  EXPECT_EQ(result.modal.work_offset, 0);
  EXPECT_THAT(stream(run(machine, sub + "S2500 M3 F200\no1 call [0]\nG1 X2\nM2\n")),
              ElementsAre("S2500", "M3", "S300", "line X25.4 F5", "line X50.8 F5", "S2500", "line X2 F200",
                          "M5", "end 2"));
}

TEST(LinuxcncModalState, M72RestoresSpindleCoolantAndLength) {
  EXPECT_THAT(linuxcnc_blocks("M3 S100 M8\nM70\nM5 M9\nM7\nM72\nM72"),
              ElementsAre("S100", "M3", "M8", "M5", "M9", "M7", "M3", "M9", "M8"));
  EXPECT_THAT(linuxcnc_messages("M8\nM70\nM9\nM7\n(DEBUG,%d#<_mist> #<_flood>)\nM72\n"
                                "(DEBUG,%d#<_mist> #<_flood>)"),
              ElementsAre("1 0", "0 1"));
  EXPECT_THAT(linuxcnc_blocks("G43.1 Z5\nM70\nG49\nM72\nG0 Z1"),
              ElementsAre("frame none L5", "frame none L0", "frame none L5", "rapid Z6"));
  EXPECT_THAT(linuxcnc_blocks("F100\nM70\nG19 G90.1 G93\nM72\nG2 X2 I1"),
              ElementsAre("arc X2 cw 1 0 0 180deg F100"));
  EXPECT_THAT(linuxcnc_blocks("M70 (MSG, kept)"), ElementsAre("message 10000"));
}

TEST(LinuxcncModalState, WhatWasSavedBelongsToItsLevel) {
  EXPECT_THAT(linuxcnc_blocks("M72"), ElementsAre("alarm 1647 1:1"));
  EXPECT_THAT(linuxcnc_blocks("M70\nM71\nM72"), ElementsAre("alarm 1647 3:1"));
  EXPECT_THAT(linuxcnc_blocks("o1 sub\nM72\no1 endsub\nM70\no1 call"), ElementsAre("alarm 1647 2:1"));
  // What the subroutine saves is not that of its caller, and M71 takes M73 back.
  EXPECT_THAT(linuxcnc_blocks("o1 sub\nM70\nG91\no1 endsub\nM70\no1 call\nG0 X1\nM72\nX5"),
              ElementsAre("rapid X1", "rapid X5"));
  EXPECT_THAT(linuxcnc_blocks("o1 sub\nM73\nM71\nG91\no1 endsub\no1 call\nG0 X1\nX1"),
              ElementsAre("rapid X1", "rapid X2"));
}

TEST(LinuxcncModalState, WhatIsNotRestoredIsRefused) {
  EXPECT_THAT(linuxcnc_blocks("M70 X1"), ElementsAre("alarm 1192 1:1"));
  EXPECT_THAT(linuxcnc_blocks("G1 X1 F100\nM70 M5"), ElementsAre("line X1 F100", "alarm 1192 2:1"));
  EXPECT_EQ(linuxcnc_blocks("G41.1 D4 G1 X10 F100\nX20\nM70\nG40 X30 Y5\nM72").back(), "alarm 1192 5:1");
  EXPECT_EQ(linuxcnc_blocks("M70\nG5.2 X1 Y1 F100\nM72").back(), "alarm 1645 3:1");
}

}  // namespace
}  // namespace trunnion::language::test
