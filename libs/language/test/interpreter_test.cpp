// Canonical streams per feature, worked out by hand from the meaning of the words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAreArray;

TestMachine three_offsets() {
  TestMachine machine;
  machine.offsets[1] = {100, 200, 300, 10, 0, 20, 0, 0, 0};  // G55
  machine.reference = {500, 400, 300, 0, 0, 0, 0, 0, 0};
  machine.lengths = {{1, 50.0}, {2, 80.5}};
  return machine;
}

class Stream : public testing::TestWithParam<Golden> {};

TEST_P(Stream, IsWhatTheProgramMeans) {
  TestMachine machine = three_offsets();
  EXPECT_THAT(stream(run(machine, GetParam().program)), ElementsAreArray(GetParam().commands))
      << GetParam().rule << "\n"
      << GetParam().program;
}

const Golden motion[] = {
    {"rapid and line, F and motion are modal",
     "G0 X10 Y20\nG1 Z-5 F100\nX30\n",
     {"rapid X10 Y20", "line X10 Y20 Z-5 F100", "line X30 Y20 Z-5 F100", "end 0"}},
    {"blanks are optional, case is free, points are optional",
     "g0x10y20.\nG 1 z -.5 f+100.0\n",
     {"rapid X10 Y20", "line X10 Y20 Z-0.5 F100", "end 0"}},
    {"a move to where the tool is makes no command", "G0 X0\nG1 X0 F50\nG91 X0\n", {"end 0"}},
    {"modal state of a block without a move counts",
     "G1 F50 G91\nX1\nX1\n",
     {"line X1 F50", "line X2 F50", "end 0"}},
    {"incremental words",
     "G91 G0 X1 Y2\nX1\nG90 X1\n",
     {"rapid X1 Y2", "rapid X2 Y2", "rapid X1 Y2", "end 0"}},
    // 1 inch = 25.4 mm; rotary words are degrees in either unit; F10 inch/min = 254 mm/min.
    {"inches scale lengths and feed",
     "G20 G1 X1 A90 U2 F10\nG21 X1\n",
     {"line X25.4 A90 U50.8 F254", "line X1 A90 U50.8 F254", "end 0"}},
    {"F of rotary axes alone is degrees per minute in inches too",
     "G20 G1 C90 F360\n",
     {"line C90 F360", "end 0"}},
    {"nine axes", "G0 X1 Y2 Z3 A4 B5 C6 U7 V8 W9\n", {"rapid X1 Y2 Z3 A4 B5 C6 U7 V8 W9", "end 0"}},
    {"rotary axes are absolute degrees",
     "G0 C350\nC10\nC-730\n",
     {"rapid C350", "rapid C10", "rapid C-730", "end 0"}},
    // G55 = (100, 200, 300, A10, C20).
    {"work offset is added to absolute words only",
     "G55 G0 X1 A5\nG91 X1\nG54 G90 X1\n",
     {"rapid X101 A15", "rapid X102 A15", "rapid X1 A15", "end 0"}},
    {"tool length is added to Z",
     "G0 Z100\nG43 H1 Z100\nG18 Z90\nG49\nZ90\n",
     {"rapid Z100", "frame none L50 Z100", "rapid Z150", "rapid Z140", "frame none L0 Z140", "rapid Z90",
      "end 0"}},
    {"H0 has length zero", "G43 H0 Z1\nG43 H2\nG43 H2\n", {"rapid Z1", "frame none L80.5 Z1", "end 0"}},
    {"machine coordinates know no offset, length or G91, and stay one block",
     "G55 G0 X0\nG43 H1 G91\nG53 X10 Z20\nX1\nG53 G1 X11.5 F10\n",
     {"rapid X100", "frame none L50 X100", "rapid X10 Z20", "rapid X11 Z20", "line X11.5 Z20 F10", "end 0"}},
    {"reference return goes over the point given, named axes only",
     "G0 X10 Y10 Z10\nG28 X20 Z30\nG91 G28 Z0\n",
     {"rapid X10 Y10 Z10", "rapid X20 Y10 Z30", "rapid X500 Y10 Z300", "end 0"}},
    {"incremental reference return of one axis",
     "G0 X10 Z10\nG91 G28 Z5\n",
     {"rapid X10 Z10", "rapid X10 Z15", "rapid X10 Z300", "end 0"}},
    {"inverse time wants F in each block and does not scale it",
     "G93 G20 G1 X1 F2\nX2 F4\n",
     {"line X25.4 F2", "line X50.8 F4", "end 0"}},
    {"feed per revolution", "G95 G1 X1 F0.2\n", {"line X1 F0.2", "end 0"}},
};
INSTANTIATE_TEST_SUITE_P(Motion, Stream, testing::ValuesIn(motion));

