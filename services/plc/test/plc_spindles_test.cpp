// SPDX-License-Identifier: Apache-2.0
// Angles, gears and couplings of spindles: registers into outputs, and what the drive says into registers.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "core_bench.hpp"

namespace trunnion::plc::spindles_test {
namespace {

using idl::stream::SpindleCondition;

std::int32_t value_of(const Bench& bench, const char* name, std::size_t index) {
  return load(bench.core.memory().registers, interface_address(name, index));
}

/// After a kill of the process of `bench`, as the service does it: the memory is there before the parameters,
/// and neither the programs have run nor has the drive said anything.
PlcCore restarted(const Bench& bench, const std::string& machine = "two-channel") {
  PlcCore core;
  load_programs(std::string(TRUNNION_MACHINES) + "/" + machine + "/plc", core);
  core.restore(bench.core.memory());
  core.configure(two_axes_and_spindles(), true);
  return core;
}

/// As a program that writes the register in every scan.
void write(Bench& bench, const char* name, std::size_t index, std::uint64_t value) {
  const auto at = interface_address(name, index);
  bench.core.force({st::address_of(at.area, at.index), at.bit, value, 0, 0});
  bench.feedback();
}

TEST(Spindles, WhatNoProgramUsesIsNotInTheOutputs) {
  Bench bench;
  bench.request(AuxiliaryKind::M, 19);
  const auto outputs = bench.core.outputs();
  EXPECT_EQ(outputs.spindle_orient, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_TRUE(outputs.spindle_angle.empty());
  EXPECT_TRUE(outputs.spindle_gear.empty());
  EXPECT_TRUE(outputs.spindle_couplings.empty());
  EXPECT_EQ(value_of(bench, "m_angle", 0), 65535);
}

// The drive gives up the angle of before, so that what it reports is the new one.
TEST(Spindles, M19WithAnAngleIsFinishedAtThisAngle) {
  Bench bench("ac-table");
  bench.request_angle(19, 90);
  EXPECT_EQ(value_of(bench, "m_angle", 0), 9000);
  EXPECT_EQ(bench.core.outputs().spindle_angle, (std::vector<double>{90, -1}));
  bench.run();
  EXPECT_TRUE(bench.done());
  EXPECT_EQ(bench.core.outputs().spindle_orient[0], 1);

  bench.request_angle(19, 180);
  bench.late_orientation = true;
  bench.feedback();
  EXPECT_FALSE(bench.done()) << "it is still held at 90 deg";
  EXPECT_EQ(bench.core.outputs().spindle_orient[0], 0);
  bench.late_orientation = false;
  bench.run();
  EXPECT_TRUE(bench.done());
  EXPECT_EQ(bench.core.outputs().spindle_orient[0], 1);
  EXPECT_EQ(bench.core.outputs().spindle_angle, (std::vector<double>{180, -1}));

  bench.request(AuxiliaryKind::M, 19);
  EXPECT_FALSE(bench.done());
  bench.run();
  EXPECT_TRUE(bench.done());
  EXPECT_TRUE(bench.core.outputs().spindle_angle.empty()) << "10a945";
}

TEST(Spindles, ARestartedProcessKeepsTheAngleThatIsHeld) {
  Bench bench("ac-table");
  bench.request_angle(19, 90);
  bench.run();
  ASSERT_EQ(value_of(bench, "spindle_oriented", 0), 1);
  const auto at_once = restarted(bench, "ac-table").outputs();
  EXPECT_EQ(at_once.spindle_orient, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(at_once.spindle_angle, (std::vector<double>{90, -1}));
  Bench again("ac-table", false);
  again.core.restore(bench.core.memory());
  EXPECT_EQ(again.core.outputs().spindle_orient, at_once.spindle_orient) << "also with parameters before it";
  again.tick = bench.tick;
  again.feedback();
  EXPECT_EQ(again.core.outputs().spindle_orient[0], 1);
  EXPECT_EQ(again.core.outputs().spindle_angle, (std::vector<double>{90, -1}));
  EXPECT_EQ(value_of(again, "spindle_oriented", 0), 1);
}

// What the drive says counts once it has said something else, or after 100 ms.
TEST(Spindles, ASurfaceSpeedIsInTheOutputsInPlaceOfASpeedWhileTheSpindleTurns) {
  Bench bench;
  bench.spindles.resize(2);
  bench.request_surface(200.04, 3000, 40.02);
  bench.run();
  EXPECT_TRUE(bench.done()) << "it stands";
  EXPECT_EQ(value_of(bench, "s_value", 0), 200);
  EXPECT_EQ(value_of(bench, "s_surface_speed", 0), 2000);
  EXPECT_EQ(value_of(bench, "s_limit", 0), 3000);
  EXPECT_EQ(value_of(bench, "s_radius", 0), 400);
  EXPECT_TRUE(bench.core.outputs().surface_speeds.empty());

  bench.request(AuxiliaryKind::M, 3);
  auto outputs = bench.core.outputs();
  ASSERT_EQ(outputs.surface_speeds.size(), 1u);
  EXPECT_EQ(outputs.surface_speeds[0].spindle, 0);
  EXPECT_EQ(outputs.surface_speeds[0].channel, 0);
  EXPECT_EQ(outputs.surface_speeds[0].speed, 200);
  EXPECT_EQ(outputs.surface_speeds[0].limit, 3000);
  EXPECT_EQ(outputs.surface_speeds[0].radius, 40);
  EXPECT_EQ(outputs.spindle_speed, (std::vector<double>{0, 0}));
  bench.spindles[0].condition = SpindleCondition::SPINDLE_AT_SPEED;
  bench.feedback();
  EXPECT_FALSE(bench.done()) << "it may be the speed of before";
  bench.spindles[0].condition = SpindleCondition::SPINDLE_ACCELERATING;
  bench.feedback();
  EXPECT_FALSE(bench.done());
  bench.spindles[0].condition = SpindleCondition::SPINDLE_AT_SPEED;
  bench.run();
  EXPECT_TRUE(bench.done());

  bench.request(AuxiliaryKind::M, 4);
  EXPECT_EQ(bench.core.outputs().surface_speeds.at(0).speed, -200);
  bench.run();
  EXPECT_TRUE(bench.done()) << "after 100 ms";
  idl::channel::ChannelState state;
  state.spindle_override = 1.2, state.feed_override = 1, state.rapid_override = 1;
  bench.core.set_channel(state);
  bench.step();
  EXPECT_EQ(bench.core.outputs().surface_speeds.at(0).speed, -240) << "with the override";
  EXPECT_EQ(bench.core.outputs().surface_speeds.at(0).limit, 3000) << "without it";

  bench.request(AuxiliaryKind::S, 0, 500);
  outputs = bench.core.outputs();
  EXPECT_TRUE(outputs.surface_speeds.empty());
  EXPECT_EQ(outputs.spindle_speed[0], -600);
}

TEST(Spindles, ARestartedProcessOrdersASurfaceSpeedBeforeItHasHeardTheDrive) {
  Bench bench;
  bench.spindles.resize(2);
  bench.request_surface(200, 3000, 40);
  bench.run();
  bench.request(AuxiliaryKind::M, 3);
  bench.spindles[0].condition = SpindleCondition::SPINDLE_AT_SPEED;
  bench.run();
  ASSERT_TRUE(bench.done());
  const auto before = bench.core.outputs();
  ASSERT_EQ(before.surface_speeds.size(), 1u);
  const auto at_once = restarted(bench).outputs();
  EXPECT_EQ(at_once.surface_speeds, before.surface_speeds);
  EXPECT_EQ(at_once.spindle_speed, before.spindle_speed);
}

// Spindle 1 follows X of channel 1: `spindle_surface_channel_1` of the main task.
TEST(Spindles, ASurfaceSpeedBelongsToTheChannelThatIsNamed) {
  Bench bench;
  write(bench, "spindle_surface_speed", 1, 1500);
  write(bench, "spindle_enable", 1, 1);
  const auto outputs = bench.core.outputs();
  ASSERT_EQ(outputs.surface_speeds.size(), 1u);
  EXPECT_EQ(outputs.surface_speeds[0].spindle, 1);
  EXPECT_EQ(outputs.surface_speeds[0].channel, 1);
  EXPECT_EQ(outputs.surface_speeds[0].speed, 150);
  EXPECT_EQ(outputs.surface_speeds[0].limit, 0) << "no S has told one";
  write(bench, "spindle_surface_channel", 1, 8);
  EXPECT_TRUE(bench.core.outputs().surface_speeds.empty()) << "there is no channel 8";
}

TEST(Spindles, AGearIsInTheOutputsWhileOneIsEngaged) {
  Bench bench;
  write(bench, "spindle_gear", 1, 2);
  EXPECT_EQ(bench.core.outputs().spindle_gear, (std::vector<std::uint8_t>{0, 2}));
  write(bench, "spindle_gear", 1, 0);
  EXPECT_TRUE(bench.core.outputs().spindle_gear.empty());
}

TEST(Spindles, ACouplingNeedsAnotherSpindleAsItsMaster) {
  Bench bench;
  write(bench, "spindle_master_angle", 1, 9000);
  write(bench, "spindle_reverse", 1, 1);
  write(bench, "spindle_integral", 1, 2);
  EXPECT_TRUE(bench.core.outputs().spindle_couplings.empty());
  write(bench, "spindle_master", 1, 1);
  const auto couplings = bench.core.outputs().spindle_couplings;
  ASSERT_EQ(couplings.size(), 1u);
  EXPECT_EQ(couplings[0].slave, 1);
  EXPECT_EQ(couplings[0].master, 0);
  EXPECT_TRUE(couplings[0].reverse);
  EXPECT_EQ(couplings[0].angle, 90);
  EXPECT_EQ(couplings[0].integral, idl::plc::IntegralAction::INTEGRAL_FROZEN);
  for (const std::uint64_t no_other : {2u, 3u, 0u}) {  // itself; the machine has two
    write(bench, "spindle_master", 1, no_other);
    EXPECT_TRUE(bench.core.outputs().spindle_couplings.empty()) << no_other;
  }
}

/// Spindle 1 follows spindle 0.
idl::stream::SpindleState slave(SpindleCondition condition) {
  idl::stream::SpindleState state;
  state.condition = condition;
  state.master = 0;
  return state;
}

TEST(Spindles, AnOrderIsItsSpindleAndAWholeNumber) {
  const auto registers = [](std::uint32_t code, double value) {
    const auto order = spindle_order(code, value);
    return std::array{order.order, order.spindle, order.value};
  };
  using Order = std::array<std::int32_t, 3>;
  EXPECT_EQ(registers(94124, 27), (Order{1, 1, 4}));
  EXPECT_EQ(registers(94127, -1), (Order{1, 4, 0}));
  EXPECT_EQ(registers(98025, 500), (Order{2, 2, 1}));
  EXPECT_EQ(registers(98025, -500), (Order{2, 2, 2}));
  EXPECT_EQ(registers(98025, 0), (Order{2, 2, 0}));
  EXPECT_EQ(registers(0, -90), (Order{3, 0, 27000}));
  EXPECT_EQ(registers(91024, 0), (Order{0, 0, 0}));
}

TEST(Spindles, AnOrderIsCarriedOutByTheProgramsThatKnowOne) {
  Bench lathe("lathe");
  lathe.spindles.resize(2);
  for (auto& state : lathe.spindles) state.master = -1, state.homed = true;
  lathe.feedback();
  lathe.request(AuxiliaryKind::E, 94125, 24);
  EXPECT_EQ(value_of(lathe, "e_order", 0), 1);
  EXPECT_EQ(value_of(lathe, "e_spindle", 0), 2);
  EXPECT_EQ(value_of(lathe, "e_value", 0), 1);
  ASSERT_TRUE(lathe.done());
  EXPECT_FALSE(lathe.finished.back().failed);
  const auto couplings = lathe.core.outputs().spindle_couplings;
  ASSERT_EQ(couplings.size(), 1u);
  EXPECT_EQ(couplings[0].slave, 1);
  EXPECT_FALSE(couplings[0].reverse);

  Bench other;
  other.request(AuxiliaryKind::E, 94125, 24);
  ASSERT_TRUE(other.done());
  EXPECT_TRUE(other.finished.back().failed);
}

// Outputs without the coupling would end it in the drive while the spindles turn.
TEST(Spindles, ARestartedProcessOrdersASynchronizationBeforeItHasHeardTheDrive) {
  Bench bench;
  bench.spindles.resize(2);
  bench.spindles[0].master = -1;
  bench.spindles[1] = slave(SpindleCondition::SPINDLE_SYNCHRONIZING);
  write(bench, "spindle_master_angle", 1, 9000);
  write(bench, "spindle_reverse", 1, 1);
  write(bench, "spindle_integral", 1, 2);
  write(bench, "spindle_master", 1, 1);
  bench.feedback();
  bench.spindles[1] = slave(SpindleCondition::SPINDLE_SYNCHRONIZED);
  bench.feedback();
  ASSERT_EQ(value_of(bench, "spindle_synchronized", 1), 1);
  const auto before = bench.core.outputs();
  ASSERT_EQ(before.spindle_couplings.size(), 1u);
  auto core = restarted(bench);
  EXPECT_EQ(core.outputs().spindle_couplings, before.spindle_couplings);

  // What it hears first is what it knew: the programs see no change of it.
  idl::stream::Feedback feedback;
  feedback.tick = bench.tick;
  feedback.spindle_speed = {0, 0};
  feedback.spindles = bench.spindles;
  core.set_feedback(feedback);
  EXPECT_EQ(load(core.memory().registers, interface_address("spindle_synchronized", 1)), 1);
  EXPECT_EQ(core.outputs().spindle_couplings, before.spindle_couplings);

  // Feedback that comes before the parameters is no order, and changes no input of a spindle.
  PlcCore early;
  load_programs(TRUNNION_MACHINES "/two-channel/plc", early);
  early.restore(bench.core.memory());
  early.set_feedback(feedback);
  early.configure(two_axes_and_spindles(), true);
  EXPECT_EQ(early.outputs().spindle_couplings, before.spindle_couplings);
  EXPECT_EQ(load(early.memory().registers, interface_address("spindle_synchronized", 1)), 1);
}

// Time runs on until the drive says so: the main task runs every 10 ms.
TEST(Spindles, ASlaveIsAtSpeedWhenItIsSynchronized) {
  Bench bench;
  bench.spindles.resize(2);
  bench.spindles[0].master = -1;
  bench.spindles[1].master = -1;
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 1), 1) << "it stands, as it is ordered";
  write(bench, "spindle_master", 1, 1);
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 1), 0);
  EXPECT_EQ(bench.core.outputs().run_until_tick, bench.tick + 10);
  bench.spindles[1] = slave(SpindleCondition::SPINDLE_SYNCHRONIZING);
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 1), 0);
  bench.spindles[1] = slave(SpindleCondition::SPINDLE_SYNCHRONIZED);
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 1), 1);
  EXPECT_EQ(value_of(bench, "spindle_synchronized", 1), 1);
  EXPECT_EQ(bench.core.outputs().run_until_tick, bench.tick);

  // Another angle: what the drive says may be of the one before until it has said that it is not there.
  write(bench, "spindle_master_angle", 1, 100);
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_synchronized", 1), 0);
  bench.spindles[1] = slave(SpindleCondition::SPINDLE_SYNCHRONIZING);
  bench.feedback();
  // A slave that does not come holds virtual time for 30 s.
  EXPECT_EQ(bench.core.outputs().run_until_tick, bench.tick + 10);
  bench.tick += 31000;
  bench.feedback();
  EXPECT_EQ(bench.core.outputs().run_until_tick, bench.tick);
  bench.spindles[1] = slave(SpindleCondition::SPINDLE_SYNCHRONIZED);
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_synchronized", 1), 1);
  write(bench, "spindle_master", 1, 0);
  EXPECT_EQ(value_of(bench, "spindle_synchronized", 1), 0);
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 1), 1);
}

