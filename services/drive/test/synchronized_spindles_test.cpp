// SPDX-License-Identifier: Apache-2.0
#include "synchronized_spindles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bus/json.hpp"
#include "drive_core.hpp"
#include "simulated_hardware.hpp"
#include "simulated_spindle.hpp"
#include "snapshot/fields.hpp"
#include "spindles.hpp"
#include "three_spindles.hpp"
#include "two_axes.hpp"

namespace trunnion::drive::synchronized_spindles_test {
namespace {

using idl::stream::SpindleCondition;

TEST(SynchronizedSpindles, ASlaveFollowsItsMasterWhateverItIsOrderedAndTurnsByItsOwnOrderAfterwards) {
  Shop shop;
  shop.spindles.demand_speeds({0, 777});
  shop.run(1000);
  EXPECT_EQ(shop.status[1].speed, 777);
  EXPECT_EQ(shop.state(1).master, -1);
  shop.spindles.couple({following(1, 0)});
  shop.spindles.demand_speeds({1200, 777});
  shop.run(6000);
  EXPECT_NEAR(shop.status[1].speed, 1200, 1e-3);
  EXPECT_NEAR(shop.beside(1, 0), 0, 0.01);
  const auto slave = shop.state(1);
  EXPECT_EQ(slave.condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
  EXPECT_EQ(slave.master, 0);
  EXPECT_NEAR(slave.reference, 1200, 0.1);
  EXPECT_NEAR(slave.synchronization_error, 0, 1e-4);
  EXPECT_EQ(shop.state(0).master, -1);
  EXPECT_EQ(shop.state(0).reference, 1200);

  shop.spindles.couple({});
  shop.run(1000);
  EXPECT_EQ(shop.status[0].speed, 1200);
  EXPECT_EQ(shop.status[1].speed, 777);
  EXPECT_EQ(shop.state(1).master, -1);
  EXPECT_TRUE(shop.found.empty());
}

TEST(SynchronizedSpindles, SeveralSlavesFollowOneMasterEachInItsOwnWay) {
  Shop shop;
  shop.spindles.demand_speeds({600});
  shop.spindles.couple({following(1, 0), following(2, 0, true, 90)});
  shop.run(4000);
  EXPECT_NEAR(shop.beside(1, 0), 0, 0.01);
  // slave = -(master + 90 deg)
  EXPECT_NEAR(360 * std::remainder(shop.status[2].angle + shop.status[0].angle + 0.25, 1.0), 0, 0.01);
  EXPECT_NEAR(shop.status[2].speed, -600, 1e-3);
  shop.spindles.demand_speeds({-600});
  shop.run(3000);
  EXPECT_EQ(shop.state(1).condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
  EXPECT_EQ(shop.state(2).condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
  EXPECT_NEAR(shop.status[2].speed, 600, 1e-3);
}

// Constant torque up to 1500, constant power up to 4000 1/min: 2000 1/min take 1500 / 3333.3 s and, as
// N dN/dt is constant then, (2000^2 - 1500^2) / (2 * 1500 * 3333.3) s: 0.45 + 0.175 s. A slave with
// 10000 deg/s2 makes it 2000 / 1666.7 = 1.2 s: at 2000 1/min the master has 15000 deg/s2 left.
TEST(SynchronizedSpindles, TheMasterSpeedsUpAsTheSlowerOfBothCan) {
  auto p = three_spindles();
  p.values[105971] = {1, ""}, p.values[105972] = {1500, ""}, p.values[105973] = {4000, ""};
  const auto periods_to_2000 = [&] {
    Shop shop(p);
    shop.spindles.couple({following(1, 0)});
    shop.run(1);
    shop.spindles.demand_speeds({2000});
    for (int i = 1; i < 5000; ++i) {
      shop.run(1);
      if (shop.state(0).reference == 2000) return i;
      EXPECT_EQ(shop.state(1).condition, SpindleCondition::SPINDLE_SYNCHRONIZED) << i;
    }
    return 0;
  };
  EXPECT_NEAR(periods_to_2000(), 625, 2);
  p.values[106036] = {10000, ""};
  EXPECT_NEAR(periods_to_2000(), 1200, 2);
}

TEST(SynchronizedSpindles, TheOrientationOfTheMasterTakesTheSlaveAlong) {
  auto p = three_spindles();
  p.values[106036] = {5000, ""};  // the slave is the slower one
  Shop shop(p);
  shop.spindles.couple({following(1, 0)});
  shop.spindles.demand_speeds({1500});
  shop.run(4000);
  shop.spindles.demand_orientations({1, 1});
  for (int i = 0; i < 5000; ++i) {
    shop.run(1);
    ASSERT_EQ(shop.state(1).condition, SpindleCondition::SPINDLE_SYNCHRONIZED) << i;
  }
  EXPECT_NEAR(shop.status[0].speed, 0, 1e-6);
  EXPECT_NEAR(360 * std::remainder(shop.status[0].angle, 1.0), 0, 0.01);
  EXPECT_NEAR(shop.beside(1, 0), 0, 0.01);
  EXPECT_FALSE(shop.row[1].coupled) << "its own orientation is not in force";
}

TEST(SynchronizedSpindles, BothSlowDownTogetherWhenTheDrivesAreToGoOffAndBeginAnewAfterwards) {
  Shop shop;
  shop.spindles.couple({following(1, 0, true)});
  shop.spindles.demand_speeds({1000});
  shop.run(3000);
  shop.spindles.run_down(true);
  for (int i = 0; i < 310; ++i) {  // 1000 / 3333.3 s
    shop.run(1);
    ASSERT_EQ(shop.state(1).condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
  }
  EXPECT_EQ(shop.state(0).reference, 0);
  EXPECT_NEAR(shop.beside(1, 0, -1), 0, 0.01);
  shop.run(1, false);
  EXPECT_EQ(shop.state(1).master, -1) << "without control there is no synchronization";
  shop.spindles.run_down(false);
  shop.run(3000);
  EXPECT_EQ(shop.state(1).condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
  EXPECT_NEAR(shop.status[1].speed, -1000, 1e-3);
  EXPECT_TRUE(shop.found.empty());
}

TEST(SynchronizedSpindles, ContinuesWithTheRampThatItHasKept) {
  auto p = three_spindles();
  Shop shop(p);
  shop.spindles.couple({following(1, 0)});
  shop.spindles.demand_speeds({1000});
  shop.run(1000);
  EXPECT_FALSE(snapshot::written(shop.spindles).at("synchronization").contains("ramps"));
  p.values[105971] = p.values[106971] = {1, ""};
  shop.spindles.configure(p, period);
  shop.run(10);
  const auto state = bus::Json::parse(bus::text_of(snapshot::written(shop.spindles)));
  Shop other(p);
  snapshot::read(state, other.spindles);
  other.machines = shop.machines, other.status = shop.status;
  shop.spindles.demand_speeds({}), other.spindles.demand_speeds({});
  for (int i = 0; i < 1000; ++i) {
    shop.run(1), other.run(1);
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(other.row[k].speed, shop.row[k].speed) << i;
  }
  EXPECT_NEAR(other.status[0].speed, 0, 1e-6);
  EXPECT_NEAR(other.status[1].speed, 0, 0.1);
}

// The gear of the slave has 1000, its 10a948 1500 1/min.
TEST(SynchronizedSpindles, AMasterTurnsNoFasterThanItsSlavesMay) {
  auto p = three_spindles();
  p.values[106985] = {1000, ""}, p.values[106948] = {1500, ""};
  Shop shop(p);
  shop.spindles.couple({following(1, 0, true)});
  shop.spindles.demand_speeds({2000});
  shop.spindles.engage_gears({0, 1});
  shop.run(3000);
  EXPECT_EQ(shop.status[0].speed, 1000);
  EXPECT_NEAR(shop.status[1].speed, -1000, 0.1);
  EXPECT_EQ(shop.state(0).condition, SpindleCondition::SPINDLE_AT_SPEED);
  shop.spindles.engage_gears({});
  shop.run(3000);
  EXPECT_EQ(shop.status[0].speed, 1500);
  EXPECT_NEAR(shop.status[1].speed, -1500, 0.1);
  shop.spindles.demand_speeds({-2000});
  shop.run(3000);
  EXPECT_EQ(shop.status[0].speed, -1500);
  shop.spindles.couple({});
  shop.run(3000);
  EXPECT_EQ(shop.status[0].speed, -2000);
  EXPECT_TRUE(shop.found.empty());
}

// The slave is the faster one: it would meet the master at 1818 1/min. Behind the ramp the control makes up
// for at most half a turn, with 250 1/min.
TEST(SynchronizedSpindles, ASlaveDoesNotRunUpAboveItsHighestSpeed) {
  auto p = three_spindles();
  p.values[106036] = {200000, ""}, p.values[106948] = {1000, ""};
  Shop shop(p);
  shop.spindles.demand_speeds({2000});
  shop.run(1000);
  ASSERT_EQ(shop.status[0].speed, 2000);
  shop.spindles.couple({following(1, 0)});
  double most = 0;
  for (int i = 0; i < 5000; ++i) {
    shop.run(1);
    most = std::max(most, shop.row[1].speed);
  }
  EXPECT_LE(most, 1250);
  EXPECT_NEAR(shop.status[1].speed, 1000, 0.1);
  EXPECT_EQ(shop.state(1).condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
}

// Two spindles with a lag of 60 ms, of which the second turns 0.1 % slower than it is told: 2.002 1/min at
// 2000 1/min, which the gain has at 0.004 rev.
TEST(SynchronizedSpindles, TheDriveSynchronizesRealSpindlesReportsThemAndStopsThemTogether) {
  auto p = two_axes();
  const auto spindles = three_spindles();
  for (const auto& [number, value] : spindles.values) p.values[number] = value;
  for (const std::uint32_t axis : {105000u, 106000u}) p.values[axis + 978] = {60, ""};
  std::map<std::string, truth::SpindleTruth> truths;
  truths["S2"].speed_error = -0.001;
  DriveCore core(std::make_unique<SimulatedHardware>(
      std::map<std::string, truth::DriveTruth>(), std::optional<ProbeSetup>(),
      std::optional<volumetric::BeamErrors>(), std::move(truths)));
  core.configure(p, false);
  core.set_enables({1, 1}, false);
  idl::stream::Feedback feedback;
  const auto run = [&](int periods) {
    for (int i = 0; i < periods; ++i) core.step();
    core.fill(feedback);
    return feedback.spindles.at(1);
  };
  auto coupling = following(1, 0);
  coupling.integral = IntegralAction::INTEGRAL_NONE;
  core.set_spindle_couplings({coupling});
  core.set_spindle_speed({2000});
  auto slave = run(6000);
  EXPECT_EQ(slave.master, 0);
  EXPECT_EQ(slave.condition, SpindleCondition::SPINDLE_SYNCHRONIZING);
  EXPECT_NEAR(slave.synchronization_error, 0.004004, 1e-5);
  coupling.integral = IntegralAction::INTEGRAL_ACTIVE;
  core.set_spindle_couplings({coupling});
  slave = run(6000);
  EXPECT_EQ(slave.condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
  EXPECT_NEAR(slave.synchronization_error, 0, 1e-5);
  EXPECT_NEAR(slave.correction, 2.002, 1e-2);
  EXPECT_NEAR(feedback.spindle_speed.at(1), 2000, 0.01);
  coupling.integral = IntegralAction::INTEGRAL_FROZEN;
  core.set_spindle_couplings({coupling});
  core.set_spindle_speed({});
  slave = run(3000);
  EXPECT_EQ(feedback.spindles[0].condition, SpindleCondition::SPINDLE_STOPPED);
  // The correction is kept: it is 2 1/min too much at rest, which the gain has at -0.004 rev.
  EXPECT_NEAR(slave.synchronization_error, -0.004, 1e-4);
  EXPECT_TRUE(core.take_events().empty());

  coupling.master = 5;
  core.set_spindle_couplings({coupling});
  slave = run(1);
  EXPECT_EQ(slave.master, -1);
  const auto events = core.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm->number, 184u);
  EXPECT_EQ(events[0].text,
            "Spindle S2 is not synchronized with Spindle 6: Spindle 6 does not exist; correct the "
            "PLC program");
}

// A machine that does not use it has the state it had before, and one that does continues with the same bits.
TEST(SynchronizedSpindles, ContinuesFromItsStateWithTheSameBits) {
  Shop shop;
  EXPECT_FALSE(snapshot::written(shop.spindles).contains("synchronization"));
  shop.spindles.couple({following(1, 0, true, 30)});
  shop.spindles.demand_speeds({1500});
  shop.run(300);
  const auto state = bus::Json::parse(bus::text_of(snapshot::written(shop.spindles)));
  ASSERT_TRUE(state.contains("synchronization"));
  Shop other;
  snapshot::read(state, other.spindles);
  other.machines = shop.machines, other.status = shop.status;
  for (int i = 0; i < 2000; ++i) {
    shop.run(1), other.run(1);
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(other.row[k].speed, shop.row[k].speed) << i;
  }
  EXPECT_EQ(other.state(1), shop.state(1));
  EXPECT_EQ(other.state(1).condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
}

}  // namespace
}  // namespace trunnion::drive::synchronized_spindles_test
