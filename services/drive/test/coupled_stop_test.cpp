// SPDX-License-Identifier: Apache-2.0
// Spindles that hold one part, and everything that stops the machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/json.hpp"
#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "queued_hardware.hpp"
#include "simulated_hardware.hpp"
#include "two_axes.hpp"

namespace trunnion::drive::coupled_stop_test {
namespace {

using idl::plc::IntegralAction;
using idl::stream::SpindleCondition;

constexpr double window = 1;  // deg: 10a974

// The master S1 (axis 5) has 12000 deg/s2, 2000 1/min in a second; its slave S2 40000, 6666.7 1/min in a
// second. Their speed loops have lags of 60 and 59.5 ms.
machine::Parameters two_spindles() {
  auto p = two_axes();
  const double acceleration[] = {12000, 40000}, lag[] = {60, 59.5};
  for (std::uint32_t k = 0; k < 2; ++k) {
    const std::uint32_t axis = 105000 + k * 1000;
    p.values[axis] = {0, "S" + std::to_string(k + 1)};
    p.values[axis + 1] = {machine::axis_type_spindle, ""};
    p.values[axis + 36] = {acceleration[k], ""};
    p.values[axis + 978] = {lag[k], ""};
  }
  return p;
}

// 60 Nm give 0.2 kg m2 2864.8 and 0.05 kg m2 11459 1/min in a second: more than the ramps ask.
std::map<std::string, truth::SpindleTruth> heavy_and_light() {
  std::map<std::string, truth::SpindleTruth> truths;
  truths["S1"] = truth::SpindleTruth{0.2, {{0, 60}}};
  truths["S2"] = truth::SpindleTruth{0.05, {{0, 60}}};
  return truths;
}

idl::plc::SpindleCoupling following(IntegralAction integral = IntegralAction::INTEGRAL_ACTIVE) {
  return {1, 0, false, 0, integral};
}

// Both at 2000 1/min, with a part in both chucks: the integral action is frozen.
struct Lathe {
  explicit Lathe(bool coupled = true)
      : core(std::make_unique<SimulatedHardware>(
            std::map<std::string, truth::DriveTruth>(), std::optional<ProbeSetup>(),
            std::optional<volumetric::BeamErrors>(), heavy_and_light())) {
    core.configure(two_spindles(), true);
    core.set_enables({1, 1}, false);
    if (coupled) core.set_spindle_couplings({following()});
    core.set_spindle_speed({2000, 2000});
    for (int i = 0; i < 6000; ++i) core.step();
    if (coupled) core.set_spindle_couplings({following(IntegralAction::INTEGRAL_FROZEN)});
    core.step();
    look();
    at_first = status.spindles[0].angle - status.spindles[1].angle;
  }
  void look() {
    core.hardware().status(status);
    core.fill(feedback);
  }
  /// One period, in which the part must not be twisted by more than the window.
  void step() {
    core.step();
    look();
    most = std::max(most, std::abs(twist()));
  }
  /// As virtual time does: while the drive has something to do. Periods.
  int run_to_the_end() {
    int periods = 0;
    for (; core.can_step(false) && periods < 20000; ++periods) step();
    return periods;
  }
  /// deg
  double twist() const { return 360 * (status.spindles[0].angle - status.spindles[1].angle - at_first); }
  const idl::stream::SpindleState& slave() const { return feedback.spindles.at(1); }

