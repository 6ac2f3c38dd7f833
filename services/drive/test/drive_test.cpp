// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "simulated_hardware.hpp"
#include "two_axes.hpp"

namespace trunnion::drive {
namespace {

using idl::stream::AxisBatch;
using idl::stream::StreamRequestKind;

DriveCore simulated() { return DriveCore(std::make_unique<SimulatedHardware>()); }

struct Fixture : testing::Test {
  DriveCore core = simulated();
  std::vector<double> commanded;  // X of every executed cycle
  std::uint64_t expected = 0;
  std::uint32_t epoch = 0, number = 0;

  void SetUp() override {
    core.configure(two_axes(), true);
    core.set_enables({1, 1}, false);
  }
  void begin(StreamRequestKind kind = StreamRequestKind::NEW_EPOCH) {
    if (kind == StreamRequestKind::NEW_EPOCH) ++epoch;
    core.request({0, ++number, kind, epoch});
  }
  // A ramp from 0 to `speed` mm per cycle within 100 cycles and on.
  static double path(std::uint64_t n) { return n < 100 ? 0.1 * n * n / 200.0 : 0.1 * (n - 50.0); }
  void feed(std::uint64_t from, std::uint64_t to, bool end = false) {
    for (std::uint64_t first = from; first < to; first += 8) {
      AxisBatch f;
      f.epoch = epoch, f.first = first, f.count = 8, f.starts = first == 0, f.revision = 1;
      f.axes = {0, 1};
      f.ends = end && first + 8 >= to;
      for (std::uint64_t n = first; n < first + 8; ++n)
        f.setpoints.insert(f.setpoints.end(), {path(n), 2 * path(n)});
      f.states = {{idl::stream::Stage::KINEMATICS, first + 7, {}}};
      ASSERT_TRUE(core.put(f));
    }
  }
  void run(bool give_up = false, int most = 100000) {
    idl::stream::Feedback f;
    while (core.can_step(give_up) && most-- > 0) {
      core.step();
      core.fill(f);
      if (f.count == 0) continue;
      EXPECT_EQ(f.first, expected) << "no cycle lost or reordered";
      expected = f.first + f.count;
      for (std::uint32_t i = 0; i < f.count; ++i) commanded.push_back(f.commanded[2 * i]);
    }
  }
};

TEST_F(Fixture, ExecutesEverySetpointBitForBitAndEndsIdle) {
  begin();
  feed(0, 400, true);
  run();
  ASSERT_EQ(commanded.size(), 400u);
  for (std::size_t n = 0; n < 400; ++n) EXPECT_EQ(commanded[n], path(n));
  EXPECT_FALSE(core.any_active());
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_EQ(core.starved(), 0u);
}

TEST_F(Fixture, KeepsEnoughSetpointsInHandToStopOnThePath) {
  begin();
  feed(0, 400);
  run();
  // The faster axis runs at 0.2 mm/cycle = 50 periods to stop = 25 cycles of path, limited to half the
  // lead, 16.
  EXPECT_EQ(400 - core.next(), 16u);
}

TEST_F(Fixture, AMissingSetpointStopsOnThePathAndTheRestIsExecutedUnchangedAfterwards) {
  begin();
  feed(0, 160);
  run();
  core.set_spindle_speed({});
  feed(160, 200);
  run(true);  // waited long enough
  EXPECT_EQ(core.mode(), Mode::HELD);
  ASSERT_FALSE(core.take_events().empty());
  EXPECT_LE(core.next(), 200u);
  const double x = core.commands()[0], y = core.commands()[1];
  EXPECT_NEAR(y, 2 * x, 1e-9) << "along the path, which is a straight line here, also beyond its known end";
  run();
  EXPECT_EQ(core.mode(), Mode::HELD) << "it does not go on by itself";
  EXPECT_FALSE(core.take_resumed());
  feed(200, 400, true);
  begin(StreamRequestKind::RESUME);
  run();
  EXPECT_TRUE(core.take_resumed());
  ASSERT_EQ(commanded.size(), 400u);
  for (std::size_t n = 0; n < 400; ++n) EXPECT_EQ(commanded[n], path(n));
}

TEST_F(Fixture, AResumeWaitsForNoMoreThanTheChannelsCreditLetsItWrite) {
  begin();
  feed(0, 160);
  run();
  run(true);
  ASSERT_EQ(core.mode(), Mode::HELD);
  ASSERT_LE(core.next() + 16, 160u + 16u);
  begin(StreamRequestKind::RESUME);
  // Lead 32 and whole batches of 16: with 17 cycles at hand another batch would be beyond the credit.
  const auto put = [&](std::uint64_t first, std::uint64_t count) {
    AxisBatch f;
    f.epoch = epoch, f.first = first, f.count = static_cast<std::uint32_t>(count), f.revision = 1;
    f.axes = {0, 1};
    for (std::uint64_t n = first; n < first + count; ++n)
      f.setpoints.insert(f.setpoints.end(), {path(n), 2 * path(n)});
    ASSERT_TRUE(core.put(f));
  };
  const std::uint64_t missing = core.next() + 16 - 160;
  if (missing > 0) put(160, missing);
  EXPECT_FALSE(core.can_step(false)) << "16 cycles are at hand";
  put(160 + missing, 1);
  EXPECT_TRUE(core.can_step(false));
}

TEST_F(Fixture, BrakingAndResumingNeedAtMostTheLimitOnTopOfThePathsOwnAcceleration) {
  begin();
  feed(0, 200);
  std::vector<double> y;
  const auto tick = [&](bool give_up) {
    if (!core.can_step(give_up)) return false;
    core.step();
    y.push_back(core.commands()[1]);
    return true;
  };
  while (tick(false)) {
  }
  while (tick(true)) {
  }
  EXPECT_EQ(core.mode(), Mode::HELD);
  feed(200, 600);
  begin(StreamRequestKind::RESUME);
  while (tick(false)) {
  }
  double most = 0;
  for (std::size_t i = 2; i < y.size(); ++i)
    most = std::max(most, std::abs(y[i] - 2 * y[i - 1] + y[i - 2]) / 1e-6);
  // The ramp of Y is 0.2 mm per cycle within 100 cycles: 2 m/s2. Braking adds the limit, 4 m/s2.
  EXPECT_LE(most, 2000 + 4000 * 1.0001);
  EXPECT_EQ(y.back(), 2 * path(core.next() - 1)) << "back at whole cycles";
}

// A circle whose path acceleration is the limit itself: the worst that leaving and joining can meet.
TEST_F(Fixture, StoppingAndResumingOnACircleAtTheLimitNeedsAtMostTwiceTheLimit) {
  // 0.19 mm/cycle on R 10: normal 0.19^2/10 = 0.00361 mm/cycle^2, tangential 0.19/100 = 0.0019 in the first
  // 100 cycles; together 0.00408, two percent above the limit of 0.004.
  const auto angle = [](double n) { return 0.019 * (n < 100 ? n * n / 200 : n - 50); };
  const auto circle = [&](std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t first = from; first < to; first += 8) {
      AxisBatch f;
      f.epoch = epoch, f.first = first, f.count = 8, f.starts = first == 0, f.revision = 1, f.axes = {0, 1};
      for (std::uint64_t n = first; n < first + 8; ++n) {
        const double a = angle(static_cast<double>(n));
        f.setpoints.insert(f.setpoints.end(), {10 - 10 * std::cos(a), 10 * std::sin(a)});
      }
      f.states = {{idl::stream::Stage::KINEMATICS, first + 7, {}}};
      ASSERT_TRUE(core.put(f));
    }
  };
  // Stops after any number of cycles, so at any phase and any direction of the path.
  for (std::uint64_t more = 0; more < 64; more += 8) {
    core = simulated();
    auto parameters = two_axes();
    parameters.values[900] = {64, ""};  // half of the lead covers the 0.19 / 0.004 / 2 = 24 cycles to stop
    core.configure(parameters, true);
    core.set_enables({1, 1}, false);
    epoch = 0;
    begin();
    circle(0, 200 + more);
    std::vector<std::array<double, 2>> at;
    const auto tick = [&](bool give_up) {
      if (!core.can_step(give_up)) return false;
      core.step();
      at.push_back({core.commands()[0], core.commands()[1]});
      return true;
    };
    while (tick(false)) {
    }
    while (tick(true)) {
    }
    ASSERT_EQ(core.mode(), Mode::HELD);
    circle(200 + more, 600);
    begin(StreamRequestKind::RESUME);
    while (tick(false)) {
    }
    double most = 0, off = 0;
    for (std::size_t i = 2; i < at.size(); ++i)
      for (std::size_t a = 0; a < 2; ++a)
        most = std::max(most, std::abs(at[i][a] - 2 * at[i - 1][a] + at[i - 2][a]) / 1e-6);
    for (const auto& p : at) off = std::max(off, std::abs(std::hypot(p[0] - 10, p[1]) - 10));
    EXPECT_LE(most, 2 * 4080.0) << more;
    // The chord of 0.19 mm on R 10 is 0.19^2 / 80 = 0.00045 mm off the circle in its middle.
    EXPECT_LE(off, 0.00046) << "on the path, more " << more;
    const double a = angle(static_cast<double>(core.next() - 1));
    EXPECT_EQ(at.back()[1], 10 * std::sin(a)) << "back at whole cycles";
  }
}

TEST_F(Fixture, EmergencyStopStopsOnThePathAndNothingMovesUntilANewEpoch) {
  begin();
  feed(0, 400);
  run(false, 200);
  core.set_enables({1, 1}, true);
  run();
  EXPECT_EQ(core.mode(), Mode::OFF);
  const double x = core.commands()[0];
  EXPECT_NEAR(core.commands()[1], 2 * x, 1e-4);
  core.set_enables({1, 1}, false);
  run();
  EXPECT_EQ(core.mode(), Mode::HELD);
  const auto cycle = core.next();
  begin();
  EXPECT_EQ(core.mode(), Mode::FOLLOWING);
  EXPECT_EQ(core.next(), cycle);
  run();
  EXPECT_NEAR(core.commands()[0], x, 1e-3) << "batches of the old epoch are dead";
}

TEST_F(Fixture, AProcessThatTakesOverAtRestKnowsTheEpochAndWhatWasAnswered) {
  begin();
  feed(0, 400, true);
  run();
  DriveCore next = simulated();
  next.configure(two_axes(), true);
  next.restore(core.memory());
  next.set_enables({1, 1}, false);
  next.request({0, number, StreamRequestKind::NEW_EPOCH,
                epoch});  // the newest request is still in the topic: it was answered
  EXPECT_FALSE(next.any_active());
  next.request({0, number + 1, StreamRequestKind::START, epoch});
  EXPECT_TRUE(next.any_active()) << "a start within the epoch that the process before has seen begin";
  idl::stream::Feedback f;
  next.fill(f);
  EXPECT_EQ(f.channels.at(0).start, 400u);
}

TEST_F(Fixture, ASetpointThatJumpsIsRefused) {
  begin();
  feed(0, 96);
  run();
  AxisBatch f;
  f.epoch = epoch, f.first = 96, f.count = 8, f.axes = {0, 1}, f.ends = true;
  for (int i = 0; i < 8; ++i) f.setpoints.insert(f.setpoints.end(), {500.0, 500.0});
  core.put(f);
  run();
  EXPECT_EQ(core.mode(), Mode::HELD);
  EXPECT_LT(core.commands()[0], 10);
  const auto events = core.take_events();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].alarm, &alarm::setpoint_jump);
}

