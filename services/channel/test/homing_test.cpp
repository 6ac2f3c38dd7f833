// SPDX-License-Identifier: Apache-2.0
#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {
using testing::Channel;
using testing::CommandKind;

using idl::stream::DriveMode;
using idl::stream::StreamRequestKind;

struct HomedAxis : Channel {
  void SetUp() override {
    parameters->values[101920] = {1, ""};  // Y has a home switch in positive direction
    begin();
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::REF);
  }
  Answer reference(std::uint8_t axis) { return ask(CommandKind::REFERENCE_AXIS, "", 0, 0, Mode::REF, axis); }
};

TEST_F(HomedAxis, AReferenceReturnOfAnAxisWithAHomeSwitchIsADemandOfTheDrive) {
  ASSERT_TRUE(reference(1).accepted);
  const auto request = core->take_stream_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->kind, StreamRequestKind::HOME);
  EXPECT_EQ(request->axis, 1u) << "the logical number of the axis";
  drive.request(*request);
  drive.mode = DriveMode::HOMING;
  core->on_feedback(drive.run(0));
  const auto answer = reference(0);
  EXPECT_FALSE(answer.accepted);
  EXPECT_NE(answer.reason.find("searches its reference"), std::string::npos) << answer.reason;
  drive.mode = DriveMode::FOLLOWING;
  core->on_feedback(drive.run(0));
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", 600, 1, Mode::JOG, 0).accepted);
  core->advance();
  const auto start = core->take_stream_request();
  ASSERT_TRUE(start);
  EXPECT_EQ(start->kind, StreamRequestKind::NEW_EPOCH)
      << "the stream begins where the drive has found the axes";
}

TEST_F(HomedAxis, WithoutItsReferenceNothingStartsButItsSearch) {
  core->set_unreferenced({1, 2});
  const auto refused = [&](const Answer& answer) {
    EXPECT_FALSE(answer.accepted);
    EXPECT_EQ(answer.alarm, alarm::not_homed.number);
    EXPECT_EQ(answer.reason, "Axes without a reference: Y, Z. Mode REF, then reference return of each");
  };
  refused(reference(0));  // an absolute encoder: the axis would move to its reference coordinate
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  refused(ask(CommandKind::JOG_AXIS, "", 600, 1, Mode::JOG, 0));
  load("G0 X1\nM30\n");
  refused(ask(CommandKind::START_FROM_LINE, "", 1));
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::REF);
  EXPECT_TRUE(reference(1).accepted);
}

// Its switch may be searched behind that one; a program may home its axes, and moves wait.
TEST_F(HomedAxis, WhileAnotherChannelSearchesAReferenceThisOneMayDemandItsOwn) {
  drive.mode = DriveMode::HOMING;
  core->on_feedback(drive.run(0));
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  const auto answer = ask(CommandKind::JOG_AXIS, "", 600, 1, Mode::JOG, 0);
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.alarm, alarm::not_ready.number);
  EXPECT_EQ(answer.reason, "Another channel searches the reference of an axis: wait until it has found it");
  load("G0 X1\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  begin_round();
  begin_round();
  EXPECT_EQ(drive.starts, 0) << "the drive would give no place in the stream";
  EXPECT_EQ(core->state().state, RunState::RUNNING);
  EXPECT_EQ(core->state().detail, "waits: another channel searches a reference");
  drive.mode = DriveMode::FOLLOWING;
  core->on_feedback(drive.run(0));
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(drive.rows.back()[0], 1, 1e-9);
  drive.mode = DriveMode::HOMING;
  core->on_feedback(drive.run(0));
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::REF);
  ASSERT_TRUE(reference(1).accepted);
  const auto request = core->take_stream_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->kind, StreamRequestKind::HOME);
  EXPECT_EQ(core->state().detail, "axis Y waits: another channel searches a reference");
}

/// Y searches its switch in the drive.
struct Searching : HomedAxis {
  void SetUp() override {
    HomedAxis::SetUp();
    ASSERT_TRUE(reference(1).accepted);
    search();
  }
  /// The drive takes the demand and reports that it searches.
  void search() {
    ASSERT_EQ(asked(), StreamRequestKind::HOME);
    report(DriveMode::HOMING);
  }
  /// What the channel asks the drive for now, which takes it.
  std::optional<StreamRequestKind> asked() {
    core->advance();
    const auto request = core->take_stream_request();
    if (!request) return std::nullopt;
    drive.request(*request);
    return request->kind;
  }
  void report(DriveMode mode) {
    drive.mode = mode;
    core->on_feedback(drive.run(0));
    core->advance();
  }
  const idl::channel::ChannelState& state() { return core->state(); }
  void ends_the_search() {
    EXPECT_EQ(asked(), StreamRequestKind::LEAVE);
    report(DriveMode::HOMING);
    EXPECT_EQ(state().state, RunState::HOLDING) << "it brakes";
    report(DriveMode::FOLLOWING);
    EXPECT_EQ(state().state, RunState::IDLE);
    EXPECT_FALSE(asked()) << "and is not homed again by itself";
  }
};

