// SPDX-License-Identifier: Apache-2.0
// Constant surface speed: 200 m/min are 200000 mm/min over a circumference of 2 pi 40 = 251.327 mm, which
// gives 795.775 1/min at 40 mm and twice as much at 20 mm.
#include "surface_speeds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "channel_streams.hpp"
#include "snapshot/fields.hpp"

namespace trunnion::drive::surface_speeds_test {
namespace {

using idl::stream::SpindleCondition;

machine::Parameters one_spindle() {
  machine::Parameters p;
  p.values[105000] = {0, "S"}, p.values[105001] = {machine::axis_type_spindle, ""};
  return p;
}

/// Spindle 0 by channel 3, at most 3000 1/min.
std::vector<idl::plc::SurfaceSpeed> order(double speed, double radius, double limit = 3000) {
  idl::plc::SurfaceSpeed one;
  one.channel = 3, one.speed = speed, one.limit = limit, one.radius = radius;
  return {one};
}

TEST(SurfaceSpeeds, FollowTheRadiusWithinTheLimit) {
  SurfaceSpeeds speeds;
  speeds.configure(1);
  EXPECT_FALSE(speeds.follows(0));
  EXPECT_FALSE(speeds.any());
  speeds.demand(order(200, 40));
  EXPECT_TRUE(speeds.follows(0));
  EXPECT_NEAR(speeds.speed(0), 795.775, 1e-3);
  speeds.turn_at(3, 20);
  EXPECT_NEAR(speeds.speed(0), 1591.549, 1e-3);
  speeds.turn_at(2, 10);
  EXPECT_NEAR(speeds.speed(0), 1591.549, 1e-3) << "another channel";
  speeds.turn_at(3, 0);
  EXPECT_EQ(speeds.speed(0), 3000);
  speeds.demand(order(-240, 40));
  EXPECT_EQ(speeds.speed(0), -3000) << "the other way round, with another override, at the same radius";
  speeds.turn_at(3, 40);
  EXPECT_NEAR(speeds.speed(0), -954.930, 1e-3) << "1.2 times 795.775 1/min";
  speeds.demand(order(200, 40, 0));
  EXPECT_EQ(speeds.speed(0), 0) << "without a limit it does not turn";
  speeds.demand(order(200, 40, std::nan("")));
  EXPECT_EQ(speeds.speed(0), 0) << "nor with one that is no number";
  speeds.demand({});
  EXPECT_FALSE(speeds.follows(0));
}

// The PLC repeats the radius of the order; X has moved since.
TEST(SurfaceSpeeds, TheRadiusOfAnOrderCountsOnceUntilSetpointsHaveNone) {
  SurfaceSpeeds speeds;
  speeds.configure(1);
  speeds.demand(order(200, 40));
  speeds.turn_at(3, 20);
  speeds.demand(order(200, 40));
  EXPECT_NEAR(speeds.speed(0), 1591.549, 1e-3);
  speeds.demand({});  // M5, and on with G96
  speeds.turn_at(3, 80);
  speeds.demand(order(200, 40));
  EXPECT_NEAR(speeds.speed(0), 397.887, 1e-3) << "80 mm";
  speeds.pass(3);  // moved by hand while it turns
  speeds.demand(order(200, 40));
  EXPECT_NEAR(speeds.speed(0), 397.887, 1e-3);
  speeds.demand({});  // G97
  speeds.pass(3);
  speeds.demand(order(200, 40));
  EXPECT_NEAR(speeds.speed(0), 795.775, 1e-3) << "a new order at the radius of the one before";
  speeds.demand(order(200, 20));
  EXPECT_NEAR(speeds.speed(0), 1591.549, 1e-3) << "another S";
}

TEST(SurfaceSpeeds, OrdersOfWhatDoesNotExistAreWithoutEffect) {
  SurfaceSpeeds speeds;
  speeds.configure(1);
  auto orders = order(200, 40);
  orders[0].spindle = 1;
  speeds.demand(orders);
  EXPECT_FALSE(speeds.any());
  orders[0].spindle = 0, orders[0].channel = 32;
  speeds.demand(orders);
  EXPECT_FALSE(speeds.any());
  speeds.turn_at(32, 5), speeds.pass(32);
}

// 10a970 is 5 %, of 795.8 1/min 39.8 1/min; gear 1 has at most 500 1/min.
TEST(SurfaceSpeeds, AreTheCommandedSpeedsOfSpindles) {
  auto parameters = one_spindle();
  parameters.values[105985] = {500, ""};
  Spindles spindles;
  spindles.configure(parameters, 0.001);
  std::vector<SpindleStatus> status(1);
  std::vector<SpindleSetpoint> row(1);
  idl::stream::Feedback feedback;
  const auto step = [&] {
    spindles.step(status, true, row);
    spindles.fill(status, row, true, feedback);
    return feedback.spindles.at(0);
  };
  spindles.demand_speeds({100});
  spindles.demand_surface_speeds(order(200, 40));
  EXPECT_EQ(step().condition, SpindleCondition::SPINDLE_ACCELERATING);
  EXPECT_NEAR(row[0].speed, 795.775, 1e-3);
  status[0].speed = 760;
  EXPECT_EQ(step().condition, SpindleCondition::SPINDLE_AT_SPEED);
  spindles.surface_speeds().turn_at(3, 20);
  EXPECT_EQ(step().condition, SpindleCondition::SPINDLE_ACCELERATING);
  EXPECT_NEAR(row[0].speed, 1591.549, 1e-3);
  spindles.engage_gears({1});
  step();
  EXPECT_EQ(row[0].speed, 500);
  spindles.demand_surface_speeds({});
  step();
  EXPECT_EQ(row[0].speed, 100);
}

// The setpoints of cycle n are 40 - n mm from the centre.
TEST(SurfaceSpeeds, TheRadiusIsThatOfTheCycleThatIsPassed) {
  Spindles spindles;
  spindles.configure(one_spindle(), 0.001);
  ChannelStreams streams;
  streams.add(3);
  auto& channel = *streams.find(3);
  channel.active = true, channel.epoch = 1;
  channel.window.set_next(1, 0);
  idl::stream::AxisBatch batch;
  batch.channel = 3, batch.epoch = 1, batch.first = 0, batch.count = 4, batch.starts = true;
  batch.axes = {0};
  for (int n = 0; n < 4; ++n) batch.setpoints.push_back(n), batch.turning_radius.push_back(40 - n);
  EXPECT_TRUE(streams.put(batch));
  spindles.demand_surface_speeds(order(200, 40));
  for (std::uint64_t n = 0; n < 4; ++n) {
    streams.pass(n, spindles);
    EXPECT_NEAR(spindles.surface_speeds().speed(0), 795.775 * 40 / (40 - static_cast<double>(n)), 2e-3);
  }
}

// A machine that does not use it has the state it had before, and one that does continues with the same bits.
TEST(SurfaceSpeeds, ContinueFromTheirState) {
  Spindles spindles;
  spindles.configure(one_spindle(), 0.001);
  EXPECT_FALSE(snapshot::written(spindles).contains("surface"));
  spindles.demand_surface_speeds(order(200, 40));
  spindles.surface_speeds().turn_at(3, 23);
  Spindles again;
  again.configure(one_spindle(), 0.001);
  snapshot::read(snapshot::written(spindles), again);
  EXPECT_EQ(again.surface_speeds().speed(0), spindles.surface_speeds().speed(0));
  again.demand_surface_speeds(order(200, 40));
  EXPECT_EQ(again.surface_speeds().speed(0), spindles.surface_speeds().speed(0));
}

}  // namespace
}  // namespace trunnion::drive::surface_speeds_test