TEST_F(Fixture, AStartAwayFromThePathIsApproachedWithinTheLimits) {
  begin();
  AxisBatch f;
  f.epoch = epoch, f.first = 0, f.count = 8, f.axes = {0, 1}, f.starts = true, f.ends = true;
  for (int i = 0; i < 8; ++i) f.setpoints.insert(f.setpoints.end(), {0.5, 0.0});
  core.put(f);
  double last = 0, most = 0;
  while (core.can_step(false)) {
    core.step();
    most = std::max(most, std::abs(core.commands()[0] - last));
    last = core.commands()[0];
  }
  EXPECT_EQ(last, 0.5);
  EXPECT_LT(most, 0.1) << "a quintic of 0.5 mm takes 27 periods: at most 1.875 * 0.5 / 27 = 0.035 a period";
}

TEST(TwoChannels, ASecondChannelThatStartsDoesNotDisturbTheFirst) {
  auto p = two_axes();
  p.values.erase(40002);
  p.values[41001] = {1, ""};  // axis 1 belongs to channel 1
  DriveCore core = simulated();
  core.configure(p, true);
  core.set_enables({1, 1}, false);
  const auto batch = [](std::uint16_t channel, std::uint64_t first, bool end) {
    AxisBatch f;
    f.channel = channel, f.epoch = 1, f.first = first, f.count = 8, f.axes = {channel}, f.ends = end;
    // 0.05 mm per cycle: 0.4 m/s2 per period to reach, so it is in motion from the start of the test on.
    for (std::uint64_t n = first; n < first + 8; ++n)
      f.setpoints.push_back(channel == 0 ? 0.05 * static_cast<double>(n) : 0.0);
    return f;
  };
  std::vector<double> x;
  const auto run = [&] {
    idl::stream::Feedback out;
    while (core.can_step(false)) {
      core.step();
      core.fill(out);
      for (std::uint32_t i = 0; i < out.count; ++i) x.push_back(out.commanded[2 * i]);
      EXPECT_NE(core.mode(), Mode::RETURNING);
    }
  };
  core.request({0, 1, StreamRequestKind::NEW_EPOCH, 1});
  for (std::uint64_t first = 0; first < 80; first += 8) {
    auto f = batch(0, first, false);
    core.put(f);
  }
  run();
  core.request({1, 1, StreamRequestKind::NEW_EPOCH, 1});
  idl::stream::Feedback echo;
  core.fill(echo);
  const auto start = echo.channels[1].start;
  EXPECT_EQ(start, core.next() + 32) << "the lead ahead, so that the first needs not wait";
  for (std::uint64_t first = 80; first < 160; first += 8) {
    auto f = batch(0, first, first == 152);
    core.put(f);
  }
  for (std::uint64_t first = start; first < start + 16; first += 8) {
    auto f = batch(1, first, first == start + 8);
    core.put(f);
  }
  run();
  ASSERT_EQ(x.size(), 160u);
  for (std::size_t n = 0; n < x.size(); ++n) EXPECT_EQ(x[n], 0.05 * static_cast<double>(n));
  EXPECT_FALSE(core.any_active());
}

