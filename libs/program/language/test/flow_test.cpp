// SPDX-License-Identifier: Apache-2.0
// Subprograms, ends, and text that arrives in pieces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

TEST(Flow, HeadsTapeMarksAndEnds) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "%\nO1234 (PART)\nG0 X1\nM30\n%\n")), ElementsAre("rapid X1", "end 30"));
  EXPECT_THAT(stream(run(machine, "%1234\nG0 X1\n%\nX2\n")), ElementsAre("rapid X1", "end 0"));
  EXPECT_THAT(stream(run(machine, "%1234\nG0 X1\n%2000\nX2\n")), ElementsAre("rapid X1", "end 0"));
  EXPECT_THAT(stream(run(machine, "")), ElementsAre("end 0"));
}

TEST(Flow, SubprogramInTheSameTextRunsLTimes) {
  TestMachine machine;
  const Interpretation result = run(machine, "%1\nG91 G0 X1\nM98 P20 L3\nX10\nM30\n%20\nX2\nM99\n");
  EXPECT_THAT(stream(result),
              ElementsAre("rapid X1", "rapid X3", "rapid X5", "rapid X7", "rapid X17", "end 30"));
  EXPECT_EQ(result.commands[3].line, 7u);
  EXPECT_EQ(result.commands[4].line, 4u);
}

TEST(Flow, WithoutLTheDigitsBeforeTheLastFourCountTheCallsUnlessThereIsSuchAProgram) {
  TestMachine machine;
  const char* program = "G91 G0\nM98 P30020\nM98 P20020\nM98 P20\nM98 P20 L2\nM30\n%20\nX1\nM99\n";
  std::vector<std::string> calls(8);
  for (int i = 0; i < 8; ++i) calls[static_cast<std::size_t>(i)] = "rapid X" + std::to_string(i + 1);
  calls.emplace_back("end 30");
  EXPECT_THAT(stream(run(machine, program)), ElementsAreArray(calls));
  EXPECT_THAT(stream(run(machine, "G91 G0\nM98 P30020\nM30\n%20\nX1\nM99\n%30020\nY1\nM99\n")),
              ElementsAre("rapid Y1", "end 30"));
  // With L the number is a number; four zeros are no program.
  for (const char* wrong : {"M98 P30020 L2\nM30\nO20\nM99\n", "M98 P30000\nM30\nO3\nM99\n"}) {
    EXPECT_EQ(run(machine, wrong).alarm.number, AlarmNumber::subprogram_missing) << wrong;
  }
  EXPECT_EQ(run(machine, "M98 P30020\nM98 P30020 L2\nM30\nO20\nM99\n").alarm.line, 2u);
}

TEST(Flow, CallFollowsTheMotionOfItsBlock) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G0 X1 M98 P20\nX3\nM2\nO20\nX2\nM99\n")),
              ElementsAre("rapid X1", "rapid X2", "rapid X3", "end 2"));
}

TEST(Flow, SubprogramInAnotherTextIsFoundByName) {
  TestMachine machine;
  machine.programs["O0012"] = std::make_unique<StringSource>("O12\nG0 X5\nM98 P13\nM99\nO13\nG0 X6\nM99\n");
  machine.programs["O12345"] = std::make_unique<StringSource>("G0 X9\nM99\n");
  const Interpretation result = run(machine, "M98 P12\nM98 P12345\nM30");
  EXPECT_THAT(stream(result), ElementsAre("rapid X5", "rapid X6", "rapid X9", "end 30"));
  EXPECT_EQ(result.commands[0].program, 12u);
  EXPECT_EQ(result.commands[1].program, 12u);  // O13 is in the text of O12
  EXPECT_EQ(result.commands[1].line, 6u);
  EXPECT_EQ(result.commands[2].program, 12345u);
  EXPECT_EQ(result.commands[3].program, 0u);
}

TEST(Flow, EightLevelsAreAllowed) {
  TestMachine machine;
  std::string text = "M98 P1\nM30\n";
  for (int i = 1; i <= 7; ++i)
    text += "O" + std::to_string(i) + "\nM98 P" + std::to_string(i + 1) + "\nM99\n";
  text += "O8\nG0 X8\nM99\n";
  EXPECT_THAT(stream(run(machine, text)), ElementsAre("rapid X8", "end 30"));
}

TEST(Flow, EndInASubprogramEndsTheProgram) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "M98 P1\nG0 X1\nM30\nO1\nM2\n")), ElementsAre("end 2"));
}

TEST(Flow, M99InTheMainProgramBeginsAgain) {
  TestMachine machine;
  const Interpretation result = run(machine, "%7\nG91 G0 X1\nM99\n", {}, {}, {}, 3);
  EXPECT_THAT(stream(result), ElementsAre("rapid X1", "rapid X2", "rapid X3"));
  EXPECT_EQ(result.commands[2].sequence, 3u);
}

