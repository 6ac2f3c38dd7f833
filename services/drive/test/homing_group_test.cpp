// SPDX-License-Identifier: Apache-2.0
#include "homing_group.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "gantry_bench.hpp"

namespace trunnion::drive {
namespace {

// The axes of the gantry, with what a test does to their limits.
struct SearchedGantry {
  SearchedGantry() {
    slaves.configure(machine.parameters, 3);
    for (std::uint16_t axis = 0; axis < 3; ++axis) limits.push_back(axis_limits(machine.parameters, axis));
  }
  HomingGroup::Start start() {
    search.gather(4, 1, slaves, command);
    return search.start({1, "Y1", machine::axis_type_linear}, limits, command);
  }

  GantryMachine machine;
  GantrySlaves slaves;
  std::vector<AxisLimits> limits;
  std::vector<double> command = {0, 10, 20};
  std::vector<AxisStatus> status = std::vector<AxisStatus>(3);
  HomingGroup search;
};

TEST(HomingGroup, ASlaveMovesWithItsMasterAndFindsItsOwnEdge) {
  SearchedGantry gantry;
  gantry.limits[1].homing_direction = gantry.limits[2].homing_direction = 1;
  gantry.limits[1].reference = gantry.limits[2].reference = 500;
  for (auto& slave : gantry.slaves.all()) slave.offset_known = true;
  ASSERT_EQ(gantry.start(), HomingGroup::Start::moves);
  EXPECT_EQ(gantry.search.channel(), 4);
  EXPECT_FALSE(gantry.slaves.all()[0].offset_known);
  auto state = HomingCycle::State::moving;
  for (int i = 0; i < 100000 && state == HomingCycle::State::moving; ++i) {
    state = gantry.search.step(gantry.limits, gantry.status, 0.001, gantry.command);
    ASSERT_NEAR(gantry.command[2] - gantry.command[1], 10, 1e-9);
    // The switch of the slave comes 0.5 mm behind that of the master.
    const double edges[] = {0, 30, 40.5};
    for (std::size_t column : {1u, 2u}) {
      auto& axis = gantry.status[column];
      const bool on = gantry.command[column] > edges[column];
      if (on && !axis.home_switch) axis.home_latch = gantry.command[column];
      axis.home_switch = on;
    }
  }
  ASSERT_EQ(state, HomingCycle::State::done);
  ASSERT_EQ(gantry.search.members().size(), 2u);
  for (const auto& member : gantry.search.members()) {
    const auto shift = gantry.search.shift(member, gantry.limits[member.column], gantry.status[member.column],
                                           gantry.command[member.column]);
    ASSERT_TRUE(shift);
    EXPECT_NEAR(*shift, member.column == 1 ? 500 - 30 : 500 - 40.5, 0.01);
  }
  EXPECT_EQ(gantry.command[0], 0) << "no member";
}

// Their own speed stays, whatever a demand asks for above it.
TEST(HomingGroup, ADemandMakesTheSearchSlowerAndNeverFaster) {
  for (const double speed : {1e6, 0.0, 2.0}) {
    SearchedGantry gantry;
    gantry.limits[1].homing_direction = gantry.limits[2].homing_direction = 1;
    gantry.search.gather(4, 1, gantry.slaves, gantry.command);
    ASSERT_EQ(gantry.search.start({1, "Y1", machine::axis_type_linear}, gantry.limits, gantry.command, speed),
              HomingGroup::Start::moves);
    for (int i = 0; i < 500; ++i) gantry.search.step(gantry.limits, gantry.status, 0.001, gantry.command);
    const double before = gantry.command[1];
    gantry.search.step(gantry.limits, gantry.status, 0.001, gantry.command);
    const auto &master = gantry.limits[1], &slave = gantry.limits[2];
    const double own = std::min({master.homing_search, master.velocity, slave.homing_search, slave.velocity});
    EXPECT_NEAR((gantry.command[1] - before) / 0.001, speed == 2.0 ? 2.0 : own, 1e-6) << speed;
  }
}

TEST(HomingGroup, RefusesOppositeDirections) {
  SearchedGantry gantry;
  gantry.limits[1].homing_direction = 1, gantry.limits[2].homing_direction = -1;
  EXPECT_EQ(gantry.start(), HomingGroup::Start::contrary);
}

TEST(HomingGroup, AnAbsoluteEncoderThatHasLostItsPositionGetsItsReferenceWhereItIs) {
  SearchedGantry gantry;
  EXPECT_EQ(gantry.start(), HomingGroup::Start::nothing);
  const auto& master = gantry.search.members().front();
  auto& status = gantry.status[1];
  EXPECT_FALSE(gantry.search.shift(master, gantry.limits[1], status, 10));
  status.homed = false;
  gantry.limits[1].reference = 700;
  EXPECT_EQ(gantry.search.shift(master, gantry.limits[1], status, 10), 690);
}

TEST(HomingGroup, SaysHowFarItHasSearchedUnlessItWasEnded) {
  SearchedGantry gantry;
  const machine::AxisInfo axis{1, "Y1", machine::axis_type_linear};
  for (const int column : {1, 2}) {
    auto& l = gantry.limits[static_cast<std::size_t>(column)];
    l.homing_direction = 1, l.positive = 50, l.negative = 0;
  }
  for (const bool ended : {false, true}) {
    ASSERT_EQ(gantry.start(), HomingGroup::Start::moves);
    if (ended) gantry.search.abort();
    auto state = HomingCycle::State::moving;
    for (int i = 0; i < 1000000 && state == HomingCycle::State::moving; ++i)
      state = gantry.search.step(gantry.limits, gantry.status, 0.001, gantry.command);
    EXPECT_EQ(state, HomingCycle::State::failed);
    const auto text = gantry.search.failure(axis, gantry.limits[1]);
    EXPECT_EQ(text.substr(0, text.find(':')),
              ended ? "" : "Axis Y1 or its slave has not found its home switch within 55 mm");
  }
}

}  // namespace
}  // namespace trunnion::drive
