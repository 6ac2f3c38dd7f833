// SPDX-License-Identifier: Apache-2.0
// Axes that a program or an MDI line homes (G28.2): their order, what ends a search, and what follows it.
#include <vector>

#include "channel_fixture.hpp"
#include "language/alarms.hpp"
#include "machine/alarm_constants.hpp"
#include "program_homing.hpp"

namespace trunnion::channel::program_homing_test {
namespace {

using idl::stream::StreamRequestKind;
using language::AlarmNumber;
using testing::Channel;
using testing::CommandKind;

std::uint32_t number(AlarmNumber alarm) { return static_cast<std::uint32_t>(alarm); }

TEST(ProgramHoming, TakesLinearAxesFirstThenParallelThenRotaryOnes) {
  ProgramHoming homing;
  EXPECT_FALSE(homing.under_way());
  homing.begin(3, 0b111111111);
  EXPECT_EQ(homing.letters_left(), "X, Y, Z, U, V, W, A, B, C");
  EXPECT_EQ(homing.next(), std::size_t{language::X});
  homing.pass(language::X);
  homing.begin(3, 0b111111111);
  EXPECT_EQ(homing.next(), std::size_t{language::Y}) << "the same command goes on";
  EXPECT_EQ(homing.done_letters(), "X");
  homing.begin(4, 0b100000101);
  EXPECT_EQ(homing.letters_left(), "X, Z, W") << "another one begins";
  EXPECT_EQ(homing.done_letters(), "");
  homing.end();
  EXPECT_FALSE(homing.under_way());
  EXPECT_FALSE(homing.next());
}

/// X, Y and Z have home switches in positive direction; nothing has its reference.
struct Homed : Channel {
  void SetUp() override {
    for (const std::uint32_t axis : {100920u, 101920u, 102920u}) parameters->values[axis] = {1, ""};
    begin();
    core->set_unreferenced({0, 1, 2});
  }
  void start(const std::string& program) {
    load(program);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  }
  Answer mdi(const std::string& line) {
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
    return ask(CommandKind::MDI_LINE, line);
  }
  /// The drive takes the next HOME, and reports that it searches.
  std::optional<idl::stream::StreamRequest> search() {
    for (int i = 0; i < 10; ++i) {
      begin_text();
      auto request = core->take_stream_request();
      if (!request) {
        end_round();
        continue;
      }
      drive.request(*request);
      if (request->kind != StreamRequestKind::HOME) return request;
      drive.mode = DriveMode::HOMING;
      core->on_feedback(drive.run(0));
      core->advance();
      return request;
    }
    return std::nullopt;
  }
  /// As begin_round() without the request.
  void begin_text() {
    core->advance();
    if (const auto chunk = core->wanted())
      core->deliver(chunk->name, chunk->offset,
                    {text.begin() + static_cast<long>(chunk->offset), text.end()});
    core->advance();
  }
  void end_search(bool found, std::size_t axis = 0, double position = 0) {
    drive.end_search(found, axis, position);
    core->on_feedback(drive.run(0));
    core->advance();
  }
  /// The axis of the next search, which finds it at `position`.
  std::optional<std::uint16_t> found_at(double position) {
    const auto request = search();
    if (!request || request->kind != StreamRequestKind::HOME) return std::nullopt;
    end_search(true, request->axis, position);
    return request->axis;
  }
  const idl::channel::ChannelState& state() { return core->state(); }
};

// 600 mm/min are 10 mm/s.
TEST_F(Homed, AProgramHomesItsAxesOneAfterTheOtherAndGoesOnWhereTheyAre) {
  start("G21 G90 G54\nG28.2 Z0 X0 Y0 F600\nG91 G0 X1\nM30\n");
  const auto first = search();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->kind, StreamRequestKind::HOME);
  EXPECT_EQ(first->axis, 0u);
  EXPECT_DOUBLE_EQ(first->speed, 10);
  EXPECT_EQ(state().state, RunState::RUNNING);
  EXPECT_EQ(state().detail, "axis X searches its reference");
  end_search(true, 0, 12.5);
  const auto second = search();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->axis, 1u);
  EXPECT_EQ(state().detail, "axis Y searches its reference; homed: X");
  end_search(true, 1, -3);
  EXPECT_EQ(found_at(7), 2u);
  EXPECT_TRUE(state().homed) << "before the alarms of the drive end";
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  ASSERT_FALSE(drive.rows.empty());
  EXPECT_NEAR(drive.rows.front()[0], 12.5, 0.01) << "the path begins where the axes have been found";
  EXPECT_NEAR(drive.rows.back()[0], 13.5, 1e-9);
  EXPECT_NEAR(drive.rows.back()[1], -3, 1e-9);
  EXPECT_NEAR(drive.rows.back()[2], 7, 1e-9);
}

