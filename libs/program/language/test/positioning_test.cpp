// SPDX-License-Identifier: Apache-2.0
// Positioning codes, modal values that are passed on, spindle modes, helices and skip moves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TEST(Positioning, ValuesThatArePassedOn) {
  TestMachine machine = machine_with_references();
  const Interpretation result =
      run(machine, "G92 S3000\nG96 S100\nG5.1 Q2\nG64 P0.02 Q0.01\nG98 G1 X1 F10\nG99 G9 X2\nX3\nG61 X4\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  ASSERT_EQ(result.commands.size(), 6u);
  const ModalState& first = result.commands[1].modal;
  EXPECT_EQ(first.spindle_limit, 3000);
  EXPECT_EQ(first.spindle_mode, SpindleMode::surface);
  EXPECT_EQ(first.surface_speed, 100);
  EXPECT_EQ(first.smoothing, 2);
  EXPECT_EQ(first.path_tolerance, 0.02);
  EXPECT_TRUE(first.return_to_initial);
  // G9 stops in its own block only.
  EXPECT_EQ(result.commands[2].modal.path_control, PathControl::exact_stop);
  EXPECT_FALSE(result.commands[2].modal.return_to_initial);
  EXPECT_EQ(result.commands[3].modal.path_control, PathControl::continuous);
  EXPECT_EQ(result.commands[4].modal.path_control, PathControl::exact_stop);
}

TEST(Positioning, SpindleDirectionIsModal) {
  TestMachine machine;
  const Interpretation result = run(machine, "M3 G0 X1\nM4\nX2\nM19\nX3 M5\n");
  ASSERT_EQ(result.commands.size(), 8u);
  EXPECT_EQ(result.commands[1].modal.spindle_direction, SpindleDirection::cw);
  EXPECT_EQ(result.commands[3].modal.spindle_direction, SpindleDirection::ccw);
  EXPECT_EQ(result.commands[5].modal.spindle_direction, SpindleDirection::stopped);
}

TEST(Orientation, ROrPOfM19IsItsAngleWithinATurn) {
  TestMachine machine;
  using Lines = std::vector<std::string>;
  EXPECT_EQ(
      stream(run(machine, "M19\nM19 R90.\nM19 P270\nN4 M19 R-90 S100\nM19 R360\nM19 R-360 M8\nM19 R0\n")),
      (Lines{"M19", "M19 at 90", "M19 at 270", "S100", "M19 at 270", "M19 at 0", "M19 at 0", "M8", "M19 at 0",
             "end 0"}));
  EXPECT_EQ(stream(run(machine, "G20 M19\nM19 R12.5\n")), (Lines{"M19", "M19 at 12.5", "end 0"}))
      << "an angle has no inches";
  EXPECT_EQ(stream(run(machine, "G2 X10 Y0 R5 F100\nM19 R30\n"))[1], "M19 at 30") << "it is no radius";
  EXPECT_EQ(stream(run(machine, "M19 R90 M0\nM19 P45 M30\n")),
            (Lines{"M19 at 90", "M0", "M19 at 45", "end 30"}));
  EXPECT_EQ(stream(run(machine, "M19 R360.5\n")), (Lines{"alarm 1106 1:5"}));
}

// R and P keep the meaning that they have in blocks with other codes or with axis words.
TEST(Orientation, ROrPOfAnotherCodeIsNoAngle) {
  TestMachine machine;
  using Lines = std::vector<std::string>;
  EXPECT_EQ(stream(run(machine, "G4 P500 M19\n")), (Lines{"M19", "dwell 0.5", "end 0"}));
  EXPECT_EQ(stream(run(machine, "M3 R90\n")), (Lines{"alarm 1107 1:4"}));
  EXPECT_EQ(stream(run(machine, "M19 P90 R80\n")), (Lines{"alarm 1107 1:5"})) << "one angle";
  const auto hole = stream(run(machine, "G81 Z-10 R2 F100\nM19 R3\n"));
  EXPECT_EQ(hole.at(hole.size() - 5), "M19") << "it drills a hole from another level";
}

