// SPDX-License-Identifier: Apache-2.0
// Variables over programs, and the system variables.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

/// Runs a text to its end and keeps the variables.
VariableStore after(std::string_view text, const VariableStore& before, Environment& machine,
                    const ControlTime& time = {}) {
  Interpreter interpreter(machine);
  StringSource source(text);
  interpreter.set_time(time);
  interpreter.start(source, {}, {}, before);
  Command command;
  Step step = Step::command;
  while (step == Step::command || step == Step::working) step = interpreter.next(command);
  EXPECT_EQ(step, Step::end) << interpreter.alarm().text.data();
  return interpreter.variables();
}

TEST(Variables, StoreGoesFromProgramToProgramAndLocalsDoNot) {
  TestMachine machine;
  const VariableStore first =
      after("#1=1 #50=2 #199=3 #500=4 #999=5 #50000=6 #54999=7 #52100=8", no_variables, machine);
  EXPECT_EQ(first.common.front().number, 2);
  EXPECT_EQ(first.common.back().number, 3);
  EXPECT_EQ(first.kept.front().number, 4);
  EXPECT_EQ(first.kept.back().number, 5);
  EXPECT_EQ(first.user.front().number, 6);
  EXPECT_EQ(first.user.back().number, 7);
  EXPECT_EQ(first.user[2100].number, 8);
  EXPECT_FALSE(first.kept[1].given);
  const VariableStore second = after("#501=#500+1 #502=#1", first, machine);
  EXPECT_EQ(second.kept[1].number, 5);
  EXPECT_FALSE(second.kept[2].given);
}

// As on Fanuc 30i and 31i: 7400 of them, read and written in one line like the others.
TEST(Variables, TheExtendedCommonOnesAreKept) {
  TestMachine machine;
  const VariableStore first = after("#900000=1 #901001=2 #907399=#901001+1", no_variables, machine);
  EXPECT_EQ(first.extended.front().number, 1);
  EXPECT_EQ(first.extended[1001].number, 2);
  EXPECT_EQ(first.extended.back().number, 3);
  EXPECT_FALSE(first.extended[1].given);
  EXPECT_EQ(after("#500=#901001", first, machine).kept[0].number, 2);
  for (const char* beyond : {"#899999=1", "#907400=1"})
    EXPECT_EQ(run(machine, beyond).alarm.number, AlarmNumber::variable_unknown) << beyond;
}

TEST(Variables, InterpretingAgainFromTheStoreOfTheStartGivesTheSame) {
  TestMachine machine;
  const std::string text =
      "#500=#500+1\nG0 X#500\nWHILE #1 LT 3\n#1=#1+1\n#100=#100+#500\nY#100\nENDW\nM30\n";
  const VariableStore before = after("#500=5 #100=2", no_variables, machine);
  Interpreter interpreter(machine);
  StringSource source(text);
  std::vector<std::string> runs[2];
  for (auto& lines : runs) {
    interpreter.start(source, {}, {}, before);
    Command command;
    while (interpreter.next(command) == Step::command) lines.push_back(brief(command));
  }
  EXPECT_THAT(runs[0],
              testing::ElementsAre("rapid X6", "rapid X6 Y8", "rapid X6 Y14", "rapid X6 Y20", "end 30"));
  EXPECT_EQ(runs[0], runs[1]);
}

/// What each expression of a list gives after `before`.
std::vector<double> values(TestMachine& machine, const std::string& before,
                           const std::vector<std::string>& expressions, const ControlTime& time = {}) {
  std::string text = before + "\n";
  for (std::size_t i = 0; i < expressions.size(); ++i)
    text += "#" + std::to_string(500 + i) + "=" + expressions[i] + "\n";
  const VariableStore store = after(text, no_variables, machine, time);
  std::vector<double> result;
  for (std::size_t i = 0; i < expressions.size(); ++i) result.push_back(store.kept[i].number);
  return result;
}