// 985 of 1000 1/min are within 2 %, 975 are not.
TEST(Spindles, TheWindowOfTheSpeedIsAParameter) {
  Bench bench;
  auto parameters = two_axes_and_spindles();
  parameters.values[110970] = {2, ""};
  bench.core.configure(parameters, true);
  bench.request(AuxiliaryKind::S, 0, 1000);
  bench.request(AuxiliaryKind::M, 3);
  bench.speed[0] = 975;
  bench.feedback();
  EXPECT_FALSE(bench.done());
  bench.speed[0] = 985;
  bench.feedback();
  EXPECT_TRUE(bench.done());
}

// The drive turns a spindle no faster than its 10a948, and a master no faster than its slaves may.
TEST(Spindles, AnOrderAboveTheHighestSpeedIsReachedAtTheHighestSpeed) {
  Bench bench;
  auto parameters = two_axes_and_spindles();
  parameters.values[110948] = {900, ""};
  parameters.values[111948] = {700, ""}, parameters.values[111985] = {500, ""};
  bench.core.configure(parameters, true);
  bench.request(AuxiliaryKind::S, 0, 1000);
  bench.request(AuxiliaryKind::M, 4);
  EXPECT_EQ(bench.core.outputs().spindle_speed[0], -1000) << "the limit is the drive's";
  bench.speed[0] = -800;
  bench.feedback();
  EXPECT_FALSE(bench.done());
  bench.speed[0] = -900;
  bench.feedback();
  EXPECT_TRUE(bench.done());

  bench.spindles.resize(2);
  bench.spindles[0].master = -1;
  bench.spindles[1] = slave(SpindleCondition::SPINDLE_SYNCHRONIZING);
  write(bench, "spindle_master", 1, 1);
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 0), 1) << "the slave does not follow yet";
  bench.spindles[1] = slave(SpindleCondition::SPINDLE_SYNCHRONIZED);
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 0), 0);
  bench.speed[0] = -700;
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 0), 1);
  write(bench, "spindle_gear", 1, 1);
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 0), 0);
  bench.speed[0] = -500;
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_at_speed", 0), 1);
}

// 2.25 turns are 90 deg; 0.999999 turns are 359.9996 deg, which rounds to 0.
TEST(Spindles, TheAngleCountsFromTheIndexMarkWithinATurn) {
  Bench bench;
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_homed", 0), 0);
  bench.spindles.resize(2);
  bench.spindles[0].homed = true;
  bench.spindles[0].angle = 2.25;
  bench.spindles[1].angle = -0.25;
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_homed", 0), 1);
  EXPECT_EQ(value_of(bench, "spindle_homed", 1), 0);
  EXPECT_EQ(value_of(bench, "spindle_position", 0), 9000);
  EXPECT_EQ(value_of(bench, "spindle_position", 1), 27000);
  bench.spindles[0].angle = 0.999999;
  bench.feedback();
  EXPECT_EQ(value_of(bench, "spindle_position", 0), 0);
  EXPECT_EQ(hundredths(-90), 27000);
  EXPECT_EQ(hundredths(360), 0);
}

}  // namespace
}  // namespace trunnion::plc::spindles_test
