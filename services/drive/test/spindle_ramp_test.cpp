// SPDX-License-Identifier: Apache-2.0
#include "spindle_ramp.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulated_spindle.hpp"

namespace trunnion::drive {
namespace spindle_ramp_test {
namespace {

constexpr double period = 0.001;
// 20000 deg/s2 are 3333.33 1/min in a second.
const RampSettings constant{20000, false, 1500, 4000}, falling{20000, true, 1500, 4000};

SpindleRamp ramp_of(const RampSettings& settings) {
  SpindleRamp ramp;
  ramp.configure(settings, period);
  return ramp;
}

// Until the reference is `demand`.
int periods(SpindleRamp& ramp, double demand) {
  int count = 0;
  while (ramp.reference() != demand && count < 100000) ramp.step(demand, true), ++count;
  return count;
}

TEST(SpindleRamp, TheAccelerationFallsWithTheSpeedAndAboveThePowerSpeedWithItsSquare) {
  // 20000 * 1500 / N up to 4000 1/min, above that 20000 * 1500 * 4000 / N^2.
  const double expected[][2] = {{0, 20000},    {100, 20000}, {1500, 20000}, {2000, 15000},
                                {3000, 10000}, {4000, 7500}, {5000, 4800},  {6000, 10000.0 / 3}};
  for (const auto& [speed, acceleration] : expected) {
    EXPECT_NEAR(acceleration_at(falling, speed), acceleration, 1e-9) << speed;
    EXPECT_NEAR(acceleration_at(falling, -speed), acceleration, 1e-9) << speed;
    EXPECT_EQ(acceleration_at(constant, speed), 20000) << speed;
  }
  for (const double corner : {1500.0, 4000.0})
    EXPECT_NEAR(acceleration_at(falling, corner * (1 + 1e-12)), acceleration_at(falling, corner), 1e-6);
}

// N / 3333.33 up to 1500 1/min; from there (N^2 - 1500^2) / (2 * 3333.33 * 1500) more, and from 4000 1/min
// (N^3 - 4000^3) / (3 * 3333.33 * 1500 * 4000): 0.45 s, 0.45 + 0.175, 0.45 + 1.375, 1.825 + 1.0167.
TEST(SpindleRamp, TakesTheTimeOfItsIntegralFromRestToEverySpeed) {
  const double expected[][2] = {{100, 0.030}, {1500, 0.450}, {2000, 0.625}, {4000, 1.825}, {5000, 2.8417}};
  for (const auto& [speed, seconds] : expected) {
    auto up = ramp_of(falling), down = ramp_of(falling);
    EXPECT_NEAR(periods(up, speed), seconds / period, 1) << speed;
    EXPECT_NEAR(periods(up, 0), seconds / period, 1) << "down from " << speed;
    EXPECT_NEAR(periods(down, -speed), seconds / period, 1) << -speed;
  }
}

// Without it the spindle accelerates by itself: N / 3333.33.
TEST(SpindleRamp, WithoutItTheReferenceIsTheDemandAndTheSpindleHasItsConstantAcceleration) {
  const double expected[][2] = {{100, 0.030}, {1500, 0.450}, {2000, 0.600}, {4000, 1.200}, {5000, 1.500}};
  for (const auto& [speed, seconds] : expected) {
    auto ramp = ramp_of(constant);
    SimulatedSpindle spindle;
    spindle.configure(20000, period);
    int count = 0;
    for (; spindle.speed() != speed && count < 10000; ++count) {
      const double reference = ramp.step(speed, true);
      ASSERT_EQ(reference, speed);
      spindle.step({reference, false, 0}, true);
    }
    EXPECT_NEAR(count, seconds / period, 1) << speed;
  }
}

// From 100 1/min M4 to 2000 1/min M3: 0.03 + 0.625 s. In revolutions 0.03 * 50 / 60 + 0.45 * 750 / 60 +
// (2000^3 - 1500^3) / (3 * 3333.33 * 1500) / 60 = 0.025 + 5.625 + 5.139.
TEST(SpindleRamp, ThroughZeroItTurnsAsFarAsTheQuadratureSays) {
  auto ramp = ramp_of(falling);
  ramp.step(-100, false);
  SimulatedSpindle spindle;
  spindle.configure(20000, period);
  for (int i = 0; i < 100; ++i) spindle.step({-100, false, 0}, true);
  double turned = 0;
  int count = 0;
  for (; ramp.reference() != 2000 && count < 10000; ++count) {
    const double before = ramp.reference();
    spindle.step({ramp.step(2000, true), false, 0}, true);
    EXPECT_NEAR(spindle.speed(), ramp.reference(), 1e-6) << "it can follow";
    turned += std::abs(before + ramp.reference()) / 2 / 60 * period;
  }
  EXPECT_NEAR(count, 655, 1);
  double quadrature = 0;
  constexpr int steps = 21000;
  for (int i = 0; i < steps; ++i) {
    const double width = 2100.0 / steps, speed = -100 + (i + 0.5) * width;
    quadrature += std::abs(speed) / (acceleration_at(falling, speed) / 6) * width / 60;
  }
  EXPECT_NEAR(quadrature, 10.789, 0.001);
  EXPECT_NEAR(turned, quadrature, 2000 / 60.0 * period) << "within one period";
}

TEST(SpindleRamp, BeginsAtTheSpeedOfTheSpindle) {
  auto ramp = ramp_of(falling);
  EXPECT_EQ(ramp.step(700, false), 700);
  EXPECT_NEAR(ramp.step(2000, true), 700 + 10 / 3.0, 1e-9);
}

TEST(SpindleRamp, WithDataThatCannotBeUsedTheSpindleStaysAtRest) {
  const double unusable[][2] = {{0, 4000}, {1500, 1000}, {0, 0}};
  for (const auto& [base, power] : unusable) {
    const RampSettings settings{20000, true, base, power};
    EXPECT_FALSE(settings.usable());
    EXPECT_EQ(acceleration_at(settings, 0), 0);
    EXPECT_EQ(acceleration_at(settings, 3000), 0);
    auto ramp = ramp_of(settings);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(ramp.step(500, true), 0);
  }
  EXPECT_TRUE((RampSettings{20000, false, 0, 0}).usable()) << "they are not in force";
  EXPECT_TRUE((RampSettings{20000, true, 1500, 1500}).usable());
}

}  // namespace
}  // namespace spindle_ramp_test
}  // namespace trunnion::drive