TEST_F(Fixture, AChannelThatTheMachineHasNotMovesNothing) {
  core.request({9, 1, StreamRequestKind::NEW_EPOCH, 1});
  AxisBatch foreign;
  foreign.channel = 9, foreign.epoch = 1, foreign.count = 1, foreign.axes = {0}, foreign.setpoints = {1};
  EXPECT_TRUE(core.put(foreign));
  EXPECT_FALSE(core.any_active());
  begin();
  feed(0, 400, true);
  run();
  EXPECT_EQ(core.next(), 400u);
}

TEST_F(Fixture, ARequestCannotUseUpTheEpochs) {
  core.request({0, ++number, StreamRequestKind::NEW_EPOCH, 0xffffffff});
  EXPECT_FALSE(core.any_active());
  begin();
  EXPECT_TRUE(core.any_active());
}

// 1e12 mm at 60 m/min are 1.9e12 periods, more than a number of 32 bits has.
TEST_F(Fixture, AReturnFromVeryFarEndsWithAStop) {
  begin();
  AxisBatch far;
  far.epoch = epoch, far.count = 8, far.starts = far.ends = true, far.revision = 1, far.axes = {0, 1};
  far.setpoints.assign(16, 1e12);
  core.put(far);
  run(false, 1000);
  EXPECT_EQ(core.mode(), Mode::RETURNING);
  core.set_enables({}, true);
  run(false, 10);
  EXPECT_EQ(core.mode(), Mode::OFF);
}