TEST_F(Searching, IsShownUntilTheDriveHasFoundIt) {
  EXPECT_EQ(state().state, RunState::RUNNING);
  EXPECT_EQ(state().detail, "axis Y searches its reference");
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::REF);
  EXPECT_FALSE(asked()) << "the mode is the same";
  report(DriveMode::FOLLOWING);
  EXPECT_EQ(state().state, RunState::IDLE);
  EXPECT_EQ(state().detail, "");
}

TEST_F(Searching, AFeedHoldEndsIt) {
  ask(CommandKind::FEED_HOLD);
  ends_the_search();
}

TEST_F(Searching, AResetEndsIt) {
  ask(CommandKind::RESET);
  ends_the_search();
}

TEST_F(Searching, AChangeOfTheModeEndsIt) {
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG).accepted);
  ends_the_search();
}

TEST_F(Searching, AnAlarmThatStopsAndAFeedHoldOfThePlcEndIt) {
  core->set_hold("Feed hold of the PLC");
  ends_the_search();
}

TEST_F(Searching, ThePlcEndsItWithManualMotion) {
  idl::plc::ChannelControl control;
  control.manual_inhibit = true;
  core->set_control(control);
  ends_the_search();
}

TEST_F(Searching, RestsWhileTheFeedOverrideIsZeroAndThenSearchesOn) {
  ask(CommandKind::FEED_OVERRIDE, "", 0);
  EXPECT_EQ(asked(), StreamRequestKind::LEAVE);
  report(DriveMode::HOMING);
  ask(CommandKind::FEED_OVERRIDE, "", 1);
  EXPECT_FALSE(asked()) << "before it has come to rest";
  ask(CommandKind::FEED_OVERRIDE, "", 0);
  report(DriveMode::FOLLOWING);
  EXPECT_FALSE(asked());
  EXPECT_EQ(state().state, RunState::RUNNING);
  EXPECT_EQ(state().detail, "axis Y searches its reference: the feed override is 0 %");
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::REF);
  EXPECT_FALSE(reference(0).accepted) << "one at a time";
  ask(CommandKind::FEED_OVERRIDE, "", 0.5);
  search();
  EXPECT_EQ(state().detail, "axis Y searches its reference");
  report(DriveMode::FOLLOWING);
  EXPECT_EQ(state().state, RunState::IDLE);
}

TEST_F(Searching, IsEndedWhileTheFeedOverrideIsZeroToo) {
  ask(CommandKind::FEED_OVERRIDE, "", 0);
  EXPECT_EQ(asked(), StreamRequestKind::LEAVE);
  report(DriveMode::FOLLOWING);
  ask(CommandKind::FEED_HOLD);
  ask(CommandKind::FEED_OVERRIDE, "", 1);
  EXPECT_FALSE(asked());
  EXPECT_EQ(state().state, RunState::IDLE);
}

TEST_F(Searching, IsOverWhenTheDrivesAreSwitchedOff) {
  ask(CommandKind::FEED_OVERRIDE, "", 0);
  EXPECT_EQ(asked(), StreamRequestKind::LEAVE);
  report(DriveMode::OFF);
  report(DriveMode::FOLLOWING);
  ask(CommandKind::FEED_OVERRIDE, "", 1);
  EXPECT_FALSE(asked());
}

TEST_F(Searching, AProcessThatDidNotDemandItEndsIt) {
  begin();
  const auto request = core->take_stream_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->kind, StreamRequestKind::LEAVE);
}

TEST_F(Searching, IsInNoSnapshotAndHandsNothingOver) {
  std::string why_not;
  EXPECT_TRUE(core->explicit_state(why_not).is_null());
  EXPECT_FALSE(core->hand_over());
}

