// SPDX-License-Identifier: Apache-2.0
#include "spindle_synchronization.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trunnion::drive::spindle_synchronization_test {
namespace {

using idl::plc::IntegralAction;

constexpr double period = 0.001;
constexpr double period_speed = 20000 / 6.0 * period;  // 1/min: 20000 deg/s2 are 3333.3 1/min in a second
constexpr auto none = IntegralAction::INTEGRAL_NONE;
constexpr auto active = IntegralAction::INTEGRAL_ACTIVE;
constexpr auto frozen = IntegralAction::INTEGRAL_FROZEN;

// A speed loop with a lag of first order (backward Euler). Its speed is `gain` of what is asked for.
struct Motor {
  void step(double reference) {
    speed += (gain * reference - speed) * period / (lag + period);
    angle += speed / 60 * period;
  }
  double lag = 0.06, gain = 1, speed = 0, angle = 0;
};

// K0 = 500 1/min/rev, Ti = 500 ms, a window of 1 deg, 20000 deg/s2.
SynchronizationSettings settings() {
  SynchronizationSettings s;
  s.ramp.acceleration = 20000;
  return s;
}

struct Pair {
  explicit Pair(const SynchronizationSettings& s = settings()) {
    control.configure(s, period);
    control.begin(0);
  }
  /// The reference of the master goes to `speed` by a ramp of the spindles' acceleration.
  void run(int periods, double speed) {
    for (int i = 0; i < periods; ++i) {
      reference += std::clamp(speed - reference, -period_speed, period_speed);
      const double before = control.reference();
      const double given =
          control.step(order, {reference, master.speed, master.angle}, {slave.speed, slave.angle});
      steepest = std::max(steepest, std::abs(given - before));
      master.step(reference);
      slave.step(given);
      lost += control.take_lost() ? 1 : 0;
    }
  }
  /// deg from the place at the master, at the nearest turn.
  double beside() const {
    const double sign = order.reverse ? -1 : 1;
    return 360 * std::remainder(slave.angle - sign * (master.angle + order.angle), 1.0);
  }

