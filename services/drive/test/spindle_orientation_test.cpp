// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "simulated_spindle.hpp"
#include "snapshot/fields.hpp"
#include "spindle_orientation.hpp"

namespace trunnion::drive {
namespace {

// 60000 deg/s2 are 10000 1/min in a second, 10 1/min in a period of 1 ms.
constexpr double acceleration = 60000, period = 0.001, period_speed = 10;

struct Oriented {
  explicit Oriented(double angle, double speed = 100) {
    machine.configure(acceleration, period);
    orientation.configure({angle, 0.1, speed, acceleration}, period);
  }
  SpindleStatus status() const { return machine.status(); }
  void step(double speed, bool controlled = true) {
    machine.step(orientation.step({speed, false, 0}, status(), controlled), controlled);
  }
  /// Periods until it is oriented; the largest change of speed in one of them stays in `steepest`.
  int run(double speed, int most = 10000) {
    for (int i = 1; i <= most; ++i) {
      const double before = machine.speed();
      step(speed);
      steepest = std::max(steepest, std::abs(machine.speed() - before));
      if (orientation.oriented(status())) return i;
    }
    return -1;
  }
  /// deg from the demanded angle, -180 .. 180.
  double deviation(double angle) const { return 360 * std::remainder(machine.angle() - angle / 360, 1.0); }

