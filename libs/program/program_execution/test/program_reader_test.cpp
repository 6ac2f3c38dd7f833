// SPDX-License-Identifier: Apache-2.0
// A whole program, read for somebody who only wants to know what it does.
#include "program_execution/program_reader.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace trunnion::program_execution {
namespace {

/// X Y Z of 400 mm to either side, without a spindle.
struct Reading : ::testing::Test {
  Reading() : machine(0) {
    for (std::uint32_t a = 0; a < 3; ++a) {
      parameters.values[40001 + a] = {static_cast<double>(a), ""};
      parameters.values[100000 + a * 1000] = {0, std::string(1, "XYZ"[a])};
      parameters.values[100006 + a * 1000] = {400, ""};
      parameters.values[100007 + a * 1000] = {-400, ""};
    }
    machine.configure(parameters);
  }
  Ending read(const std::string& program, const ReadingOptions& options = {}) {
    reader = std::make_unique<ProgramReader>(machine, options);
    return run(program);
  }
  /// On a machine of which only the axes are known.
  Ending read_anywhere(const std::string& program) {
    language::Environment& environment = machine;
    reader = std::make_unique<ProgramReader>(environment);
    return run(program);
  }
  Ending run(const std::string& program) {
    commands.clear(), moves.clear(), from.clear();
    reader->on_command = [this](const language::Command& command, const language::Command& move) {
      commands.push_back(command), moves.push_back(move), from.push_back(reader->from());
    };
    reader->stop = stop;
    language::StringSource source(program);
    return reader->read(source, {});
  }
  std::uint32_t alarm() const { return static_cast<std::uint32_t>(reader->alarm().number); }

  machine::Parameters parameters;
  channel_setup::ChannelSetup machine;
  std::unique_ptr<ProgramReader> reader;
  std::function<bool()> stop;
  std::vector<language::Command> commands, moves;
  std::vector<AxisValues> from;
};

TEST_F(Reading, GivesEveryCommandWithItsMoveAndTheEndOfTheOneBefore) {
  EXPECT_EQ(read("G90 F6000\nG1 X10\nM8\nG31 X20\nG1 X[#5061+5]\nG4 P100\nM30\n"), Ending::end);
  using language::CommandKind;
  const CommandKind kinds[] = {CommandKind::line, CommandKind::auxiliary, CommandKind::skip,
                               CommandKind::line, CommandKind::dwell,     CommandKind::end};
  ASSERT_EQ(commands.size(), std::size(kinds));
  for (std::size_t i = 0; i < commands.size(); ++i) EXPECT_EQ(commands[i].kind, kinds[i]) << i;
  EXPECT_EQ(moves[2].kind, CommandKind::line) << "as motion takes a skip move";
  EXPECT_EQ(from[2][language::X], 10);
  EXPECT_EQ(from[3][language::X], 20) << "no input has ended the move";
  EXPECT_EQ(commands[3].target[language::X], 25);
}

TEST_F(Reading, ASearchForReferencesEndsAtTheReferencePosition) {
  parameters.values[100012] = {30, ""};
  machine.configure(parameters);
  EXPECT_EQ(read("G90 F6000\nG1 X10\nG28.2 X0\nG91 G1 X1\nM30\n"), Ending::end);
  ASSERT_EQ(commands.size(), 4u);
  EXPECT_EQ(commands[1].kind, language::CommandKind::home);
  EXPECT_EQ(from[2][language::X], 30);
  EXPECT_EQ(commands[2].target[language::X], 31);
}

TEST_F(Reading, JudgesAMoveAsMotionWouldAndNotWhereTheMachineIsNotKnown) {
  const std::string no_speed = "G90 G95 F0.1\nG1 X10\nM30\n", far = "G90 F100\nG1 X401\nM30\n",
                    tap = "G90 S400 M3\nG0 Z5\nG99 G84 X0 Y0 Z-10 R2 F500\nG80\nM30\n";
  EXPECT_EQ(read(no_speed), Ending::alarm);
  EXPECT_EQ(alarm(), 1112u);
  EXPECT_EQ(reader->alarm().line, 2u);
  EXPECT_EQ(read(far), Ending::alarm);
  EXPECT_EQ(alarm(), 140u);
  EXPECT_EQ(reader->alarm().line, 2u);
  EXPECT_EQ(read(tap), Ending::alarm);
  EXPECT_EQ(alarm(), 1125u) << "there is no spindle";
  EXPECT_EQ(reader->alarm().line, 3u);
  for (const auto& program : {no_speed, far, tap}) EXPECT_EQ(read_anywhere(program), Ending::end) << program;
}

TEST_F(Reading, StrokesOfATapAreMovesOfTheProgram) {
  EXPECT_EQ(read_anywhere("G90 S400 M3\nG0 Z5\nG99 G84 X0 Y0 Z-10 R2 F500\nG80\nG0 X5\nM30\n"), Ending::end);
  std::size_t strokes = 0;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (commands[i].kind != language::CommandKind::tap) continue;
    ++strokes;
    EXPECT_EQ(moves[i].kind, language::CommandKind::line);
    EXPECT_NEAR(moves[i].modal.feed, 500, 1e-9);
  }
  EXPECT_EQ(strokes, 2u) << "into the hole and out of it";
}