  DriveCore core;
  DriveStatus status;
  idl::stream::Feedback feedback;
  double at_first = 0;  // rev
  double most = 0;      // deg
};

// The heavy one makes (2000 / 60) / 2 = 16.67 revolutions in 1 s, the light one 5 in 0.3 s.
TEST(CoupledStop, WithoutASynchronizationEachSpindleRunsDownByItself) {
  Lathe lathe(false);
  lathe.core.set_enables({1, 1}, true);
  EXPECT_FALSE(lathe.core.can_step(false));
  for (int i = 0; i < 1100; ++i) lathe.step();
  EXPECT_EQ(lathe.status.spindles[0].speed, 0);
  EXPECT_EQ(lathe.status.spindles[1].speed, 0);
  EXPECT_NEAR(lathe.twist() / 360, 16.667 - 5, 0.05);
  EXPECT_FALSE(lathe.core.explicit_state()["row"].contains("spindles_controlled"));
  EXPECT_TRUE(lathe.core.take_events().empty());
}

// On the ramp of 2000 1/min in a second the spindles are their lags behind it, and the gain of 500 1/min for
// a revolution makes up for the difference: 2000 * (0.06 - 0.0595) / 500 = 0.002 rev, 0.72 deg. The loop is
// of the second order with K0 / 60 * 0.06 = 0.5, a damping of 0.707: it overshoots by 4.3 %, 0.751 deg. At
// the end of the ramp they have 2000 * 0.06 = 120 1/min, which are 5 after 60 ms * ln(24) = 0.19 s.
TEST(CoupledStop, WhateverSwitchesTheDrivesOffBothRunDownTogether) {
  const auto emergency_stop = [](DriveCore& core) { core.set_enables({1, 1}, true); };
  const auto enables_withdrawn = [](DriveCore& core) { core.set_enables({0, 0}, false); };
  const auto loss_of_the_plc = [](DriveCore& core) { core.set_enables({}, true); };
  for (const auto& stop :
       std::vector<void (*)(DriveCore&)>{emergency_stop, enables_withdrawn, loss_of_the_plc}) {
    Lathe lathe;
    ASSERT_NEAR(lathe.status.spindles[1].speed, 2000, 0.01);
    stop(lathe.core);
    EXPECT_EQ(lathe.core.mode(), Mode::OFF);
    lathe.step();
    EXPECT_EQ(lathe.slave().master, 0);
    EXPECT_EQ(lathe.slave().condition, SpindleCondition::SPINDLE_SYNCHRONIZED);
    EXPECT_EQ(lathe.feedback.spindles[0].reference, 1998);
    EXPECT_EQ(lathe.feedback.enabled[0], 0) << "the axes";
    EXPECT_NEAR(lathe.run_to_the_end(), 1190, 30);
    EXPECT_GT(lathe.most, 0.7);
    EXPECT_LT(lathe.most, 0.76);
    EXPECT_LE(std::abs(lathe.status.spindles[0].speed), 5);
    for (int i = 0; i < 100; ++i) lathe.step();
    EXPECT_EQ(lathe.status.spindles[0].speed, 0);
    EXPECT_EQ(lathe.status.spindles[1].speed, 0);
    EXPECT_LT(std::abs(lathe.twist()), window);
    EXPECT_LT(lathe.most, window);
    EXPECT_EQ(lathe.slave().master, -1);
    EXPECT_TRUE(lathe.core.take_events().empty());
    lathe.core.set_enables({1, 1}, false);
    lathe.step();
    EXPECT_EQ(lathe.slave().master, 0) << "at rest it begins again at once";
  }
}

// A reset stops the master by the PLC, with the drives on; a reset of the alarms changes nothing.
TEST(CoupledStop, AResetStopsBothTogether) {
  Lathe lathe;
  lathe.core.set_spindle_speed({});
  for (int i = 0; i < 500; ++i) lathe.step();
  lathe.core.set_enables({1, 1}, true);
  for (int i = 0; i < 100; ++i) lathe.step();
  lathe.core.acknowledge();
  EXPECT_GT(lathe.run_to_the_end(), 500);
  EXPECT_LT(lathe.most, window);
  for (const auto& spindle : lathe.status.spindles) EXPECT_LE(std::abs(spindle.speed), 5);
  EXPECT_TRUE(lathe.core.take_events().empty());
}

// The error goes from 0.72 to -0.72 deg and overshoots by 4.3 % of the difference: -0.78 deg.
TEST(CoupledStop, DrivesThatAreOnAgainMeanwhileTakeBothBackToSpeed) {
  Lathe lathe;
  lathe.core.set_enables({1, 1}, true);
  for (int i = 0; i < 500; ++i) lathe.step();
  EXPECT_EQ(lathe.core.mode(), Mode::OFF);
  lathe.core.set_enables({1, 1}, false);
  EXPECT_EQ(lathe.core.mode(), Mode::FOLLOWING);
  for (int i = 0; i < 2000; ++i) {
    lathe.step();
    ASSERT_EQ(lathe.slave().condition, SpindleCondition::SPINDLE_SYNCHRONIZED) << i;
  }
  EXPECT_LT(lathe.most, 0.79);
  EXPECT_NEAR(lathe.status.spindles[1].speed, 2000, 0.5);
}

// A PLC that clears its outputs with the emergency stop opens no chuck before both are at rest.
TEST(CoupledStop, ARequestThatIsWithdrawnMeanwhileEndsAtRest) {
  Lathe lathe;
  lathe.core.set_enables({1, 1}, true);
  lathe.core.set_spindle_couplings({});
  lathe.core.set_spindle_speed({});
  lathe.step();
  EXPECT_EQ(lathe.slave().master, 0);
  EXPECT_GT(lathe.run_to_the_end(), 1000);
  EXPECT_LT(lathe.most, window);
  lathe.core.set_enables({1, 1}, false);
  lathe.step();
  EXPECT_EQ(lathe.slave().master, -1);
  EXPECT_TRUE(lathe.core.take_events().empty());
}

// Of the ramp of 1 s the second half is left, 500 periods, and 5 1/min come 190 periods later. Only then does
// each spindle follow its own order, by 2 1/min in the first period.
TEST(CoupledStop, ARequestThatIsWithdrawnEndsAtRestAlsoWhenTheDrivesAreOnAgainBefore) {
  Lathe lathe;
  lathe.core.set_enables({1, 1}, true);
  lathe.core.set_spindle_couplings({});
  for (int i = 0; i < 500; ++i) lathe.step();
  lathe.core.set_enables({1, 1}, false);
  lathe.core.set_spindle_couplings({});
  lathe.core.set_spindle_speed({600, 100});
  EXPECT_EQ(lathe.core.mode(), Mode::FOLLOWING);
  int periods = 0;
  for (; lathe.slave().master == 0 && periods < 5000; ++periods) lathe.step();
  EXPECT_NEAR(periods, 690, 30);
  EXPECT_LT(lathe.most, window);
  for (const auto& spindle : lathe.status.spindles) EXPECT_LE(std::abs(spindle.speed), 8);
  for (int i = 0; i < 2000; ++i) lathe.step();
  EXPECT_NEAR(lathe.status.spindles[0].speed, 600, 0.5);
  EXPECT_NEAR(lathe.status.spindles[1].speed, 100, 0.5);
  EXPECT_TRUE(lathe.core.take_events().empty());
}

TEST(CoupledStop, ARequestThatIsBackBeforeRestContinuesAtSpeed) {
  Lathe lathe;
  lathe.core.set_enables({1, 1}, true);
  lathe.core.set_spindle_couplings({});
  for (int i = 0; i < 400; ++i) lathe.step();
  lathe.core.set_enables({1, 1}, false);
  lathe.core.set_spindle_couplings({});
  for (int i = 0; i < 100; ++i) lathe.step();
  lathe.core.set_spindle_couplings({following(IntegralAction::INTEGRAL_FROZEN)});
  for (int i = 0; i < 2000; ++i) {
    lathe.step();
    ASSERT_EQ(lathe.slave().condition, SpindleCondition::SPINDLE_SYNCHRONIZED) << i;
  }
  EXPECT_NEAR(lathe.status.spindles[1].speed, 2000, 0.5);
  EXPECT_LT(lathe.most, window);
}

TEST(CoupledStop, ADriveContinuesToTheRestOfAWithdrawnRequestWithTheSameBits) {
  Lathe one, other;
  one.core.set_enables({1, 1}, true);
  one.core.set_spindle_couplings({});
  for (int i = 0; i < 400; ++i) one.step();
  one.core.set_enables({1, 1}, false);
  one.core.set_spindle_couplings({});
  one.core.set_spindle_speed({600, 100});
  for (int i = 0; i < 10; ++i) one.step();
  const auto state = one.core.explicit_state();
  other.core.continue_from(bus::Json::parse(bus::text_of(state)));
  EXPECT_EQ(bus::text_of(other.core.explicit_state()), bus::text_of(state));
  for (int i = 0; i < 1500; ++i) {
    one.core.step(), other.core.step();
    one.look(), other.look();
    ASSERT_EQ(other.feedback, one.feedback) << i;
  }
  EXPECT_EQ(one.slave().master, -1);
  EXPECT_EQ(bus::text_of(other.core.explicit_state()), bus::text_of(one.core.explicit_state()));
}

TEST(CoupledStop, ADriveContinuesARunDownWithTheSameBits) {
  Lathe one, other;
  one.core.set_enables({1, 1}, true);
  one.core.set_spindle_couplings({});
  for (int i = 0; i < 400; ++i) one.step();
  const auto state = one.core.explicit_state();
  EXPECT_TRUE(state.at("row").contains("spindles_controlled"));
  other.core.continue_from(bus::Json::parse(bus::text_of(state)));
  EXPECT_EQ(bus::text_of(other.core.explicit_state()), bus::text_of(state));
  for (int i = 0; i < 1500; ++i) {
    one.core.step(), other.core.step();
    one.look(), other.look();
    ASSERT_EQ(other.feedback, one.feedback) << i;
  }
  EXPECT_EQ(one.status.spindles[0].speed, 0);
  EXPECT_EQ(bus::text_of(other.core.explicit_state()), bus::text_of(one.core.explicit_state()));
}

std::vector<SpindleStatus> turning(double master, double slave) {
  std::vector<SpindleStatus> spindles(2);
  spindles[0].speed = master, spindles[1].speed = slave;
  return spindles;
}

// Spindles whose speeds are given; the master has 200 1/min ordered, of which its ramp makes 2 in a period.
struct Given {
  explicit Given(std::vector<SpindleStatus> spindles = {}) {
    hardware->spindle = std::move(spindles);
    core.configure(two_spindles(), false);
    core.set_enables({1, 1}, false);
    core.set_spindle_couplings({following()});
    core.set_spindle_speed({200});
  }
  void periods(int count) {
    for (int i = 0; i < count; ++i) core.step();
    core.fill(feedback);
  }
  int periods_of_the_run_down() {
    for (int i = 0; i < 10000; ++i) {
      periods(1);
      if (!hardware->newest.spindles_controlled) return i;
      EXPECT_FALSE(hardware->newest.controlled);
      EXPECT_TRUE(hardware->newest.enable) << "the drives stay on";
    }
    return -1;
  }
  double ordered(std::size_t spindle) const { return hardware->newest.spindles[spindle].speed; }
  int coupled_with() const { return feedback.spindles.at(1).master; }