using testing::ElementsAre;

TEST(SystemVariables, PositionsInMachineAndWorkpiece) {
  TestMachine machine;
  machine.offsets[1] = {10, 20, 30, 0, 0, 45, 0, 0, 0};
  machine.lengths = {{1, 50}};
  const std::string before = "G55 G90 G43 H1\nG0 X1 Y2 Z3 C5";
  EXPECT_THAT(values(machine, before, {"#5001", "#5002", "#5003", "#5006", "#5041", "#5043"}),
              ElementsAre(1, 2, 3, 5, 1, 3));
  EXPECT_THAT(values(machine, before, {"#5021", "#5022", "#5023", "#5026"}), ElementsAre(11, 22, 83, 50));
  EXPECT_THAT(values(machine, before, {"#5083", "#5081", "#2201", "#5241", "#5243", "#5246", "#5221"}),
              ElementsAre(50, 0, 50, 10, 30, 45, 0));
}

TEST(SystemVariables, LengthsAreInTheUnitsOfTheProgram) {
  TestMachine machine;
  machine.offsets[0] = {25.4, 0, 0, 0, 0, 90, 0, 0, 0};
  machine.lengths = {{1, 50.8}};
  const auto inches =
      values(machine, "G20\nG0 X2 C10", {"#5001", "#5006", "#5021", "#5026", "#2201", "#5221", "#5226"});
  const std::vector<double> expected{2, 10, 3, 100, 2, 1, 90};
  ASSERT_EQ(inches.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(inches[i], expected[i], 1e-12) << i;
}

TEST(SystemVariables, RadiusOfTheActiveDHasItsWear) {
  TestMachine machine;
  machine.tools[1] = {50, 0, 5, 0.25};
  machine.tools[2] = {50, 0, std::nullopt, 0};
  EXPECT_THAT(values(machine, "D1", {"#4199", "[#4199 EQ #0]"}), ElementsAre(5.25, 0));
  EXPECT_THAT(values(machine, "G0 X1", {"#4199", "[#4199 EQ #0]"}), ElementsAre(0, 0)) << "no D: 0";
  EXPECT_THAT(values(machine, "D2", {"[#4199 EQ #0]"}), ElementsAre(1)) << "vacant";
  EXPECT_THAT(values(machine, "G20 D1", {"#4199*25.4"}), ElementsAre(testing::DoubleEq(5.25)));
  machine.cutter.wear_sign = -1;
  EXPECT_THAT(values(machine, "D1", {"#4199"}), ElementsAre(4.75));
}

TEST(SystemVariables, PositionOfAnAxisThatTheChannelDoesNotHaveIsVacant) {
  TestMachine machine;
  machine.axis_mask = 0b101111;  // no B
  EXPECT_THAT(values(machine, "G0 X1", {"#5021", "[#5024 EQ #0]", "[#5025 EQ #0]", "[#5026 EQ #0]"}),
              ElementsAre(1, 0, 1, 0));
}

TEST(SystemVariables, ModalStateOfTheBlocksBefore) {
  TestMachine machine;
  machine.lengths = {{3, 50}};
  EXPECT_THAT(
      values(machine, "", {"#4001", "#4002", "#4003", "#4005", "#4006", "#4008", "#4012", "#4014", "#4015"}),
      ElementsAre(0, 17, 90, 94, 21, 49, 67, 54, 64));
  const std::string before = "O77\nN12 G1 G18 G91 G95 G20 G43 H3 G59 G61 F1 S500 T8\nG66 P5";
  EXPECT_THAT(values(machine, before,
                     {"#4001", "#4002", "#4003", "#4005", "#4006", "#4008", "#4012", "#4014", "#4015"}),
              ElementsAre(1, 18, 91, 95, 20, 43, 66, 59, 61));
  EXPECT_THAT(values(machine, before, {"#4109", "#4111", "#4114", "#4115", "#4119", "#4120"}),
              ElementsAre(1, 3, 12, 77, 500, 8));
}

TEST(SystemVariables, TimeIsHandedIn) {
  TestMachine machine;
  EXPECT_THAT(values(machine, "", {"#3001", "#3002", "#3011", "#3012"}), ElementsAre(0, 0, 0, 0));
  const ControlTime time{5000, 2.5, 20250131, 235959};
  EXPECT_THAT(values(machine, "", {"#3001", "#3002", "#3011", "#3012"}, time),
              ElementsAre(5000, 2.5, 20250131, 235959));
  EXPECT_THAT(values(machine, "#3001=0\n#3002=1", {"#3001", "#3002"}, time), ElementsAre(0, 1));

  // A timer that was set runs on.
  StringSource source("#3001=0\nG0 X1\nX[#3001]\n");
  Interpreter interpreter(machine);
  interpreter.set_time(time);
  interpreter.start(source, {}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  interpreter.set_time({5250, 2.5, 20250131, 235959});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 250);
}

TEST(SystemVariables, ModalStateOfFramesAndCycles) {
  TestMachine machine;
  machine.tools[4] = {50, 0, 3, 0};
  EXPECT_THAT(
      values(machine, "", {"#4007", "#4009", "#4010", "#4011", "#4013", "#4016", "#4018", "#4022", "#4130"}),
      ElementsAre(40, 80, 98, 50, 97, 69, 15, 50.1, 0));
  EXPECT_THAT(values(machine, "G99 G51 X0 Y0 P2\nG51.1 X0\nG68 X0 Y0 R30\nG54.1 P7",
                     {"#4010", "#4011", "#4016", "#4022", "#4014", "#4130"}),
              ElementsAre(99, 51, 68, 51.1, 54.1, 7));
  EXPECT_THAT(values(machine, "G16", {"#4018"}), ElementsAre(16));
  EXPECT_THAT(values(machine, "G41 D4", {"#4007", "#4107"}), ElementsAre(41, 4));
}

TEST(SystemVariables, PositionsUnderFrames) {
  TestMachine machine;
  machine.offsets[0] = {100, 0, 0, 0, 0, 0, 0, 0, 0};
  // Turned by 90 degrees about the zero of the workpiece: program (10, 0) is workpiece (0, 10), machine (100,
  // 10).
  const auto turned =
      values(machine, "G68 X0 Y0 R90\nG0 X10 Y0", {"#5001", "#5002", "#5041", "#5042", "#5021", "#5022"});
  const std::vector<double> expected{10, 0, 0, 10, 100, 10};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(turned[i], expected[i], 1e-12) << i;
}

TEST(SystemVariables, WritingATableActsAtOnceAndIsPassedOn) {
  TestMachine machine;
  machine.tools[1] = {50, 0, 4, 0};
  EXPECT_THAT(
      stream(run(machine,
                 "#5221=10\nG0 X1\n#5246=45\nG55 C0\n#7041=3\nG54.1 P3 X0\n#1=1 #2201=60\nG43 H1 Z0\nM30\n")),
      ElementsAre("table1 0 X10", "rapid X11", "table1 1 C45", "rapid X11 C45", "table1 8 X3", "rapid X3 C45",
                  "table2 1 60", "frame none L60 X3 C45", "rapid X3 Z60 C45", "end 30"));
  EXPECT_THAT(values(machine, "#2001=0.5\n#2401=-0.1\n#2601=3\n#2205=7",
                     {"#2001", "#2201", "#2401", "#2601", "#2205", "#2605"}),
              ElementsAre(0.5, 50, -0.1, 3, 7, 0));
  // In inches 1 is 25.4 mm.
  EXPECT_THAT(values(machine, "G20\n#5221=1\nG21", {"#5221"}), ElementsAre(25.4));
  EXPECT_FALSE(after("#500=#2203", no_variables, machine).kept[0].given);
}

TEST(SystemVariables, SkipPositionIsWhereTheMachineStopped) {
  TestMachine machine;
  machine.offsets[0] = {100, 0, 0, 0, 0, 0, 0, 0, 0};
  StringSource source("G31 X50 F100\n#500=#5061\nG0 X[#5061+1]\n");
  Interpreter interpreter(machine);
  interpreter.start(source, {100}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::skip);
  ASSERT_EQ(interpreter.next(command), Step::position);
  interpreter.set_position({130.5});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 131.5);
  EXPECT_EQ(interpreter.variables().kept[0].number, 30.5);
  // The next program still finds it, in its own units.
  EXPECT_NEAR(after("G20\n#501=#5061\nM30", interpreter.variables(), machine).kept[1].number, 30.5 / 25.4,
              1e-12);
}

