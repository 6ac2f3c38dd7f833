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

}  // namespace
}  // namespace trunnion::language::test