TEST_F(Homed, AnMdiLineDoesItTooAndInInches) {
  ASSERT_TRUE(mdi("G20 G159 Y F60").accepted);
  const auto request = search();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->axis, 1u);
  EXPECT_DOUBLE_EQ(request->speed, 25.4) << "60 in/min";
  end_search(true, 1, 4);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(drive.rows.empty()) << "nothing else has moved";
  EXPECT_EQ(state().machine[1], 4);
}

TEST_F(Homed, WithoutReferencesEveryMotionIsRefused) {
  const auto answer = mdi("G53 G0 X5");
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.alarm, number(AlarmNumber::axes_without_reference));
  EXPECT_EQ(answer.reason, "MDI:1: axes without a reference: X, Y, Z. Home them with G28.2, or in mode REF");
  start("M8\nG0 X1\nM30\n");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(drive.rows.empty());
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text,
            "part.nc:2: axes without a reference: X, Y, Z. Home them with G28.2, or in mode REF");
}

TEST_F(Homed, AMoveBehindTheHomingOfSomeAxesIsRefusedAsLongAsOthersHaveNoReference) {
  start("G28.2 X0\nG0 X1\nM30\n");
  EXPECT_EQ(found_at(5), 0u);
  run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text,
            "part.nc:2: axes without a reference: Y, Z. Home them with G28.2, or in mode REF");
}

TEST_F(Homed, AFailedSearchEndsTheProgramWithItsPlace) {
  start("G21\nG28.2 X0 Y0\nG0 X1\nM30\n");
  ASSERT_TRUE(search());
  end_search(false);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::homing_failed);
  EXPECT_EQ(events[0].text, "part.nc:2: axis X was not homed. See the alarm of the axis, then reset");
  EXPECT_FALSE(core->take_stream_request()) << "Y is not searched";
}

TEST_F(Homed, AFeedHoldEndsTheSearchAndCycleStartGoesOnWithTheAxesThatAreLeft) {
  start("G28.2 X0 Y0\nM30\n");
  EXPECT_EQ(found_at(5), 0u);
  ASSERT_TRUE(search());
  ask(CommandKind::FEED_HOLD);
  const auto leave = core->take_stream_request();
  ASSERT_TRUE(leave);
  EXPECT_EQ(leave->kind, StreamRequestKind::LEAVE);
  EXPECT_EQ(state().state, RunState::HOLDING);
  drive.request(*leave);
  end_search(false);
  EXPECT_EQ(state().state, RunState::HELD);
  EXPECT_EQ(state().detail, "cycle start: homing of Y");
  EXPECT_TRUE(events.empty());
  EXPECT_FALSE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG).accepted);
  EXPECT_FALSE(ask(CommandKind::RETRACE, "", 1).accepted);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  EXPECT_EQ(found_at(6), 1u);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
}

