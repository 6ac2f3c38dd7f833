#include <gtest/gtest.h>

#include <cmath>

#include "servo_axis.hpp"

namespace trunnion::drive {
namespace {

ServoAxis axis(ServoParameters p = {}) {
  ServoAxis a;
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
  // e = v / Kv = 16.67 / 60 = 0.2778 mm
  // The loop is closed every eighth of a period, which shortens the lag by a few tenths of a percent.
  EXPECT_NEAR(a.command() - a.encoder(), v / 60, 0.005 * v / 60);
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
  double x = 0;
  for (int i = 0; i < 1000; ++i) a.step(x += 0.0005, 0.001);
  for (int i = 0; i < 1000; ++i) a.step(x, 0.001);
  EXPECT_NEAR(a.load(), x - 0.01, 1e-3);
  for (int i = 0; i < 1000; ++i) a.step(x -= 0.0005, 0.001);
  for (int i = 0; i < 1000; ++i) a.step(x, 0.001);
  EXPECT_NEAR(a.load(), x + 0.01, 1e-3);
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
