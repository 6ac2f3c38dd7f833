// SPDX-License-Identifier: Apache-2.0
#include "channel_streams.hpp"

#include <gtest/gtest.h>

namespace trunnion::drive {
namespace {

using idl::stream::StreamRequestKind;

constexpr std::uint64_t lead = 32;

// Two channels in their first epoch: X and Z are axes of channel 0, Y of channel 1.
struct Streams : ::testing::Test {
  void SetUp() override {
    for (const std::uint16_t number : {0, 1}) {
      streams.add(number);
      auto& channel = *streams.find(number);
      channel.active = true, channel.epoch = 1;
      channel.window.set_next(1, 0);
    }
  }
  // Four cycles; the setpoint of X, Y, Z in cycle n is n, 100 + n, 200 + n.
  void put(std::uint16_t channel, std::uint64_t first, bool ends = false) {
    idl::stream::AxisBatch batch;
    batch.channel = channel, batch.epoch = 1, batch.first = first, batch.count = 4, batch.ends = ends;
    batch.starts = first == 0;
    if (channel == 0)
      batch.axes = {2, 0};
    else
      batch.axes = {1};
    for (std::uint64_t n = first; n < first + 4; ++n)
      for (const auto axis : batch.axes) batch.setpoints.push_back(100.0 * axis + static_cast<double>(n));
    batch.snapshot.cycle = first + 3;
    EXPECT_TRUE(streams.put(batch));
  }
  // The same of channel 0, whose spindle is at 0.1 rev for each cycle.
  void put_spindle(std::uint64_t first, bool follows, bool ends = false) {
    idl::stream::AxisBatch batch;
    batch.epoch = 1, batch.first = first, batch.count = 4, batch.ends = ends, batch.starts = first == 0;
    batch.axes = {2, 0}, batch.spindle_axis = 5, batch.follows_spindle = follows;
    for (std::uint64_t n = first; n < first + 4; ++n) {
      for (const auto axis : batch.axes) batch.setpoints.push_back(100.0 * axis + static_cast<double>(n));
      batch.spindle.push_back(0.1 * static_cast<double>(n));
    }
    EXPECT_TRUE(streams.put(batch));
  }
  std::vector<double> setpoints(std::uint64_t cycle) {
    std::vector<double> out = {-1, -1, -1};
    streams.setpoints(cycle, axes, GantrySlaves(), out);
    return out;
  }

