// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bus/json.hpp"
#include "simulated_spindle.hpp"
#include "snapshot/fields.hpp"
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

/// A coupled spindle whose following error is limited to 2 deg; 0.01 rev in a period are 3.6 deg.
struct Supervised {
  Supervised() {
    coupling.configure(2);
    EXPECT_FALSE(period(0, 0));
  }
  /// The path goes on by `step` rev, and the spindle is at `angle` at the end of the period.
  bool period(double step, double angle, bool whole = true) {
    turned += step;
    coupling.couple(turned, 0);
    ++number;
    return coupling.does_not_follow(number, number, angle, whole);
  }
  SpindleCoupling coupling;
  std::uint64_t number = 0;
  double turned = 0;
};

TEST(Spindle, MayBeOnItsPathThreePeriodsLateAndBesideItByItsLimit) {
  Supervised s;
  for (int i = 0; i < 10; ++i)
    EXPECT_FALSE(s.period(0.01, std::max(0.0, s.turned - 0.02))) << "three periods of 0.01";
  EXPECT_FALSE(s.period(0.01, s.turned - 0.02 - 0.005)) << "1.8 deg more";
  // From then on it stands at 0.075: its path is at 0.12, and was at 0.09 three periods before.
  EXPECT_TRUE(s.period(0.01, 0.075));
  EXPECT_NEAR(s.coupling.following_error(), 5.4, 1e-9);
  EXPECT_FALSE(s.period(0.01, 0.075)) << "once";
  EXPECT_FALSE(s.period(0.01, s.turned + 0.01)) << "it follows again";
  EXPECT_TRUE(s.period(0, s.turned + 0.006)) << "2.16 deg before its path";
  EXPECT_NEAR(s.coupling.following_error(), -2.16, 1e-9);
}

// 1000 1/min are 6 deg in a period.
TEST(Spindle, ATurningSpindleThatIsCoupledIsNotOnItsPath) {
  Supervised s;
  EXPECT_TRUE(s.period(0, 1.0 / 60));
  s.coupling.release();
  EXPECT_FALSE(s.coupling.does_not_follow(3, 3, 0.5, true)) << "it follows nothing any longer";
  EXPECT_EQ(s.coupling.following_error(), 0);
  Supervised without;
  without.coupling.configure(0);
  EXPECT_FALSE(without.period(0, 0.5));
}

TEST(Spindle, HasTimeToComeBackBehindAStopOnThePath) {
  Supervised s;
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(s.period(0.01, 0, false));
  for (int i = 0; i < 249; ++i) ASSERT_FALSE(s.period(0, 0)) << i;
  const auto state = snapshot::written(s.coupling);
  SpindleCoupling other;
  other.configure(2);
  snapshot::read(bus::Json::parse(bus::text_of(state)), other);
  EXPECT_EQ(snapshot::written(other), state);
  EXPECT_TRUE(other.does_not_follow(1000, 1000, 0, true)) << "another process continues there";
  EXPECT_TRUE(s.period(0, 0)) << "250 periods";
  EXPECT_FALSE(s.period(0, s.turned));
  EXPECT_FALSE(snapshot::written(s.coupling).contains("returning"));
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
