// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "trace.hpp"

namespace trunnion::servo_analysis {
namespace {

double torque(const FrictionModel& m, double v) {
  const double s = v > 0 ? 1 : -1;
  return s * (m.coulomb + (m.breakaway - m.coulomb) / (1 + std::pow(v / m.stribeck_speed, 2)) +
              m.viscous * std::abs(v)) +
         m.gravity;
}

TEST(Friction, IsFoundInTheTorqueAtConstantSpeeds) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  for (int machine = 0; machine < 50; ++machine) {
    FrictionModel m;
    m.coulomb = 0.02 + 0.05 * part(random);
    m.breakaway = m.coulomb * (1.3 + part(random));
    m.stribeck_speed = 0.5 + 3 * part(random);
    m.viscous = 2e-4 * part(random);
    m.gravity = 0.3 * (part(random) - 0.5);
    std::vector<FrictionPoint> points;
    for (const double v : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
      for (const double s : {1.0, -1.0}) points.push_back({s * v, torque(m, s * v)});
    const auto f = identify_friction(points);
    EXPECT_NEAR(f.coulomb, m.coulomb, 1e-3 * m.coulomb);
    EXPECT_NEAR(f.breakaway, m.breakaway, 1e-3 * m.breakaway);
    EXPECT_NEAR(f.stribeck_speed, m.stribeck_speed, 0.01 * m.stribeck_speed);
    EXPECT_NEAR(f.viscous, m.viscous, 1e-6);
    EXPECT_NEAR(f.gravity, m.gravity, 1e-6);
  }
}

TEST(Friction, WithoutAStribeckEffectNoneIsInvented) {
  std::vector<FrictionPoint> points;
  for (const double v : {1.0, 5.0, 10.0, 50.0})
    for (const double s : {1.0, -1.0}) points.push_back({s * v, s * (0.03 + 1e-4 * v)});
  const auto f = identify_friction(points);
  EXPECT_EQ(f.stribeck_speed, 0);
  EXPECT_NEAR(f.coulomb, 0.03, 1e-9);
  EXPECT_NEAR(f.breakaway, 0.03, 1e-9);
}

TEST(Friction, NeedsBothDirectionsAndTwoSpeeds) {
  EXPECT_THROW(identify_friction({{1, 0.1}, {2, 0.1}}), std::runtime_error);
  EXPECT_THROW(identify_friction({{1, 0.1}, {-1, -0.1}}), std::runtime_error);
}

TEST(Inertia, IsTheTorqueOverTheAcceleration) {
  AxisTrace t;
  t.interval = 0.001;
  // A sine of 20 mm/s and 5 rad/s: torque = J a + friction + weight.
  const double J = 1.7e-4;
  for (int i = 0; i < 5000; ++i) {
    const double s = i * 0.001, v = 20 * std::sin(5 * s), a = 100 * std::cos(5 * s);
    add(t, 0, 0, v, J * a + (v > 0 ? 0.03 : -0.03) + 1e-4 * v + 0.1);
  }
  EXPECT_NEAR(identify_inertia(t), J, 0.01 * J);
}

TEST(Inertia, AMotionWithoutAccelerationIsRefused) {
  AxisTrace t;
  for (int i = 0; i < 100; ++i) add(t, 0, 0, 0, 0.1);
  EXPECT_THROW(identify_inertia(t), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::servo_analysis