  SimulatedSpindle machine;
  SpindleOrientation orientation;
  double steepest = 0;
};

TEST(SpindleOrientation, EndsAtItsAngleFromEverySpeedInTheDirectionOfRotationWithinTheAcceleration) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> angles(0, 360), speeds(-8000, 8000);
  for (int sample = 0; sample < 200; ++sample) {
    const double angle = angles(random), speed = speeds(random);
    Oriented s(angle);
    for (int i = 0; i < 1000; ++i) s.step(speed);
    ASSERT_NEAR(s.machine.speed(), speed, 1e-9);
    s.orientation.demand(true);
    const double from = s.machine.angle();
    ASSERT_GT(s.run(speed), 0) << angle << " deg from " << speed << " 1/min";
    EXPECT_NEAR(s.deviation(angle), 0, 0.1);
    EXPECT_LE(s.steepest, period_speed + 1e-6) << "not harder than its acceleration";
    EXPECT_GT((s.machine.angle() - from) * speed, 0) << "it does not turn back";
    for (int i = 0; i < 100; ++i) s.step(speed);
    EXPECT_NEAR(s.deviation(angle), 0, 1e-6) << "it is held there";
  }
}

// At rest at 0. 100 1/min are 0.6 deg/ms; with 0.9 of 60000 deg/s2 it takes 11 ms and 3.3 deg to reach them.
TEST(SpindleOrientation, AtRestTakesTheShorterWay) {
  for (const double angle : {90.0, 270.0}) {
    Oriented s(angle);
    s.orientation.demand(true);
    const int periods = s.run(0);
    EXPECT_NEAR(s.machine.angle(), angle < 180 ? 0.25 : -0.25, 0.1 / 360);
    EXPECT_NEAR(periods, 90 / 0.6 + 11, 3);
  }
}

TEST(SpindleOrientation, IsNotFinishedWhileItTurnsAndEndsWithItsDemand) {
  Oriented s(10);
  for (int i = 0; i < 200; ++i) s.step(1000);
  EXPECT_FALSE(s.orientation.oriented(s.status()));
  s.orientation.demand(true);
  for (int i = 0; i < 50; ++i) {
    s.step(1000);
    if (std::abs(s.machine.speed()) > 100) {
      EXPECT_FALSE(s.orientation.oriented(s.status()));
    }
  }
  ASSERT_GT(s.run(1000), 0);
  s.orientation.demand(false);
  for (int i = 0; i < 200; ++i) s.step(1000);
  EXPECT_NEAR(s.machine.speed(), 1000, 1e-9);
  EXPECT_FALSE(s.orientation.oriented(s.status()));
}

TEST(SpindleOrientation, WithoutPowerItRunsDownAndBeginsAnewAfterwards) {
  Oriented s(200);
  for (int i = 0; i < 200; ++i) s.step(1000);
  s.orientation.demand(true);
  for (int i = 0; i < 20; ++i) s.step(1000);
  for (int i = 0; i < 500; ++i) s.step(1000, false);
  EXPECT_EQ(s.machine.speed(), 0);
  EXPECT_FALSE(s.orientation.oriented(s.status()));
  ASSERT_GT(s.run(1000), 0);
  EXPECT_NEAR(s.deviation(200), 0, 0.1);
}

TEST(SpindleOrientation, LeavesASpindleThatFollowsTheStreamAlone) {
  Oriented s(90);
  s.orientation.demand(true);
  const auto setpoint = s.orientation.step({500, true, 0.3}, s.status(), true);
  EXPECT_TRUE(setpoint.coupled);
  EXPECT_EQ(setpoint.angle, 0.3);
  EXPECT_FALSE(s.orientation.oriented(s.status()));
}

// J dw/dt = M0 (1 - w / w0) has the solution w = w0 (1 - exp(-t / T)), T = J w0 / M0. With 0.05 kg m2, 50 Nm
// and 10000 1/min T is 1.0472 s. Steps of 1 ms are half a step off: 0.0005 / 1.05 of the speed.
TEST(SimulatedSpindle, SpeedsUpAsTheTorqueOfItsCurveAndItsInertiaPermit) {
  const truth::SpindleTruth truth{0.05, {{0, 50}, {10000, 1e-6}}};
  SimulatedSpindle spindle;
  spindle.configure(acceleration, period, &truth);
  const double time_constant = 0.05 * (10000 / 60.0 * 2 * std::numbers::pi) / 50;
  for (int i = 1; i <= 3000; ++i) {
    spindle.step({20000, false, 0}, true);
    if (i % 500 == 0) {
      EXPECT_NEAR(spindle.speed(), 10000 * (1 - std::exp(-i * period / time_constant)), 5) << i;
    }
  }
}

// 5 Nm and 0.05 kg m2 give 955 1/min in a second: less than a tenth of its acceleration.
TEST(SimulatedSpindle, AWeakMotorFollowsAnAngleLaterAndEndsThereWithoutTurningBack) {
  const truth::SpindleTruth truth{0.05, {{0, 5}}};
  SimulatedSpindle spindle;
  spindle.configure(acceleration, period, &truth);
  // 300 1/min (0.005 rev in a period) for 2 s with ramps of 0.5 s, which are within the torque; then 1 rev at
  // once, which is not.
  double angle = 0, speed = 0, lag = 0;
  const auto follow = [&] {
    angle += speed;
    spindle.step({0, true, angle}, true);
    lag = std::max(lag, std::abs(spindle.angle() - angle));
  };
  for (int i = 0; i < 500; ++i) speed += 1e-5, follow();
  for (int i = 0; i < 1000; ++i) follow();
  for (int i = 0; i < 500; ++i) speed -= 1e-5, follow();
  EXPECT_LT(lag, 1e-9) << "600 1/min in a second are within its torque";
  speed = 0, angle += 1;
  double farthest = 0;
  int periods = 0;
  for (; std::abs(spindle.angle() - angle) > 1e-9 && periods < 3000; ++periods) {
    follow();
    farthest = std::max(farthest, spindle.angle() - angle);
  }
  EXPECT_LT(farthest, 1e-3);
  // Half a rev of acceleration and half of braking with 15.9 rev/s2 take 2 sqrt(1 / 15.9) = 0.5 s.
  EXPECT_NEAR(periods, 502, 50);
}

TEST(SpindleOrientation, ANewAngleTurnsAHeldSpindle) {
  Oriented s(0);
  s.orientation.demand(true);
  ASSERT_GT(s.run(0), 0);
  s.orientation.configure({45, 0.1, 100, acceleration}, period);
  ASSERT_GT(s.run(0), 0);
  EXPECT_NEAR(s.deviation(45), 0, 0.1);
}

TEST(SpindleOrientation, TheOrderedAngleReplacesThatOfTheParameters) {
  Oriented s(30);
  const auto turn_to = [&](double ordered) {
    s.orientation.demand(true, ordered);
    return s.run(0) > 0 ? 360 * s.machine.angle() : -1000;
  };
  EXPECT_NEAR(turn_to(90), 90, 0.1);
  EXPECT_NEAR(turn_to(200), 200, 0.1);
  EXPECT_NEAR(s.orientation.angle(), 200, 1e-9);
  EXPECT_NEAR(turn_to(-1), 30, 0.1);
  EXPECT_NEAR(turn_to(360), 0, 0.1);
  EXPECT_NEAR(turn_to(0), 0, 0.1);
  s.orientation.demand(true, 45);
  s.orientation.configure({60, 0.1, 100, acceleration}, period);
  ASSERT_GT(s.run(0), 0);
  EXPECT_NEAR(s.deviation(45), 0, 0.1) << "also when the parameters change";
}

// The mark is 120 deg ahead, and 240 deg behind the start: to it in the direction in which the spindle turns,
// and to the next passage of 45 deg. Backwards the mark is the angle -1 rev.
TEST(SpindleOrientation, ASpindleThatIsNotHomedTurnsUntilItsMarkHasPassed) {
  truth::SpindleTruth truth;
  truth.mark = 120;
  const double cases[][2] = {{0, 0.125}, {200, 0.125}, {-200, -1.875}};
  for (const auto& [speed, expected] : cases) {
    Oriented s(45);
    s.machine = {};
    s.machine.configure(acceleration, period, &truth);
    for (int i = 0; i < 20; ++i) s.step(speed);
    ASSERT_FALSE(s.status().homed);
    s.orientation.demand(true);
    ASSERT_GT(s.run(speed), 0) << speed;
    EXPECT_TRUE(s.status().homed);
    EXPECT_LE(s.steepest, period_speed + 1e-6);
    EXPECT_NEAR(s.machine.angle(), expected, 0.1 / 360) << speed;
  }
}

SpindleStatus standing_at(double angle) {
  SpindleStatus status;
  status.angle = angle;
  return status;
}

TEST(SpindleOrientation, IsLostOnceWhenAHeldSpindleIsOutOfItsWindowForSomePeriods) {
  SpindleOrientation orientation;
  orientation.configure({90, 0.1, 100, acceleration}, period);
  const auto lost = [&](double degrees, std::uint32_t periods) {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < periods; ++i) {
      orientation.step({}, standing_at(degrees / 360), true);
      count += orientation.lost() ? 1 : 0;
    }
    return count;
  };
  orientation.demand(true);
  EXPECT_EQ(lost(90, 3), 0u);
  EXPECT_EQ(lost(90.5, orientation_lost_periods - 1), 0u);
  EXPECT_EQ(lost(90.05, 1), 0u) << "back in time";
  EXPECT_EQ(lost(89.5, orientation_lost_periods), 1u);
  EXPECT_EQ(lost(89.5, 1000), 0u) << "once";
  EXPECT_EQ(lost(90, 1), 0u);
  EXPECT_EQ(lost(89.5, orientation_lost_periods), 1u) << "and once more";
  orientation.demand(false);
  EXPECT_EQ(lost(200, 100), 0u);
}