TEST(Orientation, OtherCodesTakeAnAngleWhereTheMachineSaysSo) {
  TestMachine machine;
  using Lines = std::vector<std::string>;
  EXPECT_EQ(stream(run(machine, "M80 R90\n")), (Lines{"alarm 1107 1:5"}));
  machine.angle_codes = {19, 80, 81, -1};
  // -30 deg are 330; a code without an angle, and one that takes none, have none.
  EXPECT_EQ(stream(run(machine, "M19 R10\nM80 R90\nM81 P-30\nM80\nM82\n")),
            (Lines{"M19 at 10", "M80 at 90", "M81 at 330", "M80", "M82", "end 0"}));
  EXPECT_EQ(stream(run(machine, "M82 R90\n")), (Lines{"alarm 1107 1:5"}));
  const auto refused = run(machine, "M81 R400\n");
  EXPECT_EQ(refused.alarm.number, AlarmNumber::value_range);
  EXPECT_NE(std::string(refused.alarm.text.data()).find("the angle of M81 is -360 to 360 deg"),
            std::string::npos)
      << refused.alarm.text.data();
  machine.angle_codes = {-1, -1, -1, -1};
  EXPECT_EQ(stream(run(machine, "M19 R90\n")), (Lines{"alarm 1107 1:5"}));
}

TEST(Skip, NothingIsReadBeforeThePositionIsKnown) {
  TestMachine machine = machine_with_references();
  StringSource text("G55 G91 G31 X20 F100 M8\nX1 G0\nG90 X1\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::auxiliary);
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::skip);
  EXPECT_EQ(command.target[X], 20);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(interpreter.next(command), Step::position);
  interpreter.set_position({12.5});
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 13.5);
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 101);
  EXPECT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::end);
}

// X is bit 0, Z bit 2 and C bit 5; F is the speed of the search and no feed.
TEST(Homing, NamesItsAxesAndTheirReferencePositions) {
  TestMachine machine = machine_with_references();
  EXPECT_THAT(stream(run(machine, "F300\nG28.2 X0 Z0\nG1 X1\n", {1, 2, 3})),
              testing::ElementsAre("home5 X500 Y2 Z300", "line X1 Y2 Z300 F300", "end 0"));
  EXPECT_THAT(stream(run(machine, "F2000 G159 C X Z\n", {0, 2})),
              testing::ElementsAre("home37 X500 Y2 Z300 F2000", "end 0"));
  EXPECT_THAT(stream(run(machine, "G28.2 Z (down) F600 M8 ; comment\n")),
              testing::ElementsAre("M8", "home4 Z300 F600", "end 0"));
}

TEST(Homing, NothingIsReadBeforeThePositionIsKnownAndTheSkipPositionStays) {
  TestMachine machine = machine_with_references();
  StringSource text("G55 G28.2 X0 M9\n#500=#5061\nG91 G1 X1 F100\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {7}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::home);
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::auxiliary);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(interpreter.next(command), Step::position);
  EXPECT_TRUE(interpreter.homing());
  interpreter.set_position({499.75});
  EXPECT_FALSE(interpreter.homing());
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.target[X], 500.75);
  EXPECT_EQ(interpreter.variables().kept[0].number, 0);
}

TEST(Homing, IsRefusedWhereItsAxesAreNotThoseOfTheMachine) {
  TestMachine machine = machine_with_references();
  machine.lengths[1] = 50;
  machine.axis_mask = 0b101111;  // X Y Z A C
  const auto alarm = [&](const char* text) { return run(machine, text).alarm.number; };
  EXPECT_EQ(alarm("G28.2\n"), AlarmNumber::missing_word);
  EXPECT_EQ(alarm("G28.2 B0\n"), AlarmNumber::axis_absent);
  EXPECT_EQ(alarm("G28.2 X0 F0\n"), AlarmNumber::feed_not_positive);
  EXPECT_EQ(alarm("G43.4 H1\nG28.2 X0\n"), AlarmNumber::machine_coordinates_rtcp);
  EXPECT_EQ(alarm("G0 X\n"), AlarmNumber::number_missing) << "a letter alone names an axis only here";
  EXPECT_EQ(alarm("G28.2 X P\n"), AlarmNumber::number_missing);
  EXPECT_EQ(alarm("G28.2 X0\n"), AlarmNumber::none);
}