TEST_F(Homed, AResetEndsTheSearchAndTheProgram) {
  start("G28.2 X0 Y0\nM30\n");
  ASSERT_TRUE(search());
  ask(CommandKind::RESET);
  const auto leave = core->take_stream_request();
  ASSERT_TRUE(leave);
  EXPECT_EQ(leave->kind, StreamRequestKind::LEAVE);
  drive.request(*leave);
  end_search(false);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(core->take_events().empty());
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  EXPECT_EQ(found_at(5), 0u) << "from the beginning";
}

TEST_F(Homed, AFeedOverrideOfZeroEndsTheSearchUntilItIsAboveZero) {
  start("G28.2 X0\nM30\n");
  ASSERT_TRUE(search());
  ask(CommandKind::FEED_OVERRIDE, "", 0);
  core->advance();
  const auto leave = core->take_stream_request();
  ASSERT_TRUE(leave);
  EXPECT_EQ(leave->kind, StreamRequestKind::LEAVE);
  drive.request(*leave);
  end_search(false);
  EXPECT_EQ(state().detail, "axis X searches its reference: the feed override is 0 %");
  ask(CommandKind::FEED_OVERRIDE, "", 1);
  EXPECT_EQ(found_at(5), 0u);
  run();
  EXPECT_TRUE(events.empty());
}

TEST_F(Homed, ThePlcThatInhibitsManualMotionDoesNotEndIt) {
  start("G28.2 X0\nM30\n");
  ASSERT_TRUE(search());
  idl::plc::ChannelControl control;
  control.manual_inhibit = true;
  core->set_control(control);
  core->advance();
  EXPECT_FALSE(core->take_stream_request());
}

TEST_F(Homed, ALockedAxisIsNotHomed) {
  load("G28.2 X0\nM30\n");
  ASSERT_TRUE(ask(CommandKind::AXIS_LOCK, "", 1).accepted);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "part.nc:1: axes cannot be homed while one is locked: switch the axis lock off");
}

TEST_F(Homed, ADryRunAndSingleBlockHomeAsWell) {
  load("G28.2 X0\nG28.2 Y0\nM30\n");
  ASSERT_TRUE(ask(CommandKind::DRY_RUN, "", 1).accepted);
  ASSERT_TRUE(ask(CommandKind::SINGLE_BLOCK, "", 1).accepted);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  EXPECT_EQ(found_at(5), 0u);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted) << "Y has no reference yet, and is homed";
  EXPECT_EQ(found_at(6), 1u);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD) << "before M30";
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  EXPECT_TRUE(drive.rows.empty());
}

// X has none; its encoder is to know its position and does not.
struct WithoutSwitch : Homed {
  void SetUp() override {
    parameters->values[101920] = {1, ""};
    begin();
    core->set_unreferenced({0, 1});
  }
};

TEST_F(WithoutSwitch, AnAxisWithoutReferenceAndSwitchIsLeftToAPersonInModeRef) {
  start("G28.2 Y0\nG28.2 X0 Y0\nG0 X1\nM30\n");
  EXPECT_EQ(found_at(5), 1u);
  EXPECT_FALSE(search()) << "the drive would take the place of X for its reference position";
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(drive.rows.empty());
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::homing_failed);
  EXPECT_EQ(
      events[0].text,
      "part.nc:2: axis X was not homed: it has no home switch. A reference return in mode REF makes the "
      "place where it is its reference position");
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::REF);
  EXPECT_TRUE(ask(CommandKind::REFERENCE_AXIS, "", 0, 0, Mode::REF, 0).accepted);
}

// Y has the slave Y2, axis 3.
struct Gantry : Homed {
  void SetUp() override {
    drive = testing::FakeDrive{4};
    parameters->values[10050] = {1, ""}, parameters->values[10051] = {3, ""};
    parameters->values[103000] = {0, "Y2"};
    parameters->values[103006] = {400, ""}, parameters->values[103007] = {-400, ""};
    parameters->values[103100] = {1, ""}, parameters->values[103101] = {1, ""};
    drive.enabled = {1, 1, 1, 1};
  }
  /// The drive finds the reference of Y, and the program ends at its first move.
  std::string without_reference_behind_y() {
    begin();
    core->set_unreferenced({0, 1, 3});
    start("G28.2 Y0\nG0 X1\nM30\n");
    EXPECT_EQ(found_at(5), 1u);
    run();
    return events.empty() ? "" : events.back().text;
  }
};