TEST(SystemVariables, EveryRangeOfTheTableIsApartFromTheOthers) {
  std::uint32_t next = 0;
  for (const VariableRange& range : variable_ranges) {
    EXPECT_GE(range.first, next);
    EXPECT_GE(range.last, range.first);
    next = range.last + 1;
  }
}

// The answers of the service, one after the other; then the rest of the program.
std::vector<std::string> answered(
    TestMachine& machine, const std::string& text, std::vector<double> answers,
    const std::function<void()>& before_answer = [] {}) {
  StringSource source(text);
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  Interpretation result;
  Command command;
  std::size_t next = 0;
  do {
    result.last = interpreter.next(command);
    if (result.last == Step::command) result.commands.push_back(command);
    if (result.last != Step::answer) continue;
    EXPECT_EQ(interpreter.next(command), Step::answer) << "nothing is read before the answer";
    before_answer();
    interpreter.answer(next < answers.size() ? answers[next] : 0);
    ++next;
  } while (result.last != Step::end && result.last != Step::alarm);
  result.alarm = interpreter.alarm();
  return stream(result);
}

TEST(Variables, ACalledCycleIsAnsweredBeforeTheNextBlockAndItsAnswerIsRead) {
  TestMachine machine;
  EXPECT_THAT(answered(machine, "G0 X1\n#3100=9960\nG0 X[10+#3100]\n#3100=0\nG0 X[20+#3100]\nM30\n", {1, 0}),
              ElementsAre("rapid X1", "cycle 9960", "rapid X11", "cycle 0", "rapid X20", "end 30"));
}