TEST_F(HomedAxis, AReferenceReturnAtAFeedOverrideOfZeroWaitsForIt) {
  ask(CommandKind::FEED_OVERRIDE, "", 0);
  ASSERT_TRUE(reference(1).accepted);
  core->advance();
  EXPECT_FALSE(core->take_stream_request());
  ask(CommandKind::FEED_OVERRIDE, "", 1);
  core->advance();
  EXPECT_TRUE(core->take_stream_request());
}

TEST_F(HomedAxis, AnAxisWithoutASwitchIsMovedToItsReferencePosition) {
  EXPECT_TRUE(reference(0).accepted);
  core->advance();
  EXPECT_FALSE(core->take_stream_request()) << "it is there already";
}

TEST(Homing, IsNeededOfAnAxisWithoutAReferenceOrWithAHomeSwitch) {
  auto parameters = *testing::three_axes();
  parameters.values[101920] = {1, ""};
  Homing homing;
  EXPECT_TRUE(homing.needed(1, &parameters));
  EXPECT_FALSE(homing.needed(0, &parameters));
  EXPECT_FALSE(homing.needed(1, nullptr));
  homing.set_unreferenced({2});
  EXPECT_TRUE(homing.needed(2, nullptr));
  EXPECT_FALSE(homing.referenced(2));
  EXPECT_TRUE(homing.referenced(0));
}

/// Without a channel core around it.
struct HomingAlone : ::testing::Test {
  HomingAlone() { report(DriveMode::FOLLOWING); }
  void report(DriveMode mode) {
    drive.mode = mode;
    link.on_feedback(drive.run(0));
  }
  void demand() {
    homing.begin(1);
    homing.advance(link, true);
    const auto request = link.take_request();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->kind, StreamRequestKind::HOME);
    EXPECT_EQ(request->axis, 1u);
    drive.request(*request);
    report(DriveMode::HOMING);
  }
  testing::FakeDrive drive{3};
  StreamLink link{0};
  Homing homing;
};

TEST_F(HomingAlone, IsOverWhenTheDriveNoLongerSearches) {
  demand();
  homing.advance(link, true);
  EXPECT_TRUE(homing.active());
  EXPECT_FALSE(link.take_request()) << "once";
  report(DriveMode::FOLLOWING);
  homing.advance(link, true);
  EXPECT_FALSE(homing.active());
}

// The drive answers a demand when it begins, and searches for another channel before and behind it.
TEST_F(HomingAlone, WaitsForTheSearchOfAnotherChannelAndDoesNotWaitBehindIt) {
  const machine::ChannelAxes axes{{language::Y}, {1}, "Y"};
  report(DriveMode::HOMING);
  homing.begin(1);
  homing.advance(link, true);
  const auto request = link.take_request();
  ASSERT_TRUE(request);
  report(DriveMode::HOMING);
  homing.advance(link, true);
  EXPECT_TRUE(homing.active());
  EXPECT_EQ(homing.detail(axes, link, true), "axis Y waits: another channel searches a reference");
  drive.request(*request);
  report(DriveMode::HOMING);
  homing.advance(link, true);
  EXPECT_EQ(homing.detail(axes, link, true), "axis Y searches its reference");
  drive.end_search(true, 1, 5);
  report(DriveMode::HOMING);
  homing.advance(link, true);
  EXPECT_FALSE(homing.active());
  EXPECT_EQ(homing.take_outcome(), Homing::Outcome::found);
}

TEST_F(HomingAlone, ThatWaitsIsEndedByAFeedHold) {
  report(DriveMode::HOMING);
  homing.begin(1);
  homing.advance(link, true);
  ASSERT_TRUE(link.take_request());
  homing.end(link, true);
  const auto request = link.take_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->kind, StreamRequestKind::LEAVE);
  drive.request(*request);
  report(DriveMode::HOMING);
  homing.advance(link, true);
  EXPECT_FALSE(homing.active()) << "the drive still searches for the other one";
  EXPECT_EQ(homing.take_outcome(), Homing::Outcome::ended);
}

TEST_F(HomingAlone, IsActiveUntilTheDriveHasBrakedWhenItWasEnded) {
  demand();
  homing.end(link, true);
  const auto request = link.take_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->kind, StreamRequestKind::LEAVE);
  EXPECT_TRUE(homing.active());
  EXPECT_TRUE(homing.ended());
  drive.request(*request);
  report(DriveMode::FOLLOWING);
  homing.advance(link, true);
  EXPECT_FALSE(homing.active());
  EXPECT_FALSE(link.take_request()) << "it is not searched again by itself";
}

}  // namespace
}  // namespace trunnion::channel
