// SPDX-License-Identifier: Apache-2.0
// Rotary axes that count modulo 360.
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using canonical::RotaryWay;

// Where C goes, line by line.
std::vector<double> c_of(RotaryWay way, const std::string& program, AxisValues start = {}) {
  TestMachine machine;
  machine.ways[C] = way;
  machine.reference = {};
  const Interpretation result = run(machine, program, start);
  EXPECT_EQ(result.last, Step::end) << result.alarm.text.data();
  std::vector<double> places;
  for (const Command& command : result.commands)
    if (command.kind == CommandKind::rapid || command.kind == CommandKind::line ||
        command.kind == CommandKind::arc)
      places.push_back(command.target[C]);
  return places;
}

using Places = std::vector<double>;

TEST(Rollover, TheShorterWayGoesOnOverZero) {
  const std::string program = "G0 C359\nG1 C359.5 F500\nC0\nC0.5\nC180\nC0\nC181\nC0\nG91 C-720\nG90 C10\n";
  EXPECT_EQ(c_of(RotaryWay::shortest, program), (Places{-1, -0.5, 0, 0.5, 180, 360, 181, 360, -360, -350}));
  EXPECT_EQ(c_of(RotaryWay::linear, program), (Places{359, 359.5, 0, 0.5, 180, 0, 181, 0, -720, 10}));
}

TEST(Rollover, TheSignOfTheWordIsTheDirection) {
  // Where C is already it makes no turn: C80 and C-10 move nothing.
  EXPECT_EQ(c_of(RotaryWay::by_sign, "G0 C90\nC-80\nC80\nC-0\nC10\nC-10\n"), (Places{90, 80, 0, 10}));
  // 10 in the positive direction from 90 is the next turn, in the negative direction from 10 it is there.
  EXPECT_EQ(c_of(RotaryWay::by_sign, "G0 C90\nC10\nC-90\n"), (Places{90, 370, 90}));
}

// C20 from the zero at 350 is 370, the nearest 10. G53 C300 is -60. G28 goes over the program's 0, -10, to
// the reference position 0.
TEST(Rollover, EveryFrameAndEveryCodeTakesTheSameWay) {
  EXPECT_EQ(c_of(RotaryWay::shortest, "G52 C350\nG0 C20\nG53 C300\nG28 C0\n"), (Places{10, -60, -10, 0}));
  EXPECT_EQ(c_of(RotaryWay::shortest, "G0 C170\nG3 X0 Y0 I5 C-170 F100\n"), (Places{170, 190}));
}

// Mirrored about 0, C10 is -10 and C350 is -350, that is 10. A positive word turns in the negative direction.
TEST(Rollover, AMirrorTurnsTheOtherWayRound) {
  EXPECT_EQ(c_of(RotaryWay::shortest, "G51.1 C0\nG0 C10\nC350\nC170\nC190\n"), (Places{-10, 10, -170, -190}));
  EXPECT_EQ(c_of(RotaryWay::by_sign, "G51.1 C0\nG0 C10\nC-350\nC340\n"), (Places{-10, 10, -340}));
}

// 1e6 turns: 360 * 1e6 + 0.125 is a double, and so is every step.
TEST(Rollover, IsExactAfterAMillionTurns) {
  EXPECT_EQ(c_of(RotaryWay::shortest, "G91 G0 C360000000\nG90 C0.125\nC359.75\nC0\nC90\n"),
            (Places{360000000, 360000000.125, 359999999.75, 360000000, 360000090}));
  EXPECT_EQ(canonical::shown_angle(RotaryWay::shortest, 360000000.125), 0.125);
  EXPECT_EQ(canonical::shown_angle(RotaryWay::shortest, -0.25), 359.75);
  EXPECT_EQ(canonical::shown_angle(RotaryWay::linear, -0.25), -0.25);
}

}  // namespace
}  // namespace trunnion::language::test
