// SPDX-License-Identifier: Apache-2.0
#include "homing_cycle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "simulated_hardware.hpp"

namespace trunnion::drive::homing_test {

using idl::stream::ReferenceSearch;
using idl::stream::StreamRequestKind;
namespace {

// An axis that follows `delay` periods later, with a switch that is on beyond its edge and stays on for
// another 0.1 mm on the way back.
struct Axis {
  Axis(double edge, std::size_t delay) : switch_edge(edge), queue(delay, 0.0) {}
  void follow(double commanded) {
    queue.push_back(commanded);
    const double before = status.position;
    status.position = queue.front();
    queue.pop_front();
    fastest = std::max(fastest, std::abs(status.position - before) / 0.001);
    const bool on = status.position > (status.home_switch ? switch_edge - 0.1 : switch_edge);
    if (on && !status.home_switch) status.home_latch = status.position;
    status.home_switch = on;
  }
  double switch_edge;
  std::deque<double> queue;
  AxisStatus status;
  double fastest = 0;
  double setpoint = 0, velocity = 0;  // the newest
};

HomingCycle::Settings settings() {
  HomingCycle::Settings s;
  s.direction = 1, s.search = 20, s.creep = 1, s.acceleration = 1000, s.travel = 100, s.reference = 50;
  return s;
}

HomingCycle::State run(HomingCycle& homing, Axis& axis, int most = 100000) {
  while (homing.state() == HomingCycle::State::moving && most-- > 0) {
    const double setpoint = homing.step(axis.status, 0.001);
    const double velocity = (setpoint - axis.setpoint) / 0.001;
    EXPECT_LE(std::abs(velocity - axis.velocity), 1 + 1e-9) << "1000 mm/s2 for 1 ms";
    axis.setpoint = setpoint;
    axis.velocity = velocity;
    axis.follow(setpoint);
  }
  return homing.state();
}

TEST(HomingCycle, TakesTheEdgeAtTheSlowSpeedAlsoBehindAQueueOfRows) {
  for (const std::size_t delay : {0u, 20u}) {
    Axis axis(12.3, delay);
    HomingCycle homing;
    homing.start(settings(), 0);
    ASSERT_EQ(run(homing, axis), HomingCycle::State::done);
    // The edge is latched within one period at 1 mm/s: 0.001 mm.
    EXPECT_NEAR(homing.shift(), 50 - 12.3, 0.001 + 1e-9);
    EXPECT_NEAR(axis.fastest, 20, 1e-6);
  }
}

TEST(HomingCycle, LeavesTheSwitchFirstWhenItIsOnAtTheStart) {
  Axis axis(12.3, 5);
  axis.status.home_switch = true;
  axis.status.position = axis.setpoint = 30;
  std::fill(axis.queue.begin(), axis.queue.end(), 30.0);
  HomingCycle homing;
  homing.start(settings(), 30);
  ASSERT_EQ(run(homing, axis), HomingCycle::State::done);
  EXPECT_NEAR(homing.shift(), 50 - 12.3, 0.001 + 1e-9);
}

TEST(HomingCycle, GivesUpWhenTheSwitchDoesNotComeWithinTheTravel) {
  Axis axis(1000, 5);
  HomingCycle homing;
  homing.start(settings(), 0);
  EXPECT_EQ(run(homing, axis), HomingCycle::State::failed);
  EXPECT_EQ(homing.failure(), HomingCycle::Failure::travel);
  EXPECT_LT(axis.status.position, 101) << "100 mm and the way it takes to brake from 20 mm/s";
}

// The switch comes within 0.7 s and does not go off again: what is left of 2 s is creeping, at 1 mm/s.
TEST(HomingCycle, GivesUpAfterTheLongestTime) {
  Axis axis(12.3, 5);
  HomingCycle homing;
  auto limited = settings();
  limited.seconds = 2;
  homing.start(limited, 0);
  run(homing, axis, 700);
  ASSERT_TRUE(axis.status.home_switch);
  axis.switch_edge = -1000;
  EXPECT_EQ(run(homing, axis, 1310), HomingCycle::State::failed) << "in 2 s and what it takes to brake";
  EXPECT_EQ(homing.failure(), HomingCycle::Failure::time);
  EXPECT_NEAR(axis.status.position, 12.3 - 1.3, 0.5);
}

TEST(HomingCycle, AnAbortBrakesAndEndsWithoutAReference) {
  Axis axis(12.3, 5);
  HomingCycle homing;
  homing.start(settings(), 0);
  run(homing, axis, 200);
  homing.abort();
  const double at = axis.status.position;
  EXPECT_EQ(run(homing, axis), HomingCycle::State::failed);
  EXPECT_EQ(homing.failure(), HomingCycle::Failure::ended);
  EXPECT_NEAR(axis.status.position, at + 5 * 0.02 + 0.2, 0.03) << "v2 / 2a = 0.2 mm behind five rows";
}

// The switch of the simulated axis is at its reference coordinate.
struct HomedAxis : ::testing::Test {
  DriveCore core{std::make_unique<SimulatedHardware>()};
  machine::Parameters parameters() const {
    machine::Parameters p;
    p.values[40001] = {0, ""};
    p.values[100000] = {0, "X"};
    p.values[100006] = {500, ""}, p.values[100007] = {-500, ""};
    p.values[100920] = {1, ""};
    p.values[100012] = {switch_edge, ""};
    return p;
  }
  void SetUp() override {
    core.configure(parameters(), true);
    Memory elsewhere = core.memory();
    elsewhere.position[0] = 0, elsewhere.homed[0] = 0;
    core.restore(elsewhere);
    core.set_enables({1}, false);
  }
  explicit HomedAxis(double edge = 5) : switch_edge(edge) {}
  void request(StreamRequestKind kind, std::uint32_t epoch, std::uint16_t channel = 0) {
    core.request({channel, ++number, kind, epoch, 0});
  }
  void run() {
    while (core.can_step(false)) core.step();
  }
  double position() {
    idl::stream::Feedback feedback;
    core.fill(feedback);
    return feedback.position[0];
  }
  ReferenceSearch search() {
    idl::stream::Feedback feedback;
    core.fill(feedback);
    return feedback.channels.at(0).search;
  }
  const double switch_edge;
  std::uint32_t number = 0;
};

TEST_F(HomedAxis, FindsItsReferenceOnDemandAndIsReadyForTheStreamAfterwards) {
  request(StreamRequestKind::HOME, 0);
  EXPECT_EQ(core.mode(), Mode::HOMING);
  request(StreamRequestKind::NEW_EPOCH, 1);
  EXPECT_FALSE(core.any_active()) << "no stream while an axis is homed";
  run();
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_TRUE(core.take_events().empty());
  idl::stream::Feedback feedback;
  core.fill(feedback);
  // It comes to rest beyond the edge at 5 by what it takes to brake from 1 mm/s.
  EXPECT_NEAR(feedback.position[0], 5, 0.01);
  EXPECT_GT(feedback.position[0], 5);
  request(StreamRequestKind::NEW_EPOCH, 2);
  EXPECT_TRUE(core.any_active());
}

// 10 mm/s in place of its own 50: after 0.2 s it has gone about 2 mm of the 5, and not 10.
TEST_F(HomedAxis, ADemandMayMakeTheSearchSlower) {
  core.request({0, ++number, StreamRequestKind::HOME, 0, 0, 10});
  for (int i = 0; i < 200; ++i) core.step();
  EXPECT_NEAR(core.commands()[0], 2, 0.1);
  EXPECT_EQ(search(), ReferenceSearch::SEARCHES);
  run();
  EXPECT_EQ(search(), ReferenceSearch::REFERENCE_FOUND);
  EXPECT_TRUE(core.take_events().empty());
}

TEST_F(HomedAxis, TheChannelIsToldHowItsSearchGoes) {
  EXPECT_EQ(search(), ReferenceSearch::NO_SEARCH);
  request(StreamRequestKind::HOME, 0);
  EXPECT_EQ(search(), ReferenceSearch::SEARCHES);
  run();
  EXPECT_EQ(search(), ReferenceSearch::REFERENCE_FOUND);
  // It stands on its switch now.
  request(StreamRequestKind::HOME, 0);
  core.step();
  EXPECT_EQ(search(), ReferenceSearch::MOVES_OFF_SWITCH);
  request(StreamRequestKind::LEAVE, 0);
  run();
  EXPECT_EQ(search(), ReferenceSearch::SEARCH_FAILED);
}

TEST_F(HomedAxis, AnEmergencyStopEndsTheSearchAndSwitchesTheAxisOff) {
  request(StreamRequestKind::HOME, 0);
  for (int i = 0; i < 20; ++i) core.step();
  core.set_enables({1}, true);
  run();
  EXPECT_EQ(core.mode(), Mode::OFF);
}

// A switch that never comes: it is at 5000, and the longest travel is 1.1 times the 1000 mm between the
// limits.
struct DeadSwitch : HomedAxis {
  DeadSwitch() : HomedAxis(5000) {}
  void search_for(int periods) {
    request(StreamRequestKind::HOME, 0);
    for (int i = 0; i < periods; ++i) core.step();
  }
};

TEST_F(DeadSwitch, ALeaveOfItsChannelBrakesTheAxisAndEndsTheSearch) {
  search_for(1000);
  const double at = core.commands()[0];
  EXPECT_GT(at, 40) << "50 mm/s for a second";
  request(StreamRequestKind::LEAVE, 0);
  EXPECT_EQ(core.mode(), Mode::HOMING) << "it brakes";
  run();
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  // v2 / 2a = 50 * 50 / 6000 = 0.417 mm.
  EXPECT_NEAR(core.commands()[0], at + 0.417, 0.03) << "and half a period at 50 mm/s";
  EXPECT_FALSE(core.unreferenced().empty());
  EXPECT_TRUE(core.take_events().empty()) << "whoever demanded it knows";
  request(StreamRequestKind::HOME, 0);
  EXPECT_EQ(core.mode(), Mode::HOMING) << "and it can be homed again";
}

TEST_F(DeadSwitch, ALeaveOfAnotherChannelDoesNot) {
  search_for(100);
  request(StreamRequestKind::LEAVE, 0, 1);
  for (int i = 0; i < 200; ++i) core.step();
  EXPECT_NEAR(core.commands()[0], 50 * 0.3 - 0.417, 0.06) << "50 mm/s for 0.3 s, less the acceleration";
}

TEST_F(DeadSwitch, AStopForAnAlarmIsNoMissingSwitch) {
  search_for(100);
  core.stop();
  run();
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_TRUE(core.take_events().empty());
}

TEST_F(DeadSwitch, TheLongestTravelIsAnAlarmThatSaysWhereAndWhatToDo) {
  search_for(1);
  run();
  EXPECT_NEAR(core.commands()[0], 1100 + 0.417, 0.06);
  const auto events = core.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::homing_failed);
  EXPECT_EQ(events[0].text,
            "Axis X has not found its home switch within 1100 mm: check the switch, its cable and parameter "
            "100920, then home again");
}

TEST_F(DeadSwitch, AContinuedDriveEndsTheSearchOfTheSameChannel) {
  search_for(100);
  DriveCore other{std::make_unique<SimulatedHardware>()};
  other.configure(parameters(), true);
  other.continue_from(core.explicit_state());
  other.request({1, ++number, StreamRequestKind::LEAVE, 0, 0});
  other.step();
  EXPECT_GT(other.commands()[0], core.commands()[0]);
  other.request({0, ++number, StreamRequestKind::LEAVE, 0, 0});
  while (other.can_step(false)) other.step();
  EXPECT_EQ(other.mode(), Mode::FOLLOWING);
  EXPECT_LT(other.commands()[0], 50 * 0.102 + 0.417);
}

// X (0) of channel 0, Z (1) of channel 1. X begins 5 mm before its switch, Z 3 mm.
struct SearchesOfTwoChannels : ::testing::Test {
  DriveCore core{std::make_unique<SimulatedHardware>()};
  static machine::Parameters parameters() {
    machine::Parameters p;
    p.values[40001] = {0, ""}, p.values[41001] = {1, ""};
    for (const std::uint32_t axis : {0u, 1u}) {
      p.values[100000 + axis * 1000] = {0, axis == 0 ? "X" : "Z"};
      p.values[100006 + axis * 1000] = {500, ""}, p.values[100007 + axis * 1000] = {-500, ""};
      p.values[100920 + axis * 1000] = {1, ""};
      p.values[100012 + axis * 1000] = {axis == 0 ? 5.0 : 3.0, ""};
    }
    return p;
  }
  explicit SearchesOfTwoChannels(bool homed_before = false) : homed(homed_before) {}
  void SetUp() override {
    core.configure(parameters(), true);
    Memory memory = core.memory();
    for (const std::size_t axis : {0u, 1u}) memory.position[axis] = 0, memory.homed[axis] = homed ? 1 : 0;
    core.restore(memory);
    core.set_enables({1, 1}, false);
  }
  void request(std::uint16_t channel, std::uint32_t number, StreamRequestKind kind, std::uint16_t axis = 0) {
    core.request({channel, number, kind, 1, axis});
  }
  void run() {
    while (core.can_step(false)) core.step();
  }
  static idl::stream::ChannelEcho echo_of(DriveCore& drive, std::size_t channel) {
    idl::stream::Feedback feedback;
    drive.fill(feedback);
    return feedback.channels.at(channel);
  }
  idl::stream::ChannelEcho echo(std::size_t channel) { return echo_of(core, channel); }
  void begin_both() {
    request(0, 1, StreamRequestKind::HOME, 0);
    request(1, 1, StreamRequestKind::HOME, 1);
    for (int i = 0; i < 20; ++i) core.step();
  }
  void expect_refused() {
    EXPECT_EQ(echo(1).request, 1u);
    EXPECT_EQ(echo(1).search, ReferenceSearch::SEARCH_FAILED);
    EXPECT_NEAR(core.commands()[1], 0, 0.001) << "it does not begin behind the stop";
  }
  const bool homed;
};

TEST_F(SearchesOfTwoChannels, TheSecondSearchBeginsWhenTheFirstOneHasEnded) {
  request(0, 1, StreamRequestKind::HOME, 0);
  request(1, 7, StreamRequestKind::HOME, 1);
  EXPECT_EQ(echo(1).request, 0u) << "it is answered when it begins";
  EXPECT_EQ(echo(1).search, ReferenceSearch::NO_SEARCH);
  while (echo(1).request == 0 && core.can_step(false)) {
    EXPECT_EQ(core.commands()[1], 0) << "one axis at a time";
    core.step();
  }
  EXPECT_EQ(core.mode(), Mode::HOMING);
  EXPECT_EQ(echo(0).search, ReferenceSearch::REFERENCE_FOUND);
  EXPECT_EQ(echo(1).request, 7u);
  EXPECT_EQ(echo(1).search, ReferenceSearch::SEARCHES);
  // The first channel demands its next axis meanwhile: here the same one again.
  request(0, 2, StreamRequestKind::HOME, 0);
  run();
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_EQ(echo(0).request, 2u);
  for (const std::size_t channel : {0u, 1u})
    EXPECT_EQ(echo(channel).search, ReferenceSearch::REFERENCE_FOUND);
  EXPECT_NEAR(core.commands()[1], 3, 0.01);
  EXPECT_TRUE(core.unreferenced().empty());
  EXPECT_TRUE(core.take_events().empty());
}

TEST_F(SearchesOfTwoChannels, ALeaveOfItsChannelEndsASearchThatWaits) {
  request(0, 1, StreamRequestKind::HOME, 0);
  request(1, 1, StreamRequestKind::HOME, 1);
  request(1, 2, StreamRequestKind::LEAVE);
  EXPECT_EQ(echo(1).request, 2u);
  EXPECT_EQ(echo(1).search, ReferenceSearch::SEARCH_FAILED);
  run();
  EXPECT_EQ(echo(0).search, ReferenceSearch::REFERENCE_FOUND) << "the other one goes on";
  EXPECT_EQ(core.commands()[1], 0);
}

TEST_F(SearchesOfTwoChannels, AStopForAnAlarmEndsThoseThatWaitToo) {
  begin_both();
  core.stop();
  run();
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  expect_refused();
}

TEST_F(SearchesOfTwoChannels, AnEmergencyStopEndsThoseThatWaitToo) {
  begin_both();
  core.set_enables({1, 1}, true);
  run();
  EXPECT_EQ(core.mode(), Mode::OFF);
  expect_refused();
}

TEST_F(SearchesOfTwoChannels, AContinuedDriveBeginsTheSearchThatWaitsWithTheSameBits) {
  request(0, 1, StreamRequestKind::HOME, 0);
  request(1, 1, StreamRequestKind::HOME, 1);
  for (int i = 0; i < 100; ++i) core.step();
  DriveCore other{std::make_unique<SimulatedHardware>()};
  other.configure(parameters(), true);
  other.continue_from(core.explicit_state());
  other.request({1, 1, StreamRequestKind::HOME, 1, 1});  // it is the newest on its topic
  EXPECT_EQ(echo_of(other, 1).request, 0u) << "it waits still";
  EXPECT_EQ(echo_of(other, 1).search, ReferenceSearch::NO_SEARCH);
  while (core.can_step(false)) {
    ASSERT_TRUE(other.can_step(false));
    core.step(), other.step();
    ASSERT_EQ(other.commands(), core.commands());
  }
  EXPECT_EQ(echo_of(other, 1).request, 1u);
  EXPECT_EQ(echo_of(other, 1).search, ReferenceSearch::REFERENCE_FOUND);
}

struct TwoReferencedChannels : SearchesOfTwoChannels {
  TwoReferencedChannels() : SearchesOfTwoChannels(true) {}
};

// The program of that channel would find no place in the stream behind its next pause.
TEST_F(TwoReferencedChannels, NoSearchBeginsWhileAnotherChannelMoves) {
  request(0, 1, StreamRequestKind::NEW_EPOCH);
  ASSERT_TRUE(core.any_active());
  request(1, 1, StreamRequestKind::HOME, 1);
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_EQ(echo(1).request, 1u);
  EXPECT_EQ(echo(1).search, ReferenceSearch::SEARCH_FAILED);
  const auto events = core.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::homing_failed);
  EXPECT_EQ(events[0].text,
            "Axis Z was not homed: another channel moves its axes. Wait until it has ended, then home again");
}

}  // namespace
}  // namespace trunnion::drive::homing_test
