// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "simulated_spindle.hpp"
#include "spindle_coupling.hpp"

namespace trunnion::drive {
namespace {

// A spindle and what gives it its setpoints: 60000 deg/s2 are 10000 1/min in a second, 10 1/min in a period
// of 1 ms.
struct Spindle {
  Spindle() { machine.configure(60000, 0.001); }
  void demand(double speed) { coupling.demand_speed(speed); }
  void couple(double revolutions) { coupling.couple(revolutions, machine.angle()); }
  void lead(double phase, double next) { coupling.lead(phase, next); }
  void release() { coupling.release(); }
  void step(bool powered) { machine.step(coupling.setpoint(), powered); }
  double speed() const { return machine.speed(); }
  double angle() const { return machine.angle(); }
  SimulatedSpindle machine;
  SpindleCoupling coupling;
};

Spindle spindle() { return {}; }

TEST(Spindle, ReachesTheDemandedSpeedWithinItsAccelerationAndRunsDownWithoutPower) {
  auto s = spindle();
  s.demand(-500);
  for (int i = 0; i < 49; ++i) s.step(true);
  EXPECT_NEAR(s.speed(), -490, 1e-9);
  for (int i = 0; i < 10; ++i) s.step(true);
  EXPECT_EQ(s.speed(), -500);
  for (int i = 0; i < 25; ++i) s.step(false);
  EXPECT_NEAR(s.speed(), -250, 1e-9);
}

TEST(Spindle, FollowsAnAngleFromItsPlaceAndStaysThereWhenReleased) {
  auto s = spindle();
  s.demand(60);
  for (int i = 0; i < 1000; ++i) s.step(true);
  s.demand(0);
  for (int i = 0; i < 10; ++i) s.step(true);
  const double from = s.angle();
  // Two turns in a second and back, 1 - cos: at most 2 pi^2 2 rev/s2 = 14213 deg/s2.
  const auto turns = [](int i) { return 1 - std::cos(2 * M_PI * i / 1000.0); };
  for (int i = 0; i <= 1000; ++i) {
    s.couple(turns(i));
    s.step(true);
    ASSERT_NEAR(s.angle() - from, turns(i), 1e-9) << i;
  }
  s.release();
  const double end = s.angle();
  for (int i = 0; i < 10; ++i) s.step(true);
  EXPECT_NEAR(s.angle(), end, 1e-3);
}

TEST(Spindle, BetweenTwoSetpointsItIsInProportionAsTheAxesAre) {
  auto s = spindle();
  s.couple(0);
  s.step(true);
  const double from = s.angle();
  s.lead(0.25, 0.0004);
  s.step(true);
  EXPECT_NEAR(s.angle() - from, 0.0001, 1e-12);
}

}  // namespace
}  // namespace trunnion::drive