  ChannelStreams streams;
  Spindles spindles;
  const std::vector<machine::AxisInfo> axes = {{0, "X"}, {1, "Y"}, {2, "Z"}};
};

TEST_F(Streams, SetpointsReachAsFarAsEveryChannelThatOwesThem) {
  EXPECT_EQ(streams.supply(0, lead).cycles, 0u);
  put(0, 0), put(0, 4);
  EXPECT_EQ(streams.supply(0, lead).cycles, 0u) << "channel 1 owes them";
  put(1, 0, true);
  auto supply = streams.supply(0, lead);
  EXPECT_EQ(supply.cycles, 8u) << "channel 1 owes none behind its end";
  EXPECT_FALSE(supply.ends);
  put(0, 8, true);
  supply = streams.supply(2, lead);
  EXPECT_EQ(supply.cycles, 10u);
  EXPECT_TRUE(supply.ends);
}

TEST_F(Streams, AxesThatNoChannelMovesThenStay) {
  put(0, 0), put(0, 4), put(1, 0);
  EXPECT_EQ(setpoints(3), (std::vector<double>{3, 103, 203}));
  EXPECT_EQ(setpoints(5), (std::vector<double>{5, -1, 205}));
  streams.find(0)->active = false;
  EXPECT_EQ(setpoints(3), (std::vector<double>{-1, 103, -1}));
}

TEST_F(Streams, AChannelEndsWithItsLastCycleAndIsReportedUntilThatIsExecuted) {
  put(0, 0, true), put(1, 0);
  for (std::uint64_t next = 0; next < 4; ++next) {
    EXPECT_TRUE(streams.find(0)->active);
    streams.pass(next, spindles);
  }
  EXPECT_FALSE(streams.find(0)->active);
  EXPECT_TRUE(streams.find(1)->active);
  idl::stream::Feedback feedback;
  streams.fill(4, feedback);
  ASSERT_EQ(feedback.channels.size(), 2u);
  EXPECT_TRUE(feedback.channels[0].active);
  EXPECT_EQ(feedback.channels[0].snapshot.cycle, 3u);
  streams.executed();
  streams.fill(4, feedback);
  EXPECT_FALSE(feedback.channels[0].active);
}

TEST_F(Streams, ContinueWhenEveryChannelThatIsStoppedShall) {
  EXPECT_FALSE(streams.resume_demanded());
  streams.find(0)->resume = true;
  EXPECT_FALSE(streams.resume_demanded());
  streams.find(1)->active = false;
  EXPECT_TRUE(streams.resume_demanded());
  streams.forget_resumes();
  EXPECT_FALSE(streams.resume_demanded());
}

TEST_F(Streams, BeginWithEnoughSetpointsAtTheirStart) {
  streams.find(0)->start = 0, streams.find(1)->start = lead;
  EXPECT_FALSE(streams.let_begin(0, false));
  EXPECT_TRUE(streams.let_begin(0, true));
  EXPECT_TRUE(streams.find(0)->prefilled);
  EXPECT_FALSE(streams.find(1)->prefilled);
  EXPECT_TRUE(streams.let_begin(1, false)) << "once it has begun";
  EXPECT_TRUE(streams.any_starts(lead));
  EXPECT_FALSE(streams.any_starts(1));
}

TEST_F(Streams, AStartIsOfTheEpochThatWasBegunAndANewEpochIsLater) {
  auto& channel = *streams.find(0);
  EXPECT_FALSE(channel.expects({0, 1, StreamRequestKind::START, 1, 0})) << "not begun in this process";
  channel.begun = true;
  EXPECT_TRUE(channel.expects({0, 1, StreamRequestKind::START, 1, 0}));
  EXPECT_FALSE(channel.expects({0, 1, StreamRequestKind::START, 2, 0}));
  EXPECT_TRUE(channel.expects({0, 1, StreamRequestKind::NEW_EPOCH, 2, 0}));
  EXPECT_FALSE(channel.expects({0, 1, StreamRequestKind::NEW_EPOCH, 1, 0}));
  EXPECT_FALSE(channel.expects({0, 1, StreamRequestKind::NEW_EPOCH, 1u << 30, 0})) << "too far ahead";
}

TEST_F(Streams, ATapCouplesTheSpindleAndAThreadLeavesItItsSpeed) {
  machine::Parameters p;
  p.values[105000] = {0, "S"}, p.values[105001] = {machine::axis_type_spindle, ""};
  spindles.configure(p, 0.001);
  const std::vector<SpindleStatus> status(1);
  put_spindle(0, false), put_spindle(4, true);
  for (std::uint64_t next = 0; next < 4; ++next) {
    streams.couple_spindles(next, status, spindles);
    EXPECT_TRUE(spindles.coupling(0).setpoint().coupled);
    streams.pass(next, spindles);
  }
  streams.couple_spindles(4, status, spindles);
  EXPECT_FALSE(spindles.coupling(0).setpoint().coupled);
  EXPECT_EQ(streams.find(0)->spindle_row(4), nullptr);
  ASSERT_NE(streams.find(0)->thread_angle(5), nullptr);
  EXPECT_EQ(*streams.find(0)->thread_angle(5), 0.5);
  EXPECT_EQ(streams.find(0)->thread_angle(8), nullptr) << "it is not at hand";
}

// With a lead of 32 a thread needs 8 cycles at hand besides, with 8 it needs 2.
TEST_F(Streams, AThreadKeepsSetpointsInHandForItsShift) {
  streams.find(1)->active = false;
  for (std::uint64_t first = 0; first < 20; first += 4) put_spindle(first, true);
  EXPECT_EQ(streams.ahead(lead), 8u);
  EXPECT_EQ(streams.supply(0, lead).cycles, 12u);
  EXPECT_EQ(streams.supply(0, 8).cycles, 18u);
  EXPECT_EQ(streams.supply(16, lead).cycles, 0u);
  put_spindle(20, true, true);
  EXPECT_EQ(streams.supply(0, lead).cycles, 24u) << "the stream ends";
}

TEST_F(Streams, AnAxisOfAThreadIsBetweenTheSetpointsWhereTheAngleOfTheSpindleIs) {
  streams.find(1)->active = false;
  machine::Parameters p;
  p.values[105000] = {0, "S"}, p.values[105001] = {machine::axis_type_spindle, ""};
  spindles.configure(p, 0.001);
  for (std::uint64_t first = 0; first < 20; first += 4) put_spindle(first, true);
  // X and Z go 1 mm in a cycle: a thousandth of their speed, and a tenth of what they can change it by.
  std::vector<AxisLimits> limits(3);
  for (auto& limit : limits) limit.velocity = 1e6, limit.acceleration = 1e7;
  std::vector<SpindleStatus> status(1);
  // 0.1 rev in a cycle of 1 ms are 6000 1/min. Before cycle 4 the angle should be 0.3 rev; it is 0.325 rev.
  for (std::uint64_t next = 0; next < 5; ++next) {
    status[0] = {6000, 0.1 * static_cast<double>(next) - 0.075};
    streams.follow_spindles({next, lead, 0.001, 1, true}, status, spindles, axes, limits);
    if (next < 4) streams.pass(next, spindles);
  }
  EXPECT_NEAR(setpoints(4)[0], 4.25, 1e-9);
  EXPECT_NEAR(setpoints(5)[0], 5.25, 1e-9);
  EXPECT_NEAR(setpoints(4)[2], 204.25, 1e-9);
  EXPECT_EQ(setpoints(4)[1], -1) << "no axis of the channel";
  EXPECT_NEAR(setpoints(19)[0], 19, 1e-9) << "the last setpoint that is at hand";
}

TEST_F(Streams, KeepTheirEpochsForTheNextProcess) {
  streams.find(1)->epoch = 7, streams.find(1)->request = 3, streams.find(1)->begun = true;
  Memory memory;
  streams.keep(memory);
  EXPECT_EQ(memory.epoch, 7u);
  ChannelStreams next;
  next.add(0), next.add(1);
  next.restore(memory);
  EXPECT_EQ(next.find(1)->epoch, 7u);
  EXPECT_EQ(next.find(1)->request, 3u);
  EXPECT_TRUE(next.find(1)->begun);
  EXPECT_EQ(next.find(0)->epoch, 7u) << "not begun: behind every epoch there was";
  EXPECT_EQ(next.find(2), nullptr);
}

}  // namespace
}  // namespace trunnion::drive
