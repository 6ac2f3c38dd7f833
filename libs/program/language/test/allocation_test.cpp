// SPDX-License-Identifier: Apache-2.0
// The interpreter allocates when it is made and never again.
#include <gtest/gtest.h>

#include "test_machine.hpp"
#include "testing_support/allocation_count.hpp"

namespace trunnion::language::test {
namespace {

using testing_support::allocations;

TEST(Allocation, NoneFromStartToEndWithCallsArcsAndTransformations) {
  TestMachine machine;
  machine.lengths = {{1, 100.0}};
  std::string text = "G90 G54 F100 S1000 M3\nG43.4 H1\n";
  for (int i = 0; i < 2000; ++i) text += "G1 X1.5 Y2 A10 C20\nG3 X3 R10 L2\nG0 X0 (comment) M8\n";
  text += "M98 P5 L100\nG49\nG4 P10\nM30\nO5\nG91 X1\nM99\n";
  StringSource source(text);
  Interpreter interpreter(machine);
  Command command;
  std::size_t commands = 0;
  const std::size_t before = allocations;
  interpreter.start(source, {}, {});
  Step step = Step::command;
  while (step == Step::command || step == Step::working) {
    step = interpreter.next(command);
    commands += step == Step::command ? 1 : 0;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(step, Step::end) << interpreter.alarm().text.data();
  // S, M3, frame; 2000 times line, arc, M8, rapid; 100 calls of one move; frame, dwell, end.
  EXPECT_EQ(commands, 3u + 2000u * 4 + 100 + 3);
}

TEST(Allocation, NoneWithFramesCyclesCurvesAndCompensation) {
  TestMachine machine;
  machine.tools[1] = {100, 0, 2, 0};
  std::string text = "G43 H1 F100 S100 M3\n";
  for (int i = 0; i < 200; ++i) {
    text += "G51 X0 Y0 Z0 P2\nG68 X0 Y0 R30\nG51.1 X5\nG52 X1\nG10 L2 P1 X0\nG10 L11 P1 R0.1\n";
    text += "G41 D1 G1 X50\nX100 M8\nY50\nG3 X50 Y100 R60\nG1 X0\nG40 X-50 Y-50\nG50 G69 G50.1\n";
    text += "G83 X0 Z-10 R1 Q1\nG70 X0 Y0 I10 J0 K6\nG80\n";
    text += "G0 X0 Y0 Z0\nG6.2 P3 K0 F100\nK0 X5 Y5\nK0 X10 Y0\nK1\nK1\nK1\nG0 X0\n";
  }
  StringSource source(text);
  Interpreter interpreter(machine);
  Command command;
  const std::size_t before = allocations;
  interpreter.start(source, {}, {});
  Step step = Step::command;
  while (step == Step::command || step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(step, Step::end) << interpreter.alarm().line << interpreter.alarm().text.data();
}

TEST(Allocation, NoneWithSubroutinesNamesAndMessages) {
  TestMachine machine;
  machine.dialect = ProgramDialect::linuxcnc;
  const std::string_view text =
      "o<turn> sub\n#<a>=#1\n#<_width>=[#<a>*2]\nG1 X#<a> Y#<_width> F100\no<turn> endsub [#<a>]\n"
      "#<n>=0\no100 while [#<n> LT 500]\n#<n>=[#<n>+1] (DEBUG,n %d#<n>)\no<turn> call [#<n>]\n"
      "o101 if [#<_value> EQ 3]\no100 continue\no101 endif\no102 repeat [2]\nG0 X0\no102 endrepeat\n"
      "o100 endwhile\nM9 M5 T1 M6\nM2\n";
  StringSource source(text);
  Interpreter interpreter(machine);
  Command command;
  const std::size_t before = allocations;
  interpreter.start(source, {}, {});
  Step step = Step::command;
  while (step == Step::command || step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(step, Step::end) << interpreter.alarm().line << interpreter.alarm().text.data();
}

TEST(Allocation, NoneWithSplinesThreadsAndSavedModes) {
  TestMachine machine;
  machine.dialect = ProgramDialect::linuxcnc;
  const std::string_view text =
      "o1 sub\nM73\nG91 G5 X1 Y1 I0 J3 P0 Q-3\no1 endsub\nF100 S100 M3\no1 call\n"
      "G5.2 X9 Y1\nX9 Y8\nG5.3\nG18 G76 P1 Z-10 I-2 J.2 K.6 R2 Q29.5 H1 E.5 L3\nM2\n";
  StringSource source(text);
  Interpreter interpreter(machine);
  Command command;
  const std::size_t before = allocations;
  interpreter.start(source, {}, {});
  Step step = Step::command;
  while (step == Step::command || step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(step, Step::end) << interpreter.alarm().line << interpreter.alarm().text.data();
}

/// A program of any length, made while it is read: one line again and again.
struct EndlessText : TextSource {
  ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    if (offset >= bytes) return {ReadStatus::end, 0};
    const std::size_t size = std::min<std::uint64_t>(capacity, bytes - offset);
    for (std::size_t i = 0; i < size; ++i) buffer[i] = line[(offset + i) % line.size()];
    return {ReadStatus::bytes, size};
  }
  std::string_view line =
      "G1 X1 Y2 (a comment that makes a gigabyte of fewer blocks, for the length of the text is the point)\n";
  std::uint64_t bytes = 0;
};

TEST(Allocation, NoneHoweverLongTheProgramIs) {
  TestMachine machine;
  EndlessText text;
  text.bytes = text.line.size() * 1000000;
  Interpreter interpreter(machine);
  ModalState modal;
  modal.feed = 100;
  Command command;
  const std::size_t before = allocations;
  interpreter.start(text, {}, modal);
  Step step = Step::command;
  while (step == Step::command || step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(step, Step::end) << interpreter.alarm().text.data();
  EXPECT_EQ(interpreter.blocks(), 1000000u);
}

TEST(Allocation, NoneForALineThatIsPrinted) {
  TestMachine machine;
  StringSource source("#1=12.5\nDPRNT[X#1[53] text #1[09]]\nM30\n");
  Interpreter interpreter(machine);
  Command command;
  const std::size_t before = allocations;
  interpreter.start(source, {}, {});
  Step step = Step::command;
  while (step == Step::command || step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(step, Step::end) << interpreter.alarm().text.data();
}

TEST(Allocation, NoneForAnAlarm) {
  TestMachine machine;
  StringSource source("G0 X1\nG77\n");
  Interpreter interpreter(machine);
  Command command;
  interpreter.start(source, {}, {});
  const std::size_t before = allocations;
  EXPECT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(interpreter.next(command), Step::alarm);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace trunnion::language::test