TEST_F(Reading, AStrokeOutOfTheTravelEndsTheReading) {
  parameters.values[105000] = {0, "S"}, parameters.values[105001] = {10, ""};
  parameters.values[105036] = {12000, ""};
  machine.configure(parameters);
  int asked = 0;
  stop = [&] { return ++asked > 1000; };
  EXPECT_EQ(read("G90 S400 M3\nG0 Z5\nG99 G84 X0 Y0 Z-410 R2 F500\nG80\nM30\n"), Ending::alarm);
  EXPECT_EQ(alarm(), 140u);
  EXPECT_EQ(reader->alarm().line, 3u);
}

TEST_F(Reading, ACycleOfAnotherServiceHasNoParts) {
  EXPECT_EQ(read("G90 F6000\nG65 P9010\nG1 X[20+#3100]\nM30\nO9010\n#3100=12\nM99\n"), Ending::end);
  ASSERT_GE(commands.size(), 2u);
  EXPECT_EQ(commands[0].kind, language::CommandKind::cycle);
  EXPECT_EQ(commands[1].target[language::X], 20);
}

TEST_F(Reading, SpindlesAreHomedAndSynchronized) {
  EXPECT_EQ(read("WHILE #4801 EQ 0\nM3\nENDW\n#4822=1\nWHILE #4812 EQ 0\nENDW\nG0 X1\nM30\n"), Ending::end);
  // Read: 4801, both marks of 4822, 4812.
  using language::CommandKind;
  const CommandKind kinds[] = {
      CommandKind::read, CommandKind::read,  CommandKind::read, CommandKind::spindle_order,
      CommandKind::read, CommandKind::rapid, CommandKind::end};
  ASSERT_EQ(commands.size(), std::size(kinds));
  for (std::size_t i = 0; i < commands.size(); ++i) EXPECT_EQ(commands[i].kind, kinds[i]) << i;
  EXPECT_EQ(moves[0].kind, CommandKind::dwell);
  ReadingOptions options;
  options.most_idle_reads = 100;
  EXPECT_EQ(read("WHILE #4812 EQ 1\nENDW\nM30\n", options), Ending::idle);
}

TEST_F(Reading, SignalsOfThePlcAreZeroAndThenEitherSoThatAProgramThatWaitsGoesOn) {
  EXPECT_EQ(
      read("WHILE #1000 EQ 0\nENDW\nWHILE #1000 EQ 1\nENDW\nG0 X1\nIF #1003 EQ 1 GOTO 9\n#1100=1\nN9 M30\n"),
      Ending::end);
  // 0, 1 for the first loop; 0 for the second; behind the move 0 again.
  using language::CommandKind;
  const CommandKind kinds[] = {CommandKind::read,  CommandKind::read, CommandKind::read,
                               CommandKind::rapid, CommandKind::read, CommandKind::spindle_order,
                               CommandKind::end};
  ASSERT_EQ(commands.size(), std::size(kinds));
  for (std::size_t i = 0; i < commands.size(); ++i) EXPECT_EQ(commands[i].kind, kinds[i]) << i;
}

TEST_F(Reading, EndsWhereAProgramWouldRepeatForEver) {
  EXPECT_EQ(read("G90 F100\nN1 G0 X1\nX2\nGOTO 1\n"), Ending::repeats);
  EXPECT_EQ(reader->repeats_from(), 2u);
  EXPECT_EQ(read("G0 X1\nM99\n"), Ending::end) << "once through is all there is";
}

// What it reads of itself is the same in each pass; the second one moves to another place each time.
TEST_F(Reading, AProgramRepeatsAlsoWhenItReadsItsOwnPosition) {
  const std::string same = "G90 F100\nN10 G0 X1\nG1 X2\n#531=#5001\n#532=#4003\nGOTO 10\n";
  EXPECT_EQ(read(same), Ending::repeats);
  EXPECT_EQ(reader->repeats_from(), 2u);
  EXPECT_EQ(read_anywhere(same), Ending::repeats);
  // Until it is at 3, which a pass with another position could not show.
  EXPECT_EQ(read_anywhere("G91 F100\nN10 G1 X1\nIF [#5001 LT 3] GOTO 10\nM30\n"), Ending::end);
  EXPECT_EQ(from.back()[language::X], 3);
}

TEST_F(Reading, GivesUpAProgramThatReturnsVeryOften) {
  ReadingOptions options;
  options.most_returns = 1000;
  EXPECT_EQ(read("N1 #1=#1+1\nG90 G0 X[#1 MOD 7]\nGOTO 1\n", options), Ending::returns);
  EXPECT_EQ(reader->repeats_from(), 1u);
  EXPECT_EQ(read("N1 #1=#1+1\nG90 G0 X[#1 MOD 7]\nIF [#1 LT 1000] GOTO 1\nM30\n", options), Ending::end);
}

TEST_F(Reading, GivesUpAProgramThatWaitsForATime) {
  ReadingOptions options;
  options.most_idle_lines = 50000;
  EXPECT_EQ(read("N1 IF [#3001 LT 1000] GOTO 1\nM30\n", options), Ending::idle);
}

TEST_F(Reading, IsStoppedAlsoInALoopOfMovesAndFunctions) {
  int asked = 0;
  stop = [&] { return ++asked > 100; };
  ReadingOptions options;
  options.find_repetition = false;
  EXPECT_EQ(read("N1 G0 X1\nM8\nX0\nM9\nGOTO 1\n", options), Ending::stopped);
  EXPECT_EQ(read("N1 G0 X1\nGOTO 1\n", options), Ending::stopped);
}

}  // namespace
}  // namespace trunnion::program_execution
