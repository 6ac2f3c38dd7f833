// SPDX-License-Identifier: Apache-2.0
// The executor on hardware that is not a simulation: with a queue, with drives that take time or fail.
#include <gtest/gtest.h>

#include <cmath>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "queued_hardware.hpp"

namespace trunnion::drive {

using idl::stream::StreamRequestKind;
namespace {

using idl::stream::AxisBatch;
using testing::QueuedHardware;

// One axis: 1 mm per cycle is the fastest, 4 m/s2 the acceleration.
machine::Parameters one_axis() {
  machine::Parameters p;
  p.revision = 1;
  p.values[40001] = {0, ""};
  p.values[100000] = {0, "X"};
  p.values[100034] = {60000, ""};
  p.values[100036] = {4000, ""};
  return p;
}

constexpr std::size_t queue = 5;

struct Hardware : ::testing::Test {
  QueuedHardware* hardware = new QueuedHardware(queue);
  DriveCore core{std::unique_ptr<DriveHardware>(hardware)};
  idl::stream::Feedback feedback;
  std::vector<double> commanded, actual;

  void SetUp() override {
    core.configure(one_axis(), false);
    core.set_enables({1}, false);
  }
  static double path(std::uint64_t n) { return n < 100 ? 0.1 * n * n / 200.0 : 0.1 * (n - 50.0); }
  void start() { core.request({0, 1, StreamRequestKind::NEW_EPOCH, 1, 0}); }
  void feed(std::uint64_t from, std::uint64_t to, bool end = false) {
    for (std::uint64_t first = from; first < to; first += 8) {
      AxisBatch f;
      f.epoch = 1, f.first = first, f.count = 8, f.starts = first == 0, f.revision = 1, f.axes = {0};
      f.ends = end && first + 8 >= to;
      for (std::uint64_t n = first; n < first + 8; ++n) f.setpoints.push_back(path(n));
      f.states = {{idl::stream::Stage::KINEMATICS, first + 7, {}}};
      ASSERT_TRUE(core.put(f));
    }
  }
  void periods(int count) {
    for (int i = 0; i < count; ++i) {
      core.step();
      core.fill(feedback);
      EXPECT_EQ(feedback.first, commanded.size());
      commanded.insert(commanded.end(), feedback.commanded.begin(), feedback.commanded.end());
      actual.insert(actual.end(), feedback.actual.begin(), feedback.actual.end());
    }
  }
};

TEST_F(Hardware, ACycleIsExecutedWhenItsRowHasBeenInForceAndTheEncoderRowIsOfThatMoment) {
  start();
  feed(0, 160, true);
  periods(queue);
  EXPECT_EQ(commanded.size(), 0u);
  periods(1);
  EXPECT_EQ(commanded.size(), 1u);
  EXPECT_TRUE(feedback.channels.at(0).active);
  periods(154);
  ASSERT_EQ(commanded.size(), 155u);
  EXPECT_EQ(core.next(), 160u);
  EXPECT_FALSE(core.any_active());
  EXPECT_TRUE(feedback.channels.at(0).active) << "its last cycles are not executed yet";
  periods(5);
  ASSERT_EQ(commanded.size(), 160u);
  EXPECT_FALSE(feedback.channels.at(0).active);
  for (std::size_t n = 1; n < 160; ++n) {
    EXPECT_EQ(commanded[n], path(n));
    // The row of the cycle before has been executed when this one comes into force.
    EXPECT_EQ(actual[n], path(n - 1));
  }
}

TEST_F(Hardware, ASkipEdgeHasTheCycleThatCameIntoForceAfterItAndComesWithIt) {
  start();
  feed(0, 160, true);
  periods(40);
  ASSERT_EQ(commanded.size(), 40u - queue);
  hardware->edges.push_back({2, 0, {1.5}});
  periods(1);
  ASSERT_EQ(feedback.skips.size(), 1u);
  EXPECT_EQ(feedback.skips[0].cycle, 40u - queue);
  EXPECT_EQ(feedback.first, 40u - queue);
  EXPECT_EQ(feedback.skips[0].position, std::vector<double>{1.5});
}

TEST_F(Hardware, VelocityAndAccelerationAreThoseOfTheSetpoints) {
  start();
  feed(0, 160);
  periods(60);
  const auto n = core.next() - 1;
  const double velocity = (path(n) - path(n - 1)) / 0.001;
  EXPECT_NEAR(hardware->newest.axes[0].velocity, velocity, 1e-9);
  // 0.1 mm in 200 cycles squared: 0.001 mm per cycle2, 1000 mm/s2.
  EXPECT_NEAR(hardware->newest.axes[0].acceleration, 1000, 1e-6);
}

TEST_F(Hardware, WithoutARowTheAxesHaveStoppedAndGoOnFromThere) {
  start();
  feed(0, 400);
  periods(150);
  const auto stopped_at = hardware->newest.axes[0].position;
  hardware->starved = 12;
  periods(3);
  EXPECT_EQ(core.mode(), Mode::HELD);
  EXPECT_EQ(core.starved(), 12u);
  EXPECT_EQ(hardware->newest.axes[0].position, stopped_at) << "no row beyond the one the hardware stopped at";
  EXPECT_EQ(hardware->newest.axes[0].velocity, 0);
  const auto events = core.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::setpoint_missing);
  core.request({0, 2, StreamRequestKind::RESUME, 1, 0});
  double last = stopped_at, most = 0, before = 0;
  for (int i = 0; i < 200; ++i) {
    periods(1);
    const double now = hardware->newest.axes[0].position;
    most = std::max(most, std::abs(now - last - before));
    before = now - last, last = now;
  }
  EXPECT_GT(core.next(), 300u);
  EXPECT_LE(most, 2 * 0.004) << "mm per cycle2: the acceleration of the path and as much for the start";
}

TEST_F(Hardware, StarvedAtRestIsCountedAndNoReasonToStop) {
  hardware->starved = 3;
  periods(1);
  EXPECT_EQ(core.starved(), 3u);
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_TRUE(core.take_events().empty());
}

TEST_F(Hardware, DrivesThatTakeTimeAreFollowedByTheModeWhenTheyAreOn) {
  core.set_enables({1}, true);
  periods(1);
  ASSERT_EQ(core.mode(), Mode::OFF);
  EXPECT_FALSE(hardware->newest.enable);
  hardware->on = false;
  hardware->position[0] = 7;  // moved by hand
  periods(1);
  core.set_enables({1}, false);
  periods(3);
  EXPECT_EQ(core.mode(), Mode::OFF);
  EXPECT_TRUE(hardware->newest.enable);
  EXPECT_FALSE(hardware->newest.controlled);
  hardware->on = true;
  periods(1);
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_TRUE(hardware->newest.controlled);
  EXPECT_EQ(hardware->newest.axes[0].position, 7) << "control begins where the axis is";
  EXPECT_EQ(hardware->newest.axes[0].velocity, 0);
}

TEST_F(Hardware, AFaultOfADriveSwitchesAllOffUntilTheAlarmsAreReset) {
  start();
  feed(0, 400);
  periods(150);
  hardware->on = false;
  hardware->fault[0] = true;
  periods(1);  // the status of the axis is read at the end of this period
  EXPECT_EQ(core.mode(), Mode::OFF);
  EXPECT_FALSE(hardware->newest.enable);
  auto events = core.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::drive_fault);
  hardware->on = true;
  hardware->fault[0] = false;
  periods(5);
  EXPECT_EQ(core.mode(), Mode::OFF) << "nothing is switched on again before the operator has seen it";
  core.acknowledge();
  EXPECT_EQ(hardware->resets, 1);
  periods(1);
  EXPECT_EQ(core.mode(), Mode::HELD);
}

TEST_F(Hardware, ASpindleGetsItsSpeedAlsoWhileNothingMoves) {
  auto p = one_axis();
  p.values[101000] = {0, "S"};
  p.values[101001] = {10, ""};
  auto* other = new QueuedHardware(queue);
  DriveCore with_spindle{std::unique_ptr<DriveHardware>(other)};
  with_spindle.configure(p, false);
  with_spindle.set_enables({1, 1}, false);
  with_spindle.set_spindle_speed({-1200});
  with_spindle.step();
  ASSERT_EQ(other->newest.spindles.size(), 1u);
  EXPECT_EQ(other->newest.spindles[0].speed, -1200);
  EXPECT_FALSE(other->newest.spindles[0].coupled);
}

}  // namespace
}  // namespace trunnion::drive
