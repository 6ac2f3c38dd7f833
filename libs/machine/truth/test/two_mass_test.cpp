// SPDX-License-Identifier: Apache-2.0
#include "truth/two_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trunnion::truth {
namespace {

constexpr double rated = 4500, dt = 0.000125;

MechanicsTruth elastic(double locked_frequency, double load_share) {
  MechanicsTruth m;
  m.locked_frequency = locked_frequency;
  m.load_share = load_share;
  m.damping_ratio = 0;
  return m;
}

TwoMass plant(const MechanicsTruth& m) {
  TwoMass plant;
  plant.configure(m, 1, rated);
  plant.place(0);
  return plant;
}

TEST(TwoMass, ResonatesAtTheFrequencyOfBothMassesWithinOnePercent) {
  for (const double locked : {20.0, 60.0, 150.0, 300.0})
    for (const double share : {0.3, 0.5, 0.6}) {
      auto p = plant(elastic(locked, share));
      p.step(rated, dt);
      // The twist vibrates with sqrt(k / m1 + k / m2) = locked / sqrt(1 - share).
      const double expected = locked / std::sqrt(1 - share);
      int crossings = 0;
      double first = 0, last = 0, before = 0;
      for (int i = 0; crossings < 101; ++i) {
        p.step(0, dt);
        const double twist = p.motor() - p.load();
        if (before < 0 && twist >= 0) {
          last = (i + before / (before - twist)) * dt;
          if (crossings++ == 0) first = last;
        }
        before = twist;
      }
      EXPECT_NEAR(100 / (last - first), expected, 0.01 * expected) << locked << " " << share;
    }
}

TEST(TwoMass, KeepsItsCentreOfGravityAndItsMomentum) {
  auto p = plant(elastic(80, 0.7));
  for (int i = 0; i < 100; ++i) p.step(1000, dt);
  for (int i = 0; i < 1000; ++i) p.step(0, dt);
  // 1000 mm/s2 for 12.5 ms on the inertia 1.
  EXPECT_NEAR(0.3 * p.motor_speed() + 0.7 * p.load_speed(), 12.5, 1e-9);
}

TEST(TwoMass, AWeightDeflectsTheSpringByItsForceOverTheStiffness) {
  auto m = elastic(50, 0.6);
  m.gravity = 0.25;
  m.damping_ratio = 0.2;
  auto p = plant(m);
  for (int i = 0; i < 8000; ++i) p.step(p.holding_torque(), dt);
  // 0.25 * 4500 mm/s2 / (0.6 * (2 pi 50 Hz)^2) = 0.019 mm
  const double deflection = 0.25 * rated / (0.6 * std::pow(100 * std::numbers::pi, 2));
  EXPECT_NEAR(deflection, 0.019, 1e-4);
  EXPECT_NEAR(p.motor() - p.load(), deflection, 1e-6 * deflection);
  EXPECT_NEAR(p.motor(), 0, 1e-9) << "it was placed in its equilibrium";
}

TEST(TwoMass, TheStribeckCurveHasItsMinimumWhereViscousFrictionTakesOver) {
  MechanicsTruth m;
  m.coulomb = 0.05, m.breakaway = 0.12, m.stribeck_speed = 2;
  // With u = v / vs the derivative is zero at u0 = 3 when viscous * vs = 2 (breakaway - coulomb) u0 / (1 +
  // u0^2)^2.
  m.viscous = 2 * 0.07 * 3 / 100 / 2;
  double lowest = 1, at = 0;
  for (double v = 0.1; v < 20; v += 0.001)
    if (friction(m, v) < lowest) lowest = friction(m, v), at = v;
  EXPECT_NEAR(at, 6, 0.002);
  EXPECT_NEAR(lowest, 0.05 + 0.07 / 10 + m.viscous * 6, 1e-9);
  EXPECT_EQ(friction(m, -5), -friction(m, 5));
  EXPECT_EQ(friction(m, 0), 0);
}

// The motor is led slowly, so that only friction and backlash are between it and the load.
double lost_motion(const MechanicsTruth& m) {
  auto p = plant(m);
  double target = 0;
  const auto lead = [&](double speed, double seconds) {
    double sum = 0;
    int count = 0;
    for (double t = 0; t < seconds; t += dt) {
      target += speed * dt;
      // A stiff position loop on the motor.
      p.step(4e4 * (target - p.motor()) + 300 * (speed - p.motor_speed()), dt);
      if (t > seconds / 2) sum += p.load() - p.motor(), ++count;
    }
    return sum / count;
  };
  const double up = lead(2, 1);
  return lead(-2, 1) - up;
}

TEST(TwoMass, TheHysteresisIsTheBacklash) {
  auto m = elastic(100, 0.5);
  m.damping_ratio = 0.1;
  m.backlash = 0.02;
  m.coulomb = 1e-4;  // keeps the load on its flank
  // The spring's part: 2 * 1e-4 * 4500 / (0.5 * (2 pi 100)^2) = 4.6e-6 mm.
  EXPECT_NEAR(lost_motion(m), 0.02, 1e-5);
}

TEST(TwoMass, WithoutBacklashTheHysteresisIsTwiceTheFrictionOverTheStiffness) {
  auto m = elastic(40, 0.5);
  m.damping_ratio = 0.1;
  m.coulomb = 0.1;
  const double stiffness = 0.5 * std::pow(80 * std::numbers::pi, 2);
  EXPECT_NEAR(lost_motion(m), 2 * 0.1 * rated / stiffness, 0.01 * 2 * 0.1 * rated / stiffness);
}

TEST(TwoMass, ALoadSticksUntilTheTorqueExceedsTheBreakaway) {
  auto m = elastic(100, 0.5);
  m.damping_ratio = 0.2;
  m.coulomb = 0.05, m.breakaway = 0.1;
  const auto moved = [&](double share) {
    auto p = plant(m);
    // The torque rises slowly, so that the spring does not swing beyond it.
    for (int i = 0; i < 8000; ++i) p.step(std::min(1.0, i / 4000.0) * share * rated, dt);
    return p.load();
  };
  // A second below: the regularized friction creeps with less than 0.05 mm/s, and the spring bends 0.001 mm.
  EXPECT_LT(moved(0.09), 0.051);
  EXPECT_GT(moved(0.12), 10);
}

TEST(TwoMass, TheScrewLeadsTheLoadByItsError) {
  auto m = elastic(100, 0.5);
  m.damping_ratio = 0.1;
  m.screw.terms.harmonics.push_back({10, 0.003, 0});
  TwoMass p;
  p.configure(m, 1, rated);
  p.place(2.5);
  EXPECT_NEAR(p.load(), 2.503, 1e-12);
  for (int i = 0; i < 100; ++i) p.step(0, dt);
  EXPECT_NEAR(p.load(), 2.503, 1e-9) << "it is at rest there";
}

TEST(TwoMass, CoggingPullsAtItsPeriod) {
  auto m = elastic(100, 0.5);
  m.cogging = 0.02, m.cogging_period = 8, m.cogging_phase = 90;
  auto p = plant(m);
  p.step(0, dt);
  EXPECT_NEAR(p.motor_speed(), 0.02 * rated / 0.5 * dt, 1e-12);
}

}  // namespace
}  // namespace trunnion::truth