TEST(SpindleOrientation, IsNotLostBeforeTheSpindleHasArrived) {
  SpindleOrientation orientation;
  orientation.configure({90, 0.1, 100, acceleration}, period);
  orientation.demand(true);
  for (int i = 0; i < 3000; ++i) {
    orientation.step({}, standing_at(0), true);  // it is stuck
    ASSERT_FALSE(orientation.lost());
    ASSERT_FALSE(orientation.oriented(standing_at(0)));
  }
  orientation.step({}, standing_at(0.25), true);
  EXPECT_TRUE(orientation.oriented(standing_at(0.25)));
  for (std::uint32_t i = 0; i < orientation_lost_periods; ++i) orientation.step({}, standing_at(0.26), true);
  EXPECT_TRUE(orientation.lost());
}

// 25 s and two turns at 100 1/min, 1.2 s.
TEST(SpindleOrientation, IsLateOnceWhenTheSpindleDoesNotArrive) {
  SpindleOrientation orientation;
  orientation.configure({90, 0.1, 100, acceleration}, period);
  EXPECT_NEAR(orientation.time_limit(), 26.2, 1e-9);
  const auto late_in = [&](int periods, const SpindleStatus& status) {
    std::vector<int> late;
    for (int i = 1; i <= periods; ++i) {
      orientation.step({}, status, true);
      if (orientation.late()) late.push_back(i);
    }
    return late;
  };
  const std::vector<int> once{26200}, never;
  orientation.demand(true);
  EXPECT_EQ(late_in(60000, standing_at(0)), once) << "it is stuck";
  orientation.acknowledge();
  EXPECT_EQ(late_in(60000, standing_at(0)), once) << "it is still";
  orientation.demand(true, 180);
  EXPECT_EQ(late_in(60000, standing_at(0)), once) << "at another angle, too";
  orientation.demand(false);
  EXPECT_EQ(late_in(60000, standing_at(0)), never);
  orientation.demand(true, 90);
  SpindleStatus without_mark = standing_at(0);
  without_mark.homed = false, without_mark.speed = 100;
  EXPECT_EQ(late_in(60000, without_mark), once) << "the index mark does not pass";
  orientation.demand(false);
  orientation.step({}, standing_at(0), true);
  orientation.demand(true, 90);
  EXPECT_EQ(late_in(26199, standing_at(0)), never);
  EXPECT_EQ(late_in(60000, standing_at(0.25)), never) << "it has arrived";
}

TEST(SpindleOrientation, ContinuesWithTheTimeThatHasPassed) {
  SpindleOrientation orientation, other;
  for (auto* one : {&orientation, &other}) one->configure({90, 0.1, 100, acceleration}, period);
  orientation.demand(true);
  for (int i = 0; i < 26199; ++i) orientation.step({}, standing_at(0), true);
  snapshot::read(snapshot::written(orientation), other);
  EXPECT_FALSE(other.late());
  other.step({}, standing_at(0), true);
  EXPECT_TRUE(other.late());
}

}  // namespace
}  // namespace trunnion::drive