TEST(TwoChannels, BehindAStopNoAxisMovesBeforeItsOwnChannelResumesOrLeaves) {
  for (const bool leaves : {false, true}) {
    auto p = two_axes();
    p.values.erase(40002);
    p.values[41001] = {1, ""};  // axis 1 belongs to channel 1
    DriveCore core = simulated();
    core.configure(p, true);
    core.set_enables({1, 1}, false);
    std::uint64_t start = 0;  // of the second channel, the lead behind the first
    const auto feed = [&](std::uint64_t from, std::uint64_t to) {
      for (std::uint64_t first = from; first < to; first += 8)
        for (const std::uint16_t channel : {0, 1}) {
          if (channel == 1 && first < start) continue;
          AxisBatch f;
          f.channel = channel, f.epoch = 1, f.first = first, f.count = 8, f.axes = {channel};
          for (std::uint64_t n = first; n < first + 8; ++n)
            f.setpoints.push_back(0.01 * static_cast<double>(channel == 0 ? n : n - start));
          core.put(f);
        }
    };
    idl::stream::Feedback out;
    const auto run = [&](bool give_up) {
      for (int i = 0; i < 10000 && core.can_step(give_up); ++i) core.step(), core.fill(out);
      core.fill(out);
    };
    for (const std::uint16_t channel : {0, 1}) core.request({channel, 1, StreamRequestKind::NEW_EPOCH, 1});
    core.fill(out);
    start = out.channels[1].start;
    feed(0, start + 160);
    run(false);
    run(true);
    ASSERT_EQ(core.mode(), Mode::HELD);
    feed(start + 160, start + 320);
    const auto stood = core.commands();
    core.request({0, 2, StreamRequestKind::RESUME, 1});
    run(false);
    EXPECT_EQ(out.mode, Mode::HELD);
    EXPECT_EQ(core.commands(), stood);
    core.request({1, 2, leaves ? StreamRequestKind::LEAVE : StreamRequestKind::RESUME, 1});
    run(false);
    EXPECT_GT(core.commands()[0], stood[0]);
    if (leaves) {
      EXPECT_EQ(core.commands()[1], stood[1]) << "it stays where it is, between two cycles";
    } else {
      EXPECT_GT(core.commands()[1], stood[1]);
    }
  }
}

TEST_F(Fixture, PositionsAndCyclesSurviveTheProcess) {
  begin();
  feed(0, 400, true);
  run();
  const auto memory = core.memory();
  DriveCore other = simulated();
  other.configure(two_axes(), true);
  other.restore(memory);
  EXPECT_EQ(other.next(), 400u);
  EXPECT_NEAR(other.commands()[0], path(399), 1e-3);
}

}  // namespace
}  // namespace trunnion::drive