TEST_F(Gantry, ASlaveIsHomedWithItsMaster) {
  for (const std::uint32_t axis : {101920u, 103920u}) parameters->values[axis] = {1, ""};
  EXPECT_EQ(without_reference_behind_y(),
            "part.nc:2: axes without a reference: X. Home them with G28.2, or in mode REF");
}

TEST_F(Gantry, ASlaveThatIsTakenOffIsNot) {
  for (const std::uint32_t axis : {101920u, 103920u}) parameters->values[axis] = {1, ""};
  drive.enabled = {1, 1, 1, 3};
  EXPECT_EQ(without_reference_behind_y(),
            "part.nc:2: axes without a reference: X, Y2. Home them with G28.2, or in mode REF");
}

TEST_F(Gantry, TheSwitchMayBeThatOfASlaveThatMovesWithTheAxis) {
  parameters->values[103920] = {1, ""};
  EXPECT_EQ(without_reference_behind_y(),
            "part.nc:2: axes without a reference: X. Home them with G28.2, or in mode REF");
  events.clear();
  drive.enabled = {1, 1, 1, 3};
  begin();
  core->set_unreferenced({1});
  start("G28.2 Y0\nM30\n");
  EXPECT_FALSE(search());
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::homing_failed);
}

// Axis 3 turns modulo 360.
struct Rotary : Homed {
  void SetUp() override {
    drive = testing::FakeDrive{4};
    parameters->values[103000] = {0, "A"}, parameters->values[103001] = {3, ""};
    parameters->values[103949] = {1, ""}, parameters->values[103920] = {1, ""};
  }
  void begin_with(std::uint32_t letter) {
    parameters->values[letter] = {3, ""};
    begin();
    core->set_unreferenced({3});
  }
};

// 600 deg/min are 10 deg/s, in G20 too.
TEST_F(Rotary, AnAxisThatTurnsIsHomedAtItsOwnUnitAndTheProgramGoesOnFromThere) {
  begin_with(40004);
  start("G20 G28.2 A0 F600\nG91 G0 A20\nM30\n");
  const auto request = search();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->kind, StreamRequestKind::HOME);
  EXPECT_EQ(request->axis, 3u);
  EXPECT_DOUBLE_EQ(request->speed, 10);
  EXPECT_EQ(state().detail, "axis A searches its reference");
  end_search(true, 3, 355);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  ASSERT_FALSE(drive.rows.empty());
  EXPECT_NEAR(drive.rows.back()[3], 375, 1e-9);
}

// As the manual prints it: at 2000 deg/min.
TEST_F(Rotary, ALineOfANumChannelHomesTheAxisThatItNames) {
  parameters->values[40959] = {1, ""};
  begin_with(40006);
  ASSERT_TRUE(mdi("F2000 G159 C").accepted);
  const auto request = search();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->axis, 3u);
  EXPECT_DOUBLE_EQ(request->speed, 2000.0 / 60);
  end_search(true, 3, 90);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(state().homed);
}

/// X, Y and Z have switches, and programs are those of a NUM control.
struct NumHomed : Homed {
  void SetUp() override {
    parameters->values[40959] = {1, ""};
    Homed::SetUp();
  }
};

