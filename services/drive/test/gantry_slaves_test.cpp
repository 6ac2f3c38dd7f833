// SPDX-License-Identifier: Apache-2.0
#include "gantry_slaves.hpp"

#include <gtest/gtest.h>

#include "channel_streams.hpp"
#include "gantry_bench.hpp"

namespace trunnion::drive {
namespace {

// X (0), Y1 (1) and its slave Y2 (2).
struct SlavesOfGantry : ::testing::Test {
  void SetUp() override {
    slaves.configure(GantryMachine().parameters, 3);
    ASSERT_EQ(slaves.all().size(), 1u);
    streams.add(0);
  }
  GantrySlave& slave() { return slaves.all()[0]; }

  GantrySlaves slaves;
  ChannelStreams streams;
  const std::vector<double> command = {0, 10, 10.25};
};

TEST_F(SlavesOfGantry, ASlaveThatIsTakenOffStaysWhereItIs) {
  slave().offset_known = slave().refused = true;
  slaves.demand_off({1, 1, 3});
  EXPECT_EQ(slaves.setpoint(2, 50), 50) << "a demand acts at rest only";
  slaves.couple(command);
  EXPECT_EQ(slaves.setpoint(2, 50), 10.25);
  EXPECT_EQ(slaves.setpoint(1, 50), 50) << "its master";
  EXPECT_FALSE(slave().offset_known);
  EXPECT_FALSE(slave().refused);
  slaves.demand_off({1, 1, 1});
  slaves.couple(command);
  EXPECT_EQ(slaves.setpoint(2, 50), 50);
}

TEST_F(SlavesOfGantry, TheFirstSetpointOfItsChannelKeepsItsDistance) {
  EXPECT_DOUBLE_EQ(GantrySlaves::misalignment(slave(), streams, command), 0.25);
  idl::stream::AxisBatch batch;
  batch.epoch = 1, batch.first = 8, batch.count = 1, batch.starts = true;
  batch.axes = {0, 1, 2};
  batch.setpoints = {0, 10, 10.125};  // 0.125 mm of compensation
  auto& channel = *streams.find(0);
  channel.window.set_next(1, 8);
  channel.start = 8;
  ASSERT_TRUE(streams.put(batch));
  slaves.keep_distances(streams, 8, command);
  EXPECT_FALSE(slave().offset_known) << "the channel does not move it";
  channel.active = true;
  slaves.keep_distances(streams, 7, command);
  EXPECT_FALSE(slave().offset_known) << "not its first cycle";
  slaves.keep_distances(streams, 8, command);
  EXPECT_TRUE(slave().offset_known);
  EXPECT_DOUBLE_EQ(slave().offset, 0.125);
  EXPECT_DOUBLE_EQ(slaves.setpoint(2, 10.125), 10.25) << "where it is";
}

}  // namespace
}  // namespace trunnion::drive