  SpindleSynchronization control;
  SynchronizationOrder order;
  Motor master, slave;
  double reference = 0, steepest = 0;
  int lost = 0;
};

TEST(SpindleSynchronization, TheTimeConstantOfTheSpeedLoopGrowsAsTheTorqueFalls) {
  auto s = settings();
  s.ramp.base_speed = 1500, s.ramp.power_speed = 4000;
  // 1 / (2 K0) with K0 = 500 / 60 1/s; then N / 1500; then N^2 / (1500 * 4000).
  EXPECT_NEAR(speed_loop_lag(s, 100), 0.06, 1e-12);
  EXPECT_NEAR(speed_loop_lag(s, 1500), 0.06, 1e-12);
  EXPECT_NEAR(speed_loop_lag(s, -2000), 0.08, 1e-12);
  EXPECT_NEAR(speed_loop_lag(s, 4000), 0.16, 1e-12);
  EXPECT_NEAR(speed_loop_lag(s, 5000), 0.25, 1e-12);
  s.ramp.base_speed = 0;
  EXPECT_NEAR(speed_loop_lag(s, 5000), 0.06, 1e-12) << "not known";
}

// An error of 0.001 rev comes at once, at 4000 1/min: Tbv / Tbv0 = 8 / 3 of it go through at once, the rest
// through a delay of 60 ms, of which a period passes 1 / 61.
TEST(SpindleSynchronization, ThePhaseLeadGivesAtOnceWhatTheSpeedLoopDelays) {
  auto s = settings();
  s.ramp.base_speed = 1500, s.ramp.power_speed = 4000, s.ramp.acceleration = 1e9;
  for (const double lead : {0.0, 1.0}) {
    s.phase_lead = lead;
    Pair pair(s);
    pair.master.speed = pair.slave.speed = pair.reference = 4000;
    pair.master.lag = pair.slave.lag = 0;
    pair.run(3, 4000);
    ASSERT_NEAR(pair.control.error(), 0, 1e-12);
    pair.slave.angle -= 0.001;
    pair.run(1, 4000);
    const double at_once = lead > 0 ? 8 / 3.0 : 1;
    EXPECT_NEAR(pair.control.reference() - 4000, 500 * 0.001 * (at_once + (1 - at_once) / 61), 1e-9);
  }
}

// The slave turns 0.1 % slower than its reference: it needs 2000 / 0.999 - 2000 = 2.002 1/min more, which
// 500 1/min for each rev are at 0.004004 rev, 1.44 deg.
TEST(SpindleSynchronization, TheIntegralActionTakesTheErrorOfASlowSlaveAndKeepsItsCorrectionWhenFrozen) {
  const double missing = 2000 / 0.999 - 2000;
  Pair pair;
  pair.slave.gain = 0.999;
  pair.run(6000, 2000);
  EXPECT_NEAR(pair.control.error(), missing / 500, 1e-6);
  EXPECT_NEAR(pair.beside(), -1.4414, 1e-3);
  EXPECT_FALSE(pair.control.synchronized()) << "1.44 deg are more than 1 deg";

  pair.order.integral = active;
  pair.run(5000, 2000);
  EXPECT_NEAR(pair.control.error(), 0, 1e-6);
  EXPECT_NEAR(pair.control.correction(), missing, 1e-3);
  EXPECT_TRUE(pair.control.synchronized());

  pair.order.integral = frozen;
  const double kept = pair.control.correction();
  pair.run(2000, 2000);
  EXPECT_EQ(pair.control.correction(), kept);
  EXPECT_NEAR(pair.control.error(), 0, 1e-6);
  pair.run(3000, 1000);
  EXPECT_EQ(pair.control.correction(), kept) << "at another speed, too";
  EXPECT_NEAR(pair.control.error(), (missing / 2 - kept) / 500, 1e-6) << "half of it is needed there";

  pair.order.integral = none;
  pair.run(3000, 1000);
  EXPECT_EQ(pair.control.correction(), 0);
  EXPECT_NEAR(pair.control.error(), missing / 2 / 500, 1e-6);
  EXPECT_EQ(pair.lost, 0);
}

TEST(SpindleSynchronization, ReverseWithAnAngleTurnsTheOtherWayRoundAtTheMirroredAngle) {
  Pair pair;
  pair.order = {true, 0.25, active};
  pair.run(5000, 600);
  EXPECT_TRUE(pair.control.synchronized());
  EXPECT_NEAR(pair.slave.speed, -600, 1e-3);
  // slave = -(master + 90 deg): their sum is -90 deg.
  EXPECT_NEAR(360 * std::remainder(pair.slave.angle + pair.master.angle + 0.25, 1.0), 0, 1e-3);
  pair.run(5000, -600);
  EXPECT_TRUE(pair.control.synchronized()) << "the master has changed its direction";
  EXPECT_NEAR(pair.slave.speed, 600, 1e-3);
  EXPECT_NEAR(pair.beside(), 0, 1e-3);
  EXPECT_EQ(pair.lost, 0);
}

TEST(SpindleSynchronization, BothSpindlesStayTogetherWhileTheMasterSpeedsUpAndSlowsDown) {
  Pair pair;
  pair.run(1, 0);
  ASSERT_TRUE(pair.control.synchronized()) << "at rest at the same angle";
  for (const double speed : {2000.0, -2000.0, 0.0})
    for (int i = 0; i < 2000; ++i) {
      pair.run(1, speed);
      ASSERT_TRUE(pair.control.synchronized()) << "at " << pair.reference << " 1/min";
    }
}

// The master turns already. The slave rises by 3.33 1/min in a period; both parts of its reference may
// change by that much once the loop is closed.
TEST(SpindleSynchronization, ASlaveAtRestIsBroughtToTheSpeedOfItsMasterAndToTheNearestTurnWithoutAStep) {
  for (const double from : {0.05, 0.3, 0.49, 0.51, 0.8}) {
    Pair pair;
    pair.master.speed = pair.reference = 2000;
    pair.master.angle = from;
    pair.run(300, 2000);
    EXPECT_NEAR(pair.control.reference(), 300 * period_speed, 1e-6);
    EXPECT_LE(std::abs(pair.control.error()), 0.5) << "the nearest turn";
    EXPECT_FALSE(pair.control.synchronized());
    pair.order.integral = active;
    pair.run(5000, 2000);
    EXPECT_TRUE(pair.control.synchronized());
    EXPECT_NEAR(pair.beside(), 0, 0.01);
    EXPECT_LE(pair.steepest, period_speed + 1e-6) << "the master's reference is constant";
    EXPECT_EQ(pair.lost, 0);
  }
}

TEST(SpindleSynchronization, BeginsWithoutAStepAtTheSpeedTheSlaveHas) {
  Pair pair;
  pair.master.speed = pair.slave.speed = pair.reference = 2000;
  pair.slave.angle = 0.4;
  pair.control.begin(2000);
  pair.run(1, 2000);
  EXPECT_EQ(pair.control.reference(), 2000);
  pair.steepest = 0;
  pair.run(2000, 2000);
  EXPECT_LE(pair.steepest, period_speed + 1e-6);
}

// 2 deg are outside a window of 1 deg, and the loop takes them away again; 0.6 rev are more than half a turn,
// and the slave makes up for the whole of them: a part may hold both.
TEST(SpindleSynchronization, LeavesItsWindowAndComesBackAndIsLostBeyondHalfATurn) {
  Pair pair;
  pair.order.integral = active;
  pair.run(3000, 600);
  ASSERT_TRUE(pair.control.synchronized());
  pair.slave.angle += 2 / 360.0;
  pair.run(1, 600);
  EXPECT_FALSE(pair.control.synchronized());
  EXPECT_NEAR(pair.control.error(), -2 / 360.0, 1e-4);
  pair.run(3000, 600);
  EXPECT_TRUE(pair.control.synchronized());
  EXPECT_EQ(pair.lost, 0);

  pair.slave.angle += 0.6;
  const double turns = pair.slave.angle - pair.master.angle;
  pair.run(1, 600);
  EXPECT_EQ(pair.lost, 1);
  EXPECT_NEAR(pair.control.error(), -0.6, 1e-3);
  pair.run(5000, 600);
  EXPECT_EQ(pair.lost, 1) << "said once";
  EXPECT_TRUE(pair.control.synchronized());
  EXPECT_NEAR(pair.slave.angle - pair.master.angle, turns - 0.6, 0.01);
}

// It stands while its master turns with 600 1/min: 0.01 rev in a period. Up to a quarter of a turn, for
// 25 periods, the integral action gets at most 500 * 0.125 rev * 25 ms / 500 ms = 3.1 1/min more.
TEST(SpindleSynchronization, ABlockedSlaveIsLostAndTheIntegralActionWaits) {
  Pair pair;
  pair.order.integral = active;
  pair.run(3000, 600);
  const double before = pair.control.correction();
  pair.slave.lag = 0, pair.slave.gain = 0;
  pair.run(1000, 600);
  EXPECT_EQ(pair.lost, 1);
  EXPECT_NEAR(pair.control.error(), 10, 0.1);
  EXPECT_LT(pair.control.correction(), before + 3.5);
}

TEST(SpindleSynchronization, TakesAnotherAngleByTheShorterWay) {
  Pair pair;
  pair.run(3000, 600);
  const double distance = pair.slave.angle - pair.master.angle;
  pair.order.angle = 0.75;
  pair.run(4000, 600);
  EXPECT_TRUE(pair.control.synchronized());
  EXPECT_NEAR(pair.slave.angle - pair.master.angle, distance - 0.25, 0.01);
  EXPECT_EQ(pair.lost, 0) << "it was ordered";
}

// Ti = 500 ms on a speed loop of 60 ms: the angle overshoots once, the loop does not oscillate. At 2000 1/min
// the loop has 80 ms, and it swings back again unless the phase lead takes these away.
TEST(SpindleSynchronization, OvershootsWithoutOscillationAndThePhaseLeadDampsTheSlowerLoop) {
  const auto swings = [](double lag, double lead) {
    auto s = settings();
    s.ramp.base_speed = 1500, s.ramp.power_speed = 4000;
    s.phase_lead = lead;
    Pair pair(s);
    pair.master.lag = pair.slave.lag = lag;
    pair.order.integral = active;
    pair.run(3000, 2000);
    pair.order.angle = 10 / 360.0;
    std::vector<double> extremes;  // deg, farther from 0 than a thousandth of the step
    double before = 10, slope = -1;
    for (int i = 0; i < 4000; ++i) {
      pair.run(1, 2000);
      const double error = 360 * pair.control.error();
      if ((error - before) * slope < 0 && std::abs(before) > 0.01 && i > 0) extremes.push_back(before);
      if (error != before) slope = error - before;
      before = error;
    }
    EXPECT_NEAR(before, 0, 1e-3);
    return extremes;
  };
  const auto steady = swings(0.06, 0);
  ASSERT_EQ(steady.size(), 1u);
  EXPECT_LT(steady[0], -1);
  EXPECT_GT(steady[0], -4);
  const auto slow = swings(0.08, 0), lead = swings(0.08, 1.2);
  EXPECT_GT(slow.size(), 1u);
  ASSERT_EQ(lead.size(), 1u);
  EXPECT_GT(lead[0], slow[0]) << "and it overshoots less";
}

TEST(SpindleSynchronization, WithSmallAccelerationALargeErrorIsTakenAwayWithoutOvershoot) {
  auto s = settings();
  s.gain = 3000;               // 50 1/s: half a turn would be 1500 1/min at once
  s.ramp.acceleration = 1800;  // 300 1/min in a second
  Pair pair(s);
  pair.master.lag = pair.slave.lag = 0;
  pair.master.angle = 0.45;
  double farthest = 0;
  for (int i = 0; i < 5000; ++i) {
    pair.run(1, 0);
    farthest = std::max(farthest, pair.slave.angle);
  }
  EXPECT_NEAR(pair.slave.angle, 0.45, 1e-3);
  EXPECT_LT(farthest, 0.46);
}

}  // namespace
}  // namespace trunnion::drive::spindle_synchronization_test