const Golden arcs[] = {
    // From (10,0) about the origin: a quarter anticlockwise ends at (0,10), clockwise the way there is 270
    // degrees.
    {"quarter anticlockwise",
     "G0 X10\nG3 X0 Y10 I-10 F100\n",
     {"rapid X10", "arc Y10 ccw 0 0 0 90deg F100", "end 0"}},
    {"three quarters clockwise",
     "G0 X10\nG2 X0 Y10 I-10 J0 F100\n",
     {"rapid X10", "arc Y10 cw 0 0 0 270deg F100", "end 0"}},
    {"R takes the short arc, negative R the long one",
     "G0 X10\nG3 X0 Y10 R10 F100\nG0 X10 Y0\nG3 X0 Y10 R-10\n",
     {"rapid X10", "arc Y10 ccw 0 0 0 90deg F100", "rapid X10", "arc Y10 ccw 10 10 0 270deg F100", "end 0"}},
    {"full circle from the centre alone",
     "G0 X10\nG2 I-10 F100\n",
     {"rapid X10", "arc X10 cw 0 0 0 360deg F100", "end 0"}},
    {"L counts begun turns",
     "G0 X10\nG2 X10 I-10 L3 F100\nG3 X0 Y10 I-10 L2\n",
     {"rapid X10", "arc X10 cw 0 0 0 1080deg F100", "arc Y10 ccw 0 0 0 450deg F100", "end 0"}},
    {"helix: the centre stays at the start's height",
     "G0 X10 Z5\nG3 X0 Y10 Z7 I-10 A30 F100\n",
     {"rapid X10 Z5", "arc Y10 Z7 A30 ccw 0 0 5 90deg F100", "end 0"}},
    // ZX plane: anticlockwise about +Y goes from Z to X. From Z10 a quarter anticlockwise about the origin
    // ends at X10.
    {"plane ZX takes I and K",
     "G18 G0 Z10\nG3 X10 Z0 K-10 F100\n",
     {"rapid Z10", "arc X10 ccw 0 0 0 90deg F100", "end 0"}},
    {"plane YZ takes J and K",
     "G19 G0 Y10\nG3 Y0 Z10 J-10 F100\n",
     {"rapid Y10", "arc Z10 ccw 0 0 0 90deg F100", "end 0"}},
    {"arcs are modal",
     "G0 X10\nG3 X0 Y10 I-10 F100\nX-10 Y0 J-10\n",
     {"rapid X10", "arc Y10 ccw 0 0 0 90deg F100", "arc X-10 ccw 0 0 0 90deg F100", "end 0"}},
    {"inches scale centre and radius",
     "G20 G91 G3 X-1 Y1 I-1 F1\n",
     {"arc X-25.4 Y25.4 ccw -25.4 0 0 90deg F25.4", "end 0"}},
};
INSTANTIATE_TEST_SUITE_P(Arcs, Stream, testing::ValuesIn(arcs));

const Golden auxiliary[] = {
    {"order in a block: S T, M before, motion, M after",
     "M9 M3 G1 X1 M8 T7 S1000 F50\n",
     {"S1000", "T7", "M3", "M8", "line X1 F50", "M9", "end 0"}},
    {"clamps and other M act before the motion",
     "G0 X1 M10\nX2 M999\n",
     {"M10", "rapid X1", "M999", "rapid X2", "end 0"}},
    {"stop and end act after the motion", "G0 X1 M0\nX2 M30\nX3\n", {"rapid X1", "M0", "rapid X2", "end 30"}},
    {"M2 ends", "M2\n", {"end 2"}},
    {"dwell: P in milliseconds, X and U in seconds",
     "G4 P1500\nG4 X1.5\nG04 U2\nG4 P0\n",
     {"dwell 1.5", "dwell 1.5", "dwell 2", "dwell 0", "end 0"}},
    {"dwell does not disturb modal motion",
     "G1 X1 F10\nG4 X3\nX2\n",
     {"line X1 F10", "dwell 3", "line X2 F10", "end 0"}},
    {"tool length after the tool change, before the motion",
     "T1 M6 G43 H1 G0 Z10\n",
     {"T1", "M6", "frame none L50", "rapid Z60", "end 0"}},
    {"G40, G80, G94 and N are accepted",
     "N10 G40 G80 G49 G94 G17 G21 G54 G64 G90\nN20 G0 X1\n",
     {"rapid X1", "end 0"}},
};
INSTANTIATE_TEST_SUITE_P(Auxiliary, Stream, testing::ValuesIn(auxiliary));

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
    if (number == 98 || number == 99) continue;
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
