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
