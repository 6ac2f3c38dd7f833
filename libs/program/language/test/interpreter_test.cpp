// SPDX-License-Identifier: Apache-2.0
// Counting, modal state, restarts and every code of the table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TestMachine three_offsets() {
  TestMachine machine;
  machine.offsets[1] = {100, 200, 300, 10, 0, 20, 0, 0, 0};  // G55
  machine.reference = {500, 400, 300, 0, 0, 0, 0, 0, 0};
  machine.lengths = {{1, 50.0}, {2, 80.5}};
  return machine;
}

TEST(Interpreter, CountsCommandsAndNamesLines) {
  TestMachine machine;
  const Interpretation result = run(machine, "%1234\n\nG0 X1 M8\n(nothing)\nX2\n");
  ASSERT_EQ(result.commands.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(result.commands[i].sequence, i + 1);
  EXPECT_EQ(result.commands[0].line, 3u);
  EXPECT_EQ(result.commands[1].line, 3u);
  EXPECT_EQ(result.commands[2].line, 5u);
}

TEST(Interpreter, ModalStateOfEachCommandIsTheOneItWasMadeIn) {
  TestMachine machine = three_offsets();
  const Interpretation result = run(machine, "G55 G18 G91 G20 G61 S500 T3 M6\nT4 G1 X1 F10\nG43 H2 G95\n");
  const ModalState& change = result.commands[2].modal;  // S, T, M6
  EXPECT_EQ(change.tool, 3);
  const ModalState& line = result.commands[4].modal;
  EXPECT_EQ(line.motion, 1);
  EXPECT_EQ(line.plane, Plane::zx);
  EXPECT_FALSE(line.absolute);
  EXPECT_FALSE(line.metric);
  EXPECT_EQ(line.path_control, PathControl::exact_stop);
  EXPECT_EQ(line.work_offset, 1);
  EXPECT_EQ(line.tool, 3);
  EXPECT_EQ(line.selected_tool, 4);
  EXPECT_EQ(line.spindle_speed, 500);
  EXPECT_DOUBLE_EQ(line.feed, 254);  // 10 inch/min
  EXPECT_EQ(result.modal.length_offset, 2);
  EXPECT_EQ(result.modal.tool_length, 80.5);
  EXPECT_EQ(result.modal.feed_mode, FeedMode::per_revolution);
  EXPECT_EQ(result.modal.feed, 0);  // forgotten with G94
}

TEST(Interpreter, MdiLineContinuesTheModalStateOfTheLineBefore) {
  TestMachine machine = three_offsets();
  const Interpretation first = run(machine, "G91 G1 X1 F100 T5");
  ASSERT_EQ(first.last, Step::end);
  const AxisValues position = first.commands.back().target;
  const Interpretation second = run(machine, "X1 M6", position, first.modal);
  EXPECT_THAT(stream(second), testing::ElementsAre("M6", "line X2 F100", "end 0"));
  EXPECT_EQ(second.modal.tool, 5);
}

TEST(Interpreter, SetPositionMovesTheStartOfTheNextBlock) {
  TestMachine machine;
  StringSource text("G91 G0 X1\nX1\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 1);
  interpreter.set_position({5});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 6);
}

TEST(Interpreter, RestartFindsTheSameCommandAgain) {
  TestMachine machine;
  const std::string text = "G91 G1 F100 X1\nM98 P2 L5\nG3 X2 R1\nM30\nO2\nX1 M8\nC10\nM99\n";
  const Interpretation whole = run(machine, text);
  ASSERT_EQ(whole.last, Step::end);
  const Interpretation part = run(machine, text, {}, {}, {}, 9);
  ASSERT_EQ(part.commands.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(part.commands[i].target, whole.commands[i].target);
    EXPECT_EQ(part.commands[i].sequence, whole.commands[i].sequence);
    EXPECT_EQ(part.commands[i].line, whole.commands[i].line);
  }
}

TEST(Interpreter, BlockSkipIsAnOption) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "/G0 X1\n / X2\n")), testing::ElementsAre("rapid X1", "rapid X2", "end 0"));
  EXPECT_THAT(stream(run(machine, "/G0 X1\n / X2\nG0 X3", {}, {}, {.block_skip = true})),
              testing::ElementsAre("rapid X3", "end 0"));
}

TEST(Interpreter, ObeysTheExampleOfEveryGCode) {
  for (const GCode& code : g_codes) {
    TestMachine machine = three_offsets();
    machine.further_references[2] = {};
    machine.tools[1] = {50, 0, 4, 0};
    machine.highest_speed = 24000;  // for G96
    machine.planes[1] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}};
    const std::string number = std::to_string(code.tenths / 10) +
                               (code.tenths % 10 != 0 ? "." + std::to_string(code.tenths % 10) : "");
    EXPECT_NE(std::string(code.example).find("G" + number), std::string::npos) << number;
    const Interpretation result = run(machine, std::string(code.example) + "\n");
    EXPECT_EQ(result.alarm.number, AlarmNumber::none) << code.example << ": " << result.alarm.text.data();
    // What a block may hold once of, it may not hold twice.
    const Interpretation twice = run(machine, std::string("G").append(number).append(" G").append(number));
    EXPECT_EQ(twice.alarm.number, AlarmNumber::group_twice) << number;
  }
}

TEST(Interpreter, PassesEveryMCodeOnOrEnds) {
  for (unsigned number = 0; number <= highest_m; ++number) {
    if (number == 98 || number == 99 || number == 198) continue;
    TestMachine machine;
    const Interpretation result = run(machine, "G0 X1 M" + std::to_string(number) + "\n");
    ASSERT_EQ(result.last, Step::end) << number;
    const bool before = m_code(static_cast<std::uint16_t>(number)).when == When::before;
    const Command& command = result.commands[before ? 0 : 1];
    const bool end = number == 2 || number == 30;
    EXPECT_EQ(command.kind, end ? CommandKind::end : CommandKind::auxiliary) << number;
    EXPECT_EQ(command.number, number);
  }
}

TEST(Interpreter, BeforeStartThereIsOnlyTheEnd) {
  TestMachine machine;
  Interpreter interpreter(machine);
  Command command;
  EXPECT_EQ(interpreter.next(command), Step::end);
}

}  // namespace
}  // namespace trunnion::language::test
