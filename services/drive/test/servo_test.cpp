// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "servo_axis.hpp"

namespace trunnion::drive {
namespace {

// An axis with the feed-forward that the executor gives it.
struct Axis : ServoAxis {
  void step(double position, double dt) {
    const double velocity = (position - setpoint.position) / dt;
    setpoint = {position, velocity, (velocity - setpoint.velocity) / dt};
    ServoAxis::step(setpoint, dt);
  }
  AxisSetpoint setpoint;
};

Axis axis(ServoParameters p = {}) {
  Axis a;
  a.configure(p);
  a.place(0);
  return a;
}

TEST(Servo, WithoutFeedforwardTheFollowingErrorIsSpeedOverKv) {
  ServoParameters p;
  p.velocity_feedforward = p.acceleration_feedforward = 0;
  auto a = axis(p);
  const double v = 1000.0 / 60;  // mm/s
  double x = 0;
  for (int i = 0; i < 2000; ++i) a.step(x += v * 0.001, 0.001);
  EXPECT_NEAR(a.command() - a.encoder(), v / 60, 2 * p.resolution);
}

TEST(Servo, WithFeedforwardAConstantSpeedHasNoFollowingError) {
  auto a = axis();
  double x = 0;
  for (int i = 0; i < 2000; ++i) a.step(x += 100 * 0.001, 0.001);
  EXPECT_NEAR(a.command() - a.encoder(), 0, 2 * ServoParameters{}.resolution);
}

// Of two axes on a circle the feed-forward leaves only what the current loop is late by.
TEST(Servo, WithFeedforwardACircleHasItsRadius) {
  constexpr double radius = 25, speed = 50, dt = 0.001;
  auto x = axis(), y = axis();
  double sum = 0, most = 0;
  int count = 0;
  for (int i = 0; i < 6000; ++i) {
    // The angular speed rises over a second.
    const double t = i * dt, angle = speed / radius * (t < 1 ? t * t / 2 : t - 0.5);
    x.step(radius * std::sin(angle), dt);
    y.step(radius * (1 - std::cos(angle)), dt);
    if (t < 2) continue;
    const double error = std::hypot(x.encoder(), y.encoder() - radius) - radius;
    sum += error, most = std::max(most, std::abs(error)), ++count;
  }
  // Half a period of lag of the acceleration and 0.4 ms of the current loop, in the direction of motion: the
  // radius keeps a part of second order, (w * 0.9 ms)^2 / 2 * v / (Kv * w) < 0.001 um; the resolution is 0.01
  // um.
  EXPECT_NEAR(sum / count, 0, 1e-5);
  EXPECT_LT(most, 5e-5);
}

TEST(Servo, StandsStillWithoutAnErrorOnceTheIntegratorHasBeatenFriction) {
  ServoParameters p;
  p.coulomb = 0.05;
  auto a = axis(p);
  for (int i = 1; i <= 3000; ++i) a.step(std::min(10.0, i * 0.02), 0.001);
  EXPECT_NEAR(a.encoder(), 10, 2e-4);
  EXPECT_NEAR(a.velocity(), 0, 1e-2);
}

TEST(Servo, TheTorqueNeverExceedsThePeak) {
  auto a = axis();
  for (int i = 0; i < 200; ++i) {
    a.step(i < 100 ? 5 : -5, 0.001);
    EXPECT_LE(std::abs(a.torque()), 9000.0 / 4500 + 1e-9);
  }
}

TEST(Servo, BacklashIsLostAtTheReversalAndOnlyThere) {
  ServoParameters p;
  p.backlash = 0.02;
  auto a = axis(p);
  double x = 0, farthest = 0;
  const auto move = [&](double step) {
    for (int i = 0; i < 2000; ++i) {
      a.step(x += i < 1000 ? step : 0, 0.001);
      farthest = step > 0 ? std::max(farthest, a.encoder()) : std::min(farthest, a.encoder());
    }
  };
  // The motor drags the load half the backlash behind it to the farthest point it has been at.
  move(0.0005);
  EXPECT_NEAR(a.load(), farthest - 0.01, 2 * p.resolution);
  farthest = x;
  move(-0.0005);
  EXPECT_NEAR(a.load(), farthest + 0.01, 2 * p.resolution);
  // And it stands where the motor left it, as long as the motor moves less than the backlash.
  const double load = a.load();
  move(0.00001);  // 0.01 mm forth
  EXPECT_EQ(a.load(), load);
}

TEST(Servo, MoreLoadInertiaOvershootsMore) {
  const auto overshoot = [](double inertia) {
    ServoParameters p;
    p.inertia = inertia;
    auto a = axis(p);
    double most = 0;
    for (int i = 1; i <= 1000; ++i) {
      a.step(std::min(1.0, i * 0.02), 0.001);
      most = std::max(most, a.encoder() - 1);
    }
    return most;
  };
  EXPECT_GT(overshoot(4), overshoot(1));
}

}  // namespace
}  // namespace trunnion::drive
