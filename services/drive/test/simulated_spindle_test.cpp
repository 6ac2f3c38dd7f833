// SPDX-License-Identifier: Apache-2.0
// What truth.yaml says of a spindle besides its motor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bus/json.hpp"
#include "simulated_spindle.hpp"
#include "snapshot/fields.hpp"

namespace trunnion::drive {
namespace simulated_spindle_test {
namespace {

constexpr double period = 0.001;
// 60000 deg/s2 are 10 1/min in a period.
constexpr double acceleration = 60000;

void turn(SimulatedSpindle& spindle, double speed, int periods, std::uint8_t gear = 0) {
  for (int i = 0; i < periods; ++i) spindle.step({speed, false, 0, gear}, true);
}

TEST(SimulatedSpindle, HasTheSpeedErrorWhileItIsControlledBySpeedOnly) {
  truth::SpindleTruth truth;
  truth.speed_error = -0.001;
  SimulatedSpindle spindle;
  spindle.configure(acceleration, period, &truth);
  turn(spindle, 2000, 300);
  EXPECT_NEAR(spindle.speed(), 1998, 1e-9);
  turn(spindle, 0, 300);
  const double from = spindle.angle();
  // 0.0001 rev in a period are 6 1/min, which it reaches at once.
  for (int i = 1; i <= 10; ++i) spindle.step({0, true, from + i * 0.0001}, true);
  EXPECT_NEAR(spindle.angle(), from + 0.001, 1e-12);
}

// 5 Hz are 200 periods, of which one is at the crest and one in the trough; over all of them it is nothing.
TEST(SimulatedSpindle, TheDisturbanceIsASineOfItsShareThatIsTheSameInEveryRun) {
  truth::SpindleTruth truth;
  truth.ripple = 0.02, truth.ripple_frequency = 5;
  SimulatedSpindle spindle, other;
  for (auto* s : {&spindle, &other}) {
    s->configure(acceleration, period, &truth);
    turn(*s, 1000, 500);
  }
  const double from = spindle.angle();
  double lowest = 2000, highest = 0;
  for (int i = 0; i < 200; ++i) {
    turn(spindle, 1000, 1);
    turn(other, 1000, 1);
    ASSERT_EQ(spindle.speed(), other.speed());
    lowest = std::min(lowest, spindle.speed()), highest = std::max(highest, spindle.speed());
  }
  EXPECT_NEAR(lowest, 980, 1e-6);
  EXPECT_NEAR(highest, 1020, 1e-6);
  EXPECT_NEAR(spindle.angle() - from, 1000 / 60.0 * 0.2, 1e-9);
}

// After one time constant 1 - 1 / e of a step. The acceleration is 1000 1/min in a period and limits nothing.
TEST(SimulatedSpindle, TheSpeedLoopHasTheTimeConstantOfItsParameter) {
  SimulatedSpindle spindle;
  spindle.configure({6e6, 0.06}, period);
  turn(spindle, 100, 60);
  EXPECT_NEAR(spindle.speed(), 100 * (1 - std::exp(-1.0)), 0.01);
  turn(spindle, 100, 240);
  EXPECT_NEAR(spindle.speed(), 100 * (1 - std::exp(-5.0)), 0.01);

  SimulatedSpindle coupled;
  coupled.configure({6e6, 0.06}, period);
  coupled.step({0, true, 0.001}, true);
  EXPECT_NEAR(coupled.angle(), 0.001, 1e-12) << "it is controlled by the angle";
}

// 10 Nm less 5 Nm give 0.05 kg m2 100 rad/s2, which are 954.93 1/min in a second.
TEST(SimulatedSpindle, ALoadTakesItsPartOfTheTorqueAndHelpsToBrake) {
  truth::SpindleTruth truth{0.05, {{0, 10}}};
  truth.load_torque = 5;
  SimulatedSpindle spindle;
  spindle.configure(acceleration, period, &truth);
  turn(spindle, -1000, 100);
  EXPECT_NEAR(spindle.speed(), -95.493, 1e-3);
  EXPECT_NEAR(spindle.status().torque, 1, 1e-9);
  turn(spindle, -50, 50);
  EXPECT_EQ(spindle.speed(), -50);
  EXPECT_NEAR(spindle.status().torque, 0.5, 1e-9) << "5 of 10 Nm at constant speed";
  // 15 Nm are 2864.8 1/min in a second: 50 1/min in 17.5 ms.
  turn(spindle, 0, 17);
  EXPECT_LT(spindle.speed(), 0);
  turn(spindle, 0, 1);
  EXPECT_EQ(spindle.speed(), 0);

  turn(spindle, 50, 100);
  ASSERT_EQ(spindle.speed(), 50);
  truth.load_torque = 20;  // 10 Nm are missing: 1909.9 1/min in a second, 50 1/min in 26.2 ms
  turn(spindle, 50, 26);
  EXPECT_GT(spindle.speed(), 0);
  turn(spindle, 50, 100);
  EXPECT_EQ(spindle.speed(), 0) << "it is stalled and does not turn back";
}

// 40 Nm at the spindle give 0.05 kg m2 800 rad/s2: 7639.4 1/min in a second. Without a gear it is a quarter.
TEST(SimulatedSpindle, AGearMultipliesTheTorqueOfTheMotor) {
  const truth::SpindleTruth truth{0.05, {{0, 10}, {1000, 10}, {2000, 5}}, 0, 0, 1, 0, {4, 1}};
  SimulatedSpindle geared, direct;
  for (auto* s : {&geared, &direct}) s->configure(acceleration, period, &truth);
  turn(geared, 1000, 10, 1);
  turn(direct, 1000, 10, 2);
  EXPECT_NEAR(geared.speed(), 76.394, 1e-3);
  EXPECT_NEAR(direct.speed(), 76.394 / 4, 1e-3);
}

// The mark is 90 deg ahead. At 60 1/min, 0.001 rev in a period, it is passed in the 250th period at speed.
TEST(SimulatedSpindle, CountsFromItsIndexMarkOnceThatHasPassed) {
  truth::SpindleTruth truth;
  truth.mark = 90;
  SimulatedSpindle spindle;
  spindle.configure(acceleration, period, &truth);
  EXPECT_FALSE(spindle.status().homed);
  EXPECT_EQ(spindle.angle(), 0);
  double before = 0;
  while (!spindle.status().homed && spindle.angle() < 1) before = spindle.angle(), turn(spindle, 60, 1);
  EXPECT_TRUE(spindle.status().homed);
  EXPECT_NEAR(before, 0.25, 0.001);
  EXPECT_NEAR(spindle.angle(), before + 0.001 - 0.25, 1e-9);
  EXPECT_GE(spindle.angle(), 0);

  SimulatedSpindle backwards;
  backwards.configure(acceleration, period, &truth);
  while (!backwards.status().homed && backwards.angle() > -1) turn(backwards, -60, 1);
  EXPECT_NEAR(backwards.angle(), -1, 0.001) << "at -270 deg of its start, the turn before the mark";

  const SimulatedSpindle plain;
  EXPECT_TRUE(plain.status().homed) << "it starts at its mark";
}

TEST(SimulatedSpindle, ItsCountDoesNotStepWhileItFollowsAnAngle) {
  truth::SpindleTruth truth;
  truth.mark = 90;
  SimulatedSpindle spindle;
  spindle.configure(acceleration, period, &truth);
  double angle = 0;
  for (int i = 0; i < 500; ++i) angle += 0.001, spindle.step({0, true, angle}, true);
  EXPECT_NEAR(spindle.angle(), 0.5, 0.05);
  EXPECT_FALSE(spindle.status().homed);
  const double last = spindle.angle();
  turn(spindle, 0, 1);
  EXPECT_TRUE(spindle.status().homed);
  EXPECT_NEAR(spindle.angle(), last - 0.25, 0.001);
}

TEST(SimulatedSpindle, ItsStateContinuesToTheBit) {
  truth::SpindleTruth truth{0.05, {{0, 10}}};
  truth.load_torque = 2, truth.mark = 200, truth.speed_error = 0.01;
  truth.ripple = 0.05, truth.ripple_frequency = 7;
  SimulatedSpindle one, other;
  for (auto* s : {&one, &other}) s->configure({acceleration, 0.02}, period, &truth);
  for (int i = 0; i < 3000; ++i) {
    if (i % 100 == 0) {
      SimulatedSpindle fresh;
      fresh.configure({acceleration, 0.02}, period, &truth);
      snapshot::read(bus::Json::parse(bus::text_of(snapshot::written(one))), fresh);
      other = fresh;
    }
    for (auto* s : {&one, &other}) turn(*s, i < 1500 ? 300 : -200, 1);
    ASSERT_EQ(other.angle(), one.angle()) << i;
    ASSERT_EQ(other.speed(), one.speed()) << i;
    ASSERT_EQ(other.status().torque, one.status().torque) << i;
    ASSERT_EQ(other.status().homed, one.status().homed) << i;
  }
  EXPECT_TRUE(one.status().homed);
}

TEST(SimulatedSpindle, WithoutATruthItsStateIsThatOfOlderRecordings) {
  SimulatedSpindle spindle;
  spindle.configure({acceleration, 0.02}, period);
  turn(spindle, 500, 10);
  EXPECT_EQ(snapshot::written(spindle).size(), 2u) << "speed and angle";
}

}  // namespace
}  // namespace simulated_spindle_test
}  // namespace trunnion::drive