// Bits 0 and 2: X and Z had their reference when the program began.
TEST(Homing, AVariableSaysWhichAxesHaveTheirReference) {
  TestMachine machine = machine_with_references();
  const auto read = [&](std::optional<std::uint16_t> homed, const char* program) {
    StringSource text(program);
    Interpreter interpreter(machine);
    interpreter.set_homed(homed);
    interpreter.start(text, {}, {});
    Command command;
    auto step = Step::command;
    while (step == Step::command || step == Step::position) {
      step = interpreter.next(command);
      if (step == Step::position) interpreter.set_position({});
    }
    if (step == Step::alarm) return std::pair(-1.0, interpreter.alarm().number);
    return std::pair(interpreter.variables().kept[0].number, AlarmNumber::none);
  };
  const char* const weights = "#500=#1321+10*#1322+100*#1323\n";
  EXPECT_EQ(read(0b101, weights), std::pair(101.0, AlarmNumber::none));
  EXPECT_EQ(read(0b101, "G28.2 Y0\n#500=#1321+10*#1322+100*#1323\n"), std::pair(111.0, AlarmNumber::none));
  EXPECT_EQ(read(std::nullopt, "G28.2 Y0\n#500=#1322\n"), std::pair(1.0, AlarmNumber::none));
  EXPECT_EQ(read(std::nullopt, weights), std::pair(-1.0, AlarmNumber::homed_unknown));
  EXPECT_EQ(read(0, "#1321=1\n"), std::pair(-1.0, AlarmNumber::variable_read_only));
}

// The feed of the machine counts in its block alone, and where the block has none.
TEST(Skip, TheNumberedCodesHaveAFeedOfTheMachine) {
  TestMachine machine;
  machine.skips[0] = {4, 80};
  EXPECT_THAT(stream(run(machine, "G31.1 X5\nG1 X10 F30\nG31.1 X20 F40\nX30\n")),
              testing::ElementsAre("skip4 X5 F80", "line X10 F30", "skip4 X20 F40", "line X30 F40", "end 0"));
  // In G20, too, it is mm/min, and deg/min of a rotary axis.
  EXPECT_THAT(stream(run(machine, "G20 G95 G31.1 X1\nG31.1 A5\n")),
              testing::ElementsAre("skip4 X25.4 F80", "skip4 X25.4 A5 F80", "end 0"));
  const Interpretation result = run(machine, "G95 F1\nG31.1 X1\nG1 X2\n");
  EXPECT_EQ(result.commands[0].modal.feed_mode, FeedMode::per_minute);
  EXPECT_EQ(result.commands[1].modal.feed_mode, FeedMode::per_revolution);
  EXPECT_EQ(result.commands[1].modal.feed, 1);
}

TEST(Skip, POfACallIsNoInput) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G31 X20 F100 M98 P200\nM30\nO200\nG0 Y1\nM99\n")),
              testing::ElementsAre("skip1 X20 F100", "rapid X20 Y1", "end 30"));
  EXPECT_EQ(run(machine, "G31 L2 P3 X20 F100\n").alarm.number, AlarmNumber::unused_word);
}

TEST(Skip, WithoutAWayThereIsNothingToWaitFor) {
  TestMachine machine;
  StringSource text("G31 X0 F1\nG0 X1\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  ASSERT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::rapid);
}

}  // namespace
}  // namespace trunnion::language::test