// %9990.2 as the manual prints it, without its wait mark: it has neither ENDI nor M2.
TEST_F(NumHomed, ThePrintedProgramHomesTheAxesInItsOrderAndItsSpeeds) {
  start(
      "%9990.2 (Homing on group 2)\nIF [.RG80] = 159 THEN (call by G159)\n   G77 H9990.9\nELSE (call in "
      "homing "
      "mode: load axis no. in L0)\n    (programme the feed rate Fxxx if required)\n   L0=2 F2000 G77 H9990.9 "
      "(Z axis)\n   L0=0 F3000 G77 H9990.9(X axis)\n   L0=1 G77 H9990.9(Y axis)\n");
  struct Expected {
    std::uint16_t axis;
    double feed;
  };
  for (const auto& expected : {Expected{2, 2000}, Expected{0, 3000}, Expected{1, 3000}}) {
    const auto request = search();
    ASSERT_TRUE(request);
    ASSERT_EQ(request->kind, StreamRequestKind::HOME);
    EXPECT_EQ(request->axis, expected.axis);
    EXPECT_DOUBLE_EQ(request->speed, expected.feed / 60);
    end_search(true, request->axis, 1);
  }
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  EXPECT_TRUE(drive.rows.empty());
  EXPECT_TRUE(state().homed);
}

// Each line of manual data input has its own L0 to L19.
TEST_F(NumHomed, AnL0OfTheLineBeforeHomesNothing) {
  ASSERT_TRUE(mdi("L0=2").accepted);
  run();
  const auto answer = mdi("F2000 G77 H9990.9");
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.alarm, number(AlarmNumber::num_homing_axis));
  EXPECT_FALSE(search());
}

TEST_F(NumHomed, AMessageHasItsTextAndThePlaceInTheProgramThatShowsIt) {
  subprograms["O9990.nc"] = {"(two lines)\n$9990 \xc3\xa9\nM2\n", 4};
  store();
  ASSERT_TRUE(mdi("G77 H9990 $ before").accepted);
  run();
  ASSERT_EQ(events.size(), 2u);
  for (const auto& event : events) EXPECT_EQ(event.alarm, &alarm::program_message);
  EXPECT_EQ(events[0].text, "MDI:1: before");
  EXPECT_EQ(events[1].text, "MDI:O9990:2: 9990 \xc3\xa9");
}

TEST_F(NumHomed, AFunctionThatThePlcRefusesHasThePlaceInTheCalledProgramToo) {
  subprograms["O9990.nc"] = {"(two lines)\nM8\nM2\n", 4};
  store();
  answer_plc = false;
  ASSERT_TRUE(mdi("G77 H9990").accepted);
  for (int i = 0; i < 10 && auxiliaries.empty(); ++i) round();
  ASSERT_FALSE(auxiliaries.empty());
  core->on_auxiliary_done({0, auxiliaries.back().number, true});
  const auto refused = core->take_events();
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].text, "MDI:O9990:2: the PLC did not carry out M8. Check the machine, then reset");
}

// A machine whose encoders know their positions.
struct Absolute : Channel {};

TEST_F(Absolute, AnAxisThatKnowsItsPositionAndHasNoSwitchIsNotMoved) {
  load("G90 G0 X3\nG28.2 X0 Y0\nG91 G0 X1\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(events.empty());
  EXPECT_NEAR(drive.rows.back()[0], 4, 1e-9);
}

TEST(Homing, WhatTheDriveHasFoundCountsUntilItsAlarmSaysTheSame) {
  Homing homing;
  homing.set_unreferenced({1, 2});
  homing.note_found(1);
  homing.note_found(5);
  EXPECT_TRUE(homing.referenced(1));
  EXPECT_FALSE(homing.all_referenced());
  homing.set_unreferenced({1, 2});
  EXPECT_TRUE(homing.referenced(1)) << "the alarm is still on its way";
  homing.set_unreferenced({2});
  homing.set_unreferenced({1, 2});
  EXPECT_FALSE(homing.referenced(1)) << "it was lost again";
  homing.set_unreferenced({});
  EXPECT_TRUE(homing.all_referenced());
}

}  // namespace
}  // namespace trunnion::channel::program_homing_test