TEST(Variables, APartThatTheServiceHasChangedIsReadAgain) {
  TestMachine machine;
  int texts = 0;
  const auto store = [&] {
    machine.programs["O99601"] =
        std::make_unique<StringSource>(texts++ == 0 ? "G0 X5\nM99\n" : "G0 X7 Y1\nG0 Y0\nM99\n");
  };
  // The text before lives on, as the channel's does; the machine of the test forgets it.
  EXPECT_THAT(
      answered(machine, "#3100=9960\nWHILE [#3100 EQ 1]\nM98 P99601\n#3100=0\nENDW\nM30\n", {1, 1, 0}, store),
      ElementsAre("cycle 9960", "rapid X5", "cycle 0", "rapid X7 Y1", "rapid X7", "cycle 0", "end 30"));
}

TEST(Variables, ACycleIsNotCalledInCutterCompensationNorByAWrongNumber) {
  TestMachine machine;
  machine.tools[1] = {0, 0, 2, 0};
  const auto result = run(machine, "G41 D1 G1 X10 F100\n#3100=9960\nM30\n");
  EXPECT_EQ(result.alarm.number, AlarmNumber::compensation_active);
  EXPECT_EQ(result.alarm.line, 2u);
  EXPECT_EQ(run(machine, "#3100=-1\nM30\n").alarm.number, AlarmNumber::variable_value);
  EXPECT_EQ(run(machine, "#3100=10000\nM30\n").alarm.number, AlarmNumber::variable_value);
}

}  // namespace
}  // namespace trunnion::language::test