TEST(Flow, LoopWithoutCommandsGivesTheThreadBack) {
  TestMachine machine;
  Interpreter interpreter(machine);
  Command command;
  StringSource loop("M99");
  interpreter.start(loop, {}, {});
  for (int i = 0; i < 5; ++i) EXPECT_EQ(interpreter.next(command), Step::working);
  StringSource calls("M98 P1 L999999\nM30\nO1\nM99\n");
  interpreter.start(calls, {}, {});
  EXPECT_EQ(interpreter.next(command), Step::working);
  Step step = Step::working;
  while (step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(step, Step::command);
  EXPECT_EQ(command.kind, CommandKind::end);
}

TEST(Flow, LongSearchGivesTheThreadBack) {
  TestMachine machine;
  std::string text = "M98 P1\nM30\n" + std::string(5000, '\n') + "O1\nM99\n";
  StringSource source(text);
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  Command command;
  EXPECT_EQ(interpreter.next(command), Step::working);
  Step step = Step::working;
  while (step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(step, Step::command);
}

/// Counts the bytes it is asked for.
struct CountingSource : TextSource {
  explicit CountingSource(std::string_view text) : whole(text) {}
  ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    const ReadResult result = whole.read(offset, buffer, capacity);
    bytes += result.size;
    return result;
  }
  StringSource whole;
  std::size_t bytes = 0;
};

TEST(Flow, LongTextIsSearchedOnceForEachSubprogram) {
  TestMachine machine;
  std::string text;
  for (int i = 0; i < 100; ++i) text += "M98 P1\n";
  text += "M30\n" + std::string(1000000, '\n') + "O1\nG91 G0 X1\nM99\n";
  CountingSource source(text);
  const Interpretation result = run(machine, source);
  ASSERT_EQ(result.commands.size(), 101u);
  EXPECT_EQ(result.commands[99].target[X], 100);
  // One search of the text, then at most two windows of 16384 bytes for each of 100 calls and returns.
  EXPECT_LT(source.bytes, text.size() + 100 * 2 * 16384 + 2 * 16384);
}

TEST(Flow, StartForgetsTheTextBefore) {
  TestMachine machine;
  Interpreter interpreter(machine);
  StringSource source("M98 P1\nM30\nO1\nG0 X1\nM99\n");
  Command command;
  interpreter.start(source, {}, {});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 1);
  // Another text in the same object: neither its bytes nor its subprograms are where they were.
  source = StringSource("M98 P1\nM30\nG0 X7\nX8\nX9\nO1\nG0 X2\nM99\n");
  interpreter.start(source, {}, {});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 2);
}

TEST(Flow, MoreSubprogramsThanAreRememberedAreFoundAgain) {
  TestMachine machine;
  std::string calls;
  std::string bodies;
  for (int i = 1; i <= 40; ++i) {
    const std::string n = std::to_string(i);
    calls.append("M98 P").append(n).append("\n");
    bodies.append("O").append(n).append("\nX").append(n).append("\nM99\n");
  }
  const Interpretation result = run(machine, "G90 G0\n" + calls + calls + "M30\n" + bodies);
  ASSERT_EQ(result.commands.size(), 81u);
  for (int i = 0; i < 80; ++i) EXPECT_EQ(result.commands[static_cast<std::size_t>(i)].target[X], i % 40 + 1);
}

TEST(Flow, PendingTextIsPassedOnAndResumed) {
  TestMachine machine;
  SlowSource text("G0 X1\n", 4);
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  EXPECT_EQ(interpreter.next(command), Step::pending);  // "G0 X" arrives next
  EXPECT_EQ(interpreter.next(command), Step::pending);  // then "1\n"
  EXPECT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 1);
  EXPECT_EQ(interpreter.next(command), Step::pending);  // then the end
  EXPECT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(interpreter.next(command), Step::end);
}

TEST(Flow, ChunksOfAnySizeGiveTheSameCommands) {
  const std::string text =
      "%1\r\nG91 G0 X1 (\xe5\x8f\xb0)\rM98 P20 L3\n\n\r\n;rest\r\nG1 F5 Y1\rM98 P30\r\nM30\n%20\nX2\r\nM99\n";
  TestMachine machine;
  machine.programs["O0030"] = std::make_unique<SlowSource>("G0 Z1\r\nM99", 3);
  const std::vector<std::string> whole = stream(run(machine, text));
  EXPECT_THAT(whole, ElementsAre("rapid X1", "rapid X3", "rapid X5", "rapid X7", "line X7 Y1 F5",
                                 "rapid X7 Y1 Z1", "end 30"));
  for (std::size_t chunk = 1; chunk < 20; ++chunk) {
    SlowSource slow(text, chunk);
    EXPECT_THAT(stream(run(machine, slow)), ElementsAreArray(whole)) << chunk;
  }
}

}  // namespace
}  // namespace trunnion::language::test