  testing::QueuedHardware* hardware = new testing::QueuedHardware(0);
  DriveCore core{std::unique_ptr<DriveHardware>(hardware)};
  idl::stream::Feedback feedback;
};

TEST(CoupledStop, TheEnableStaysUntilTheRampHasEnded) {
  Given given;
  given.periods(100);
  EXPECT_EQ(given.ordered(0), 200);
  EXPECT_FALSE(given.hardware->newest.spindles_controlled) << "the axes are controlled, too";
  given.core.set_enables({1, 1}, true);
  EXPECT_EQ(given.periods_of_the_run_down(), 100);
  EXPECT_FALSE(given.hardware->newest.enable);
  EXPECT_TRUE(given.core.take_events().empty());
}

// 100 periods of the ramp and spindle_rest_timeout, 2000 periods.
TEST(CoupledStop, ASpindleThatDoesNotComeToRestIsLeftAloneAfterATimeWithAnAlarm) {
  Given given;
  given.periods(100);
  given.hardware->spindle[1].speed = 30;
  given.core.set_enables({1, 1}, true);
  EXPECT_EQ(given.periods_of_the_run_down(), 2100);
  EXPECT_FALSE(given.hardware->newest.enable);
  EXPECT_FALSE(given.core.can_step(false));
  const auto events = given.core.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::synchronization_lost);
  EXPECT_EQ(events[0].part, 6u);
  EXPECT_EQ(events[0].text,
            "Spindle S2 turned at 30 1/min and its master Spindle S1 at 0 1/min when their drives went off, "
            "and each ran down by itself: open a chuck and check the part that both have held");
}

TEST(CoupledStop, APowerLossCannotBeCoupledAndIsAnAlarmOfThePart) {
  for (const bool stopped_before : {false, true}) {
    Given given;
    given.periods(100);
    if (stopped_before) given.core.set_enables({1, 1}, true);
    given.hardware->spindle[0].speed = given.hardware->spindle[1].speed = 190;
    given.periods(1);
    EXPECT_TRUE(given.hardware->newest.controls_spindles());
    given.hardware->on = false;
    given.periods(1);
    EXPECT_FALSE(given.hardware->newest.controls_spindles());
    EXPECT_FALSE(given.hardware->newest.enable);
    EXPECT_EQ(given.coupled_with(), -1);
    const auto events = given.core.take_events();
    ASSERT_EQ(events.size(), stopped_before ? 1u : 2u) << "the drives are an alarm of their own";
    EXPECT_EQ(events.back().alarm, &alarm::synchronization_lost);
  }
}

// As a drive that was killed finds them: the PLC still asks for everything.
TEST(CoupledStop, ANewDriveBeginsWhenBothAreAtRest) {
  Given given(turning(900, -600));
  given.periods(10);
  EXPECT_TRUE(given.hardware->newest.controlled);
  EXPECT_EQ(given.coupled_with(), -1);
  EXPECT_EQ(given.ordered(0), 0);
  EXPECT_EQ(given.ordered(1), 0);
  given.hardware->spindle[0].speed = 0;
  given.periods(10);
  EXPECT_EQ(given.ordered(0), 0) << "the other one turns";
  given.hardware->spindle[1].speed = 0;
  given.periods(1);  // it is read at the end of this period
  EXPECT_EQ(given.coupled_with(), -1);
  given.periods(1);
  EXPECT_EQ(given.coupled_with(), 0);
  EXPECT_EQ(given.ordered(0), 2);
  EXPECT_EQ(given.ordered(1), 2);
  EXPECT_TRUE(given.core.take_events().empty());
}

// It would keep both at rest otherwise, without an alarm.
TEST(CoupledStop, ARefusedRequestIsJudgedAgainWhenTheDrivesComeOn) {
  Given given(turning(0, 0));
  given.core.set_spindle_couplings({});
  given.hardware->spindle[1].homed = false;
  given.periods(2);
  given.core.set_spindle_couplings({following()});
  given.periods(2);
  ASSERT_EQ(given.core.take_events().size(), 1u);
  EXPECT_EQ(given.coupled_with(), -1);
  given.hardware->spindle[1].homed = true;
  given.core.set_enables({1, 1}, true);
  given.periods(3);
  EXPECT_FALSE(given.hardware->newest.enable);
  given.core.set_enables({1, 1}, false);
  given.periods(100);
  EXPECT_EQ(given.coupled_with(), 0);
  EXPECT_EQ(given.ordered(0), 200);
  EXPECT_EQ(given.ordered(1), 200);
  EXPECT_TRUE(given.core.take_events().empty());
}

TEST(CoupledStop, ARequestThatMakesNoSenseKeepsNoSpindleAtRest) {
  Given given;
  given.core.set_spindle_couplings({{5, 0, false, 0, IntegralAction::INTEGRAL_ACTIVE}});
  for (int i = 0; i < 2; ++i) {
    given.core.set_enables({1, 1}, false);
    given.periods(3);
    EXPECT_EQ(given.ordered(0), 200);
    const auto events = given.core.take_events();
    ASSERT_EQ(events.size(), 1u) << "each time that the drives come on";
    EXPECT_EQ(events[0].alarm, &alarm::synchronization_lost);
    given.core.set_enables({1, 1}, true);
    given.periods(3);
  }
}

TEST(CoupledStop, ARequestThatComesUnderControlBeginsAtSpeed) {
  Given given(turning(900, 600));
  given.core.set_spindle_couplings({});
  given.periods(10);
  EXPECT_EQ(given.ordered(0), 200);
  given.core.set_spindle_couplings({following()});
  given.periods(1);
  EXPECT_EQ(given.coupled_with(), 0);
  EXPECT_EQ(given.ordered(0), 898) << "the ramp begins with the speed that the master has";
}

// 100 1/min of the slave are not the speed of its master: no part holds both.
TEST(CoupledStop, ASlaveThatIsStillSpeedingUpRunsDownByItself) {
  Given given(turning(0, 100));
  given.core.set_spindle_couplings({});
  given.periods(1);
  given.core.set_spindle_couplings({following()});
  given.periods(20);
  EXPECT_EQ(given.coupled_with(), 0);
  EXPECT_EQ(given.ordered(0), 40);
  given.core.set_enables({1, 1}, true);
  EXPECT_EQ(given.periods_of_the_run_down(), 0);
  EXPECT_FALSE(given.hardware->newest.enable);
  EXPECT_EQ(given.coupled_with(), -1);
  EXPECT_TRUE(given.core.take_events().empty());
}

TEST(CoupledStop, ANewDriveKeepsSpindlesAtRestThatAreNotHomedUntilTheRequestIsWithdrawn) {
  auto spindles = turning(0, 0);
  spindles[1].homed = false;
  Given given(spindles);
  given.periods(10);
  EXPECT_EQ(given.coupled_with(), -1);
  EXPECT_EQ(given.ordered(0), 0);
  const auto events = given.core.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::spindle_not_homed);
  EXPECT_EQ(events[0].text,
            "Spindle S2 is not synchronized with Spindle S1: Spindle S2 has not passed its index mark since "
            "the start; both are kept at rest: open a chuck, withdraw the request, turn it, then give the "
            "request again");
  given.core.set_spindle_couplings({});
  given.periods(1);
  EXPECT_EQ(given.ordered(0), 200);
}

}  // namespace
}  // namespace trunnion::drive::coupled_stop_test
