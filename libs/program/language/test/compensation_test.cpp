// SPDX-License-Identifier: Apache-2.0
// Cutter radius compensation: what waits at a corner, and where an MDI line ends.
#include <gtest/gtest.h>

#include <random>

#include "language/planar_piece.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TestMachine machine_with_cutters() {
  TestMachine machine;
  machine.tools[1] = {0, 0, 5, 0};
  machine.tools[2] = {0, 0, 5, -1};
  machine.tools[3] = {0, 0, 2, 0};
  return machine;
}

// More commands wait at a corner than the queue of a block has room for.
TEST(Compensation, WhatWaitsComesOutInOrderHoweverMuchItIs) {
  for (const bool at_the_end : {false, true}) {
    TestMachine machine = machine_with_cutters();
    std::string text = "G41 D1 G1 X10 F100\nX30\n";
    for (int i = 0; i < 60; ++i) text += "M" + std::to_string(100 + i) + "\n";
    const Interpretation result = run(machine, text + (at_the_end ? "M30\n" : "Y20\nG40 X0\nG0 Z1\n"));
    ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
    ASSERT_EQ(result.commands.size(), at_the_end ? 63u : 66u);
    for (std::size_t i = 0; i < result.commands.size(); ++i) EXPECT_EQ(result.commands[i].sequence, i + 1);
    for (unsigned i = 0; i < 60; ++i) {
      EXPECT_EQ(result.commands[2 + i].number, 100 + i);
      // They act where the move before them ends: at the inside corner, or square to the end.
      EXPECT_NEAR(result.commands[2 + i].target[X], at_the_end ? 30 : 25, 1e-12);
    }
    EXPECT_EQ(result.commands.back().kind, CommandKind::end);
    EXPECT_EQ(result.modal.cutter_side, CutterSide::off);
  }
}

TEST(Compensation, EndOfAnMdiLineLeavesThePositionWhereTheToolIs) {
  TestMachine machine = machine_with_cutters();
  StringSource text("G41 D1 G1 X10 F100\nX30\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  while (interpreter.next(command) == Step::command) {
  }
  EXPECT_NEAR(interpreter.position()[X], 30, 1e-12);
  EXPECT_NEAR(interpreter.position()[Y], 5, 1e-12);
}

/// Where the commands end, in the plane.
std::vector<Vector2> ends(const Interpretation& result) {
  std::vector<Vector2> points;
  for (const Command& command : result.commands)
    if (command.kind == CommandKind::line || command.kind == CommandKind::arc)
      points.push_back({command.target[X], command.target[Y]});
  return points;
}

bool passes(const Interpretation& result, Vector2 point) {
  for (const Vector2 end : ends(result))
    if (std::hypot(end.u - point.u, end.v - point.v) < 0.1) return true;
  return false;
}

// Two quarters of R20 touch at (40,-20) and turn back: a slot that becomes narrower without end. The tool of
// R5 is between them where both offsets, R25 about (20,-20) and about (60,-20), meet: (40, -20 + 15). A joint
// that is rounded to thousandths lets the arcs cross a little before it.
TEST(Compensation, TwoArcsThatTouchWhereTheyTurnBackAreLeftWhereTheToolNoLongerFits) {
  for (const double off : {0.0, -0.001, -0.003, -0.01, 0.001, 0.003, 0.01}) {
    TestMachine machine = machine_with_cutters();
    char text[300];
    std::snprintf(text, sizeof text,
                  "G0 X-20 Y0\nG1 G41 D1 X0 Y0 F300\nX20\nG2 X40 Y%.3f R20\nG2 X60 Y0 R20\nG1 X80\nG40 "
                  "X100\nM30\n",
                  -20 + off);
    const Interpretation result = run(machine, text);
    ASSERT_EQ(result.last, Step::end) << off << " " << result.alarm.text.data();
    EXPECT_TRUE(passes(result, {40, -5})) << off;
    for (const Vector2 end : ends(result)) EXPECT_GT(end.v, -5.1) << off;
  }
}

// The line X0 downwards and the arc R20 about (20,-20) upwards: offset by 5 they are X5 and R25, which meet
// at -20 + sqrt(25^2 - 15^2) = 0.
TEST(Compensation, ALineAndAnArcThatTurnBackAreLeftWhereTheToolNoLongerFits) {
  TestMachine machine = machine_with_cutters();
  const Interpretation result = run(machine,
                                    "G0 X0 Y40\nG1 G41 D1 Y20 F300\nY-20\nG2 X20 Y0 I20 J0\nG1 X80\nG40 "
                                    "X100\nM30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  EXPECT_TRUE(passes(result, {5, 0}));
  for (const Vector2 end : ends(result)) EXPECT_GT(end.v, -0.1);
}

// The same arcs with the tool on the other side: a sharp edge, which it goes around.
TEST(Compensation, TheToolGoesAroundAnEdgeOfTwoArcsThatTurnBack) {
  TestMachine machine = machine_with_cutters();
  const Interpretation result = run(machine,
                                    "G0 X-20 Y0\nG1 G42 D1 X0 Y0 F300\nX20\nG2 X40 Y-20 R20\nG2 X60 Y0 R20\n"
                                    "G1 X80\nG40 X100\nM30\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  // Half a circle of R5 about (40,-20), between the squares of both arcs.
  EXPECT_TRUE(passes(result, {35, -20}));
  EXPECT_TRUE(passes(result, {45, -20}));
}

// A pocket and a boss, with arcs that lead tangentially onto the circle and off it across each other.
TEST(CompensationInterference, OfArcsThatLeadOntoACircleAndOffItIsNone) {
  for (const char* const text :
       {"G0 X0 Y0\nG1 G41 D1 X10 Y-10 F300\nG3 X20 Y0 R10\nG3 I-20\nG3 X10 Y10 R10\nG1 G40 X0 Y0\nM30\n",
        "G0 X40 Y0\nG1 G42 D1 X30 Y-10 F300\nG2 X20 Y0 R10\nG3 I-20\nG2 X30 Y10 R10\nG1 G40 X40 Y0\nM30\n"}) {
    TestMachine machine = machine_with_cutters();
    machine.cutter.check_blocks = 3;
    const Interpretation result = run(machine, text);
    EXPECT_EQ(result.last, Step::end) << text << result.alarm.text.data();
  }
}

TEST(CompensationInterference, NamesTheMoveThatWouldCutAndTheOneItWouldCutInto) {
  TestMachine machine = machine_with_cutters();
  const Interpretation result = run(machine, "G41 D1 G1 X1 F100\nX30\nY20\nX1 Y1\nG40 X-20\n");
  EXPECT_EQ(result.alarm.number, AlarmNumber::compensation_interference);
  EXPECT_EQ(result.alarm.line, 2u);
  EXPECT_EQ(std::string(result.alarm.text.data()), "tool would cut into the contour nearby, that of line 4");
}

}  // namespace
}  // namespace trunnion::language::test
