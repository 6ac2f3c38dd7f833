// SPDX-License-Identifier: Apache-2.0
// G27, which checks a reference position, and G45 to G48, which change the length of a move by an offset.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

TEST(ReferenceCheck, GoesThereWhenItIsTheReference) {
  TestMachine machine = machine_with_references();  // X500 Y400 Z300
  EXPECT_THAT(stream(run(machine, "G0 X1\nG27 X500 Y400\nG27 Z300\nG55 G27 X400\nM30\n")),
              ElementsAre("rapid X1", "rapid X500 Y400", "rapid X500 Y400 Z300", "end 30"));
  // Rounded words are within 0.001 mm; rotary axes that turn for ever count modulo 360.
  machine.reference[X] = 500.0004;
  machine.ways[C] = canonical::RotaryWay::shortest;
  EXPECT_EQ(run(machine, "G27 X500 C360\n").last, Step::end);
  EXPECT_EQ(run(machine, "G20\nG27 Y15.748\n").last, Step::end) << "15.748 inch are 399.9992 mm";
}

TEST(ReferenceCheck, MovesNothingWhenItIsNot) {
  TestMachine machine = machine_with_references();
  const auto result = run(machine, "G0 X1\nG27 X500 Y399\n");
  EXPECT_EQ(result.commands.size(), 1u);
  EXPECT_EQ(result.alarm.number, AlarmNumber::reference_missed);
  EXPECT_THAT(result.alarm.text.data(), testing::EndsWith(": Y399, Y would be at 399.0000, not at 400.0000"));
  // A tool length or an offset shifts it, as on any other move.
  machine.lengths = {{1, 50.0}};
  EXPECT_EQ(run(machine, "G43 H1\nG27 Z300\n").alarm.number, AlarmNumber::reference_missed);
  EXPECT_EQ(run(machine, "G43 H1\nG27 Z250\n").last, Step::end);
  EXPECT_EQ(run(machine, "G55 G27 X500\n").alarm.number, AlarmNumber::reference_missed);
}

/// D1 is 4 + 0.5 mm, D2 -3 mm.
TestMachine machine_with_radii() {
  TestMachine machine;
  machine.tools[1] = {0, 0, 4, 0.5};
  machine.tools[2] = {0, 0, -3, 0};
  return machine;
}

TEST(OffsetMoves, GrowAndShrinkInTheirDirection) {
  TestMachine machine = machine_with_radii();
  EXPECT_THAT(stream(run(machine, "G91 G0\nG45 X10 D1\nG46 X10\nG47 Y-10\nG48 Y-10\nM30\n")),
              // 14.5; 14.5 + 5.5; -19; -19 - 1
              ElementsAre("rapid X14.5", "rapid X20", "rapid X20 Y-19", "rapid X20 Y-20", "end 30"));
  // Both axes of a block, at feed; a negative offset exchanges G45 and G46.
  EXPECT_THAT(stream(run(machine, "G91 G1 F100 G45 X10 Y-10 D1\nG45 X10 D2\nM30\n")),
              ElementsAre("line X14.5 Y-14.5 F100", "line X21.5 Y-14.5 F100", "end 30"));
}

TEST(OffsetMoves, OfAbsoluteWordsBeginAtThePosition) {
  TestMachine machine = machine_with_radii();
  // From 0 to 10 and the offset beyond it, back to 0 and the offset beyond that; without a way there is none.
  EXPECT_THAT(stream(run(machine, "G0 G45 X10 D1\nG45 X0 Y0\nG0 X0\nG45 X0\nM30\n")),
              ElementsAre("rapid X14.5", "rapid X-4.5", "rapid", "end 30"));
  // G48 of a way that is shorter than twice the offset goes back.
  EXPECT_THAT(stream(run(machine, "G0 G48 X5 D1\nM30\n")), ElementsAre("rapid X-4", "end 30"));
}

TEST(OffsetMoves, AnIncrementalZeroGoesByTheOffset) {
  TestMachine machine = machine_with_radii();
  EXPECT_THAT(stream(run(machine, "G91 G0 G45 X0 D1\nG45 X-0\nG46 Y0\nG45 X0 D0\nM30\n")),
              ElementsAre("rapid X4.5", "rapid", "rapid Y-4.5", "end 30"));
}

TEST(OffsetMoves, RotaryAxesGoAsTheyAreWritten) {
  TestMachine machine = machine_with_radii();
  EXPECT_THAT(stream(run(machine, "G0 G45 X10 C30 D1\nM30\n")), ElementsAre("rapid X14.5 C30", "end 30"));
}

}  // namespace
}  // namespace trunnion::language::test
