// SPDX-License-Identifier: Apache-2.0
#include "spindles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "machine/alarm_constants.hpp"

namespace trunnion::drive {
namespace {

using idl::stream::SpindleCondition;

machine::Parameters one_spindle() {
  machine::Parameters p;
  p.values[105000] = {0, "S"}, p.values[105001] = {machine::axis_type_spindle, ""};
  return p;
}

// One spindle with a status that is given.
struct OneSpindle {
  explicit OneSpindle(const machine::Parameters& parameters = one_spindle()) {
    spindles.configure(parameters, 0.001);
  }
  const idl::stream::SpindleState& step(bool controlled = true) {
    spindles.step(status, controlled, row);
    spindles.fill(status, row, controlled, feedback);
    return feedback.spindles[0];
  }
  std::vector<DriveEvent> events() const {
    std::vector<DriveEvent> found;
    spindles.report(status, found);
    return found;
  }
  Spindles spindles;
  std::vector<SpindleStatus> status = std::vector<SpindleStatus>(1);
  std::vector<SpindleSetpoint> row = std::vector<SpindleSetpoint>(1);
  idl::stream::Feedback feedback;
};

TEST(Spindles, TheStreamGoesBeforeTheOrientationAndThatBeforeTheSpeed) {
  Spindles spindles;
  spindles.configure(one_spindle(), 0.001);
  ASSERT_EQ(spindles.size(), 1u);
  EXPECT_EQ(spindles.axes()[0].number, 5);
  std::vector<SpindleStatus> status(1);
  std::vector<SpindleSetpoint> out(1);
  idl::stream::Feedback feedback;
  status[0].angle = 7;
  spindles.demand_speeds({300});
  spindles.demand_orientations({1});

  spindles.coupling(0).couple(0, status[0].angle);
  spindles.coupling(0).couple(0.1, status[0].angle);
  spindles.step(status, true, out);
  EXPECT_TRUE(out[0].coupled);
  EXPECT_DOUBLE_EQ(out[0].angle, 7.1);
  spindles.lead_on(0.5);
  spindles.step(status, true, out);
  EXPECT_DOUBLE_EQ(out[0].angle, 7.15) << "half a cycle on";
  spindles.fill(status, out, true, feedback);
  EXPECT_EQ(feedback.spindle_oriented[0], 0);

  spindles.coupling(0).release();
  spindles.step(status, true, out);
  EXPECT_TRUE(out[0].coupled) << "held where it is: at 0 deg after 7 turns";
  EXPECT_EQ(out[0].angle, 7);
  spindles.fill(status, out, true, feedback);
  EXPECT_EQ(feedback.spindle_oriented[0], 1);

  spindles.demand_orientations({});
  spindles.step(status, true, out);
  EXPECT_FALSE(out[0].coupled);
  EXPECT_EQ(out[0].speed, 300);
  spindles.demand_speeds({});
  spindles.step(status, true, out);
  EXPECT_EQ(out[0].speed, 0);
}

// 10a970 is 5 %: of 1000 1/min 50 1/min; below 100 1/min it is 5 1/min.
TEST(Spindles, TellWhetherASpindleHasItsSpeed) {
  OneSpindle s;
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_STOPPED);
  s.spindles.demand_speeds({-1000});
  s.status[0].speed = -949;
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_ACCELERATING);
  EXPECT_EQ(s.step().reference, -1000);
  s.status[0].speed = -951;
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_AT_SPEED);
  s.status[0].speed = -1051;
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_ACCELERATING);
  s.spindles.demand_speeds({50});
  s.status[0].speed = 46;
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_AT_SPEED);
  s.spindles.demand_speeds({});
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_ACCELERATING) << "it has to come to rest";
  s.status[0].speed = 4;
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_STOPPED);
}

TEST(Spindles, WithoutControlTheCommandedSpeedIsZero) {
  OneSpindle s;
  s.spindles.demand_speeds({1000});
  s.status[0].speed = 1000;
  const auto& state = s.step(false);
  EXPECT_EQ(state.condition, SpindleCondition::SPINDLE_ACCELERATING);
  EXPECT_EQ(state.reference, 0);
}

TEST(Spindles, TellWhatASpindleFollows) {
  OneSpindle s;
  s.status[0].homed = false, s.status[0].torque = 0.25;
  s.spindles.coupling(0).couple(0, 0);
  s.spindles.coupling(0).couple(0.1, 0);
  const auto& state = s.step();
  EXPECT_EQ(state.condition, SpindleCondition::SPINDLE_FOLLOWS_PATH);
  EXPECT_NEAR(state.reference, 6000, 1e-6) << "0.1 rev in a cycle of 1 ms";
  EXPECT_FALSE(state.homed);
  EXPECT_EQ(state.torque, 0.25);
  EXPECT_EQ(state.gear, 0);
  EXPECT_EQ(state.master, -1);
  s.spindles.coupling(0).release();
  s.spindles.demand_orientations({1}, {90});
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_POSITIONING);
  EXPECT_FALSE(s.row[0].coupled) << "it turns at 10a947 until its mark has passed";
  EXPECT_NEAR(s.row[0].speed, 100, 1e-9);
  EXPECT_NEAR(s.step().reference, 100, 1e-9);
  s.status[0].homed = true, s.status[0].angle = 3.25;
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_ORIENTED);
  EXPECT_EQ(s.row[0].angle, 3.25);
  EXPECT_EQ(s.step().reference, 0);
  EXPECT_EQ(s.step().angle, 3.25);
}

TEST(Spindles, AGearLimitsTheCommandedSpeedAndIsHandedToTheHardware) {
  auto p = one_spindle();
  p.values[105985] = {500, ""};
  OneSpindle s(p);
  s.spindles.demand_speeds({2000});
  s.spindles.engage_gears({1});
  s.status[0].speed = 500;
  const auto& state = s.step();
  EXPECT_EQ(s.row[0].speed, 500);
  EXPECT_EQ(s.row[0].gear, 1);
  EXPECT_EQ(state.gear, 1);
  EXPECT_EQ(state.condition, SpindleCondition::SPINDLE_AT_SPEED);
  s.spindles.engage_gears({2});
  EXPECT_EQ(s.step().gear, 0) << "it has no such gear";
  EXPECT_EQ(s.row[0].speed, 2000);
}

// Each by its own 10a948, whatever orders it. At the centre a surface speed is the limit of its order.
TEST(Spindles, TheHighestSpeedLimitsEveryOrder) {
  auto p = one_spindle();
  p.values[105948] = {3000, ""};
  OneSpindle s(p);
  s.status[0].speed = 3000;
  s.spindles.demand_speeds({2999});
  s.step();
  EXPECT_EQ(s.row[0].speed, 2999);
  s.spindles.demand_speeds({5000});
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_AT_SPEED);
  EXPECT_EQ(s.row[0].speed, 3000);
  s.spindles.demand_speeds({-5000});
  s.step();
  EXPECT_EQ(s.row[0].speed, -3000);
  idl::plc::SurfaceSpeed surface;
  surface.speed = 200, surface.limit = 6000, surface.radius = 0;
  s.spindles.demand_surface_speeds({surface});
  EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_AT_SPEED);
  EXPECT_EQ(s.row[0].speed, 3000);
}

// 20000 deg/s2 are 10 / 3 1/min in a period.
TEST(Spindles, TheReferenceIsThatOfTheRamp) {
  auto p = one_spindle();
  p.values[105036] = {20000, ""};
  p.values[105971] = {1, ""}, p.values[105972] = {1500, ""}, p.values[105973] = {4000, ""};
  OneSpindle s(p);
  std::vector<DriveEvent> events;
  s.spindles.report_parameters(events);
  EXPECT_TRUE(events.empty());
  s.spindles.demand_speeds({2000});
  EXPECT_NEAR(s.step().reference, 10 / 3.0, 1e-9);
  EXPECT_NEAR(s.row[0].speed, 10 / 3.0, 1e-9);
  s.status[0].speed = 1000;
  s.step(false);
  EXPECT_NEAR(s.step().reference, 1000 + 10 / 3.0, 1e-9) << "it begins at the speed the spindle has";
}

TEST(Spindles, DataOfTheRampThatCannotBeUsedAreAnAlarmAndTheSpindleStaysAtRest) {
  auto p = one_spindle();
  p.values[105971] = {1, ""}, p.values[105972] = {1500, ""}, p.values[105973] = {1000, ""};
  OneSpindle s(p);
  std::vector<DriveEvent> events;
  s.spindles.report_parameters(events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::spindle_parameters);
  EXPECT_EQ(events[0].part, 5u);
  EXPECT_THAT(events[0].text, ::testing::HasSubstr("1500 1/min (parameter 105972)"));
  s.spindles.demand_speeds({500});
  EXPECT_EQ(s.step().reference, 0);
  EXPECT_EQ(s.row[0].speed, 0);
}

// From 90 deg to 93.6 deg.
TEST(Spindles, AHeldSpindleThatLeavesItsWindowIsAnAlarm) {
  OneSpindle s;
  s.spindles.demand_orientations({1}, {90});
  s.status[0].angle = 2.25;
  ASSERT_EQ(s.step().condition, SpindleCondition::SPINDLE_ORIENTED);
  s.status[0].angle = 2.26;
  std::vector<DriveEvent> all;
  for (std::uint32_t i = 1; i <= 2 * orientation_lost_periods; ++i) {
    EXPECT_EQ(s.step().condition, SpindleCondition::SPINDLE_POSITIONING);
    for (auto& event : s.events()) {
      EXPECT_EQ(i, orientation_lost_periods);
      all.push_back(std::move(event));
    }
  }
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].alarm, &alarm::orientation_lost);
  EXPECT_EQ(all[0].part, 5u);
  EXPECT_THAT(all[0].text, ::testing::HasSubstr("is 3.600 deg from its orientation angle 90.000 deg"));
  s.spindles.acknowledge();
  for (std::uint32_t i = 0; i < orientation_lost_periods; ++i) s.step();
  EXPECT_EQ(s.events().size(), 1u) << "it is out of its window still";
}

// 25 s and two turns at 100 1/min, 1.2 s.
TEST(Spindles, AnOrientationThatDoesNotArriveIsAnAlarm) {
  OneSpindle s;
  const auto alarm_after = [&](std::uint32_t periods) {
    std::string text;
    for (std::uint32_t i = 1; i <= periods; ++i) {
      s.step();
      for (const auto& event : s.events()) {
        EXPECT_EQ(event.alarm, &alarm::orientation_lost);
        EXPECT_EQ(event.part, 5u);
        EXPECT_EQ(i, 26200u);
        text += event.text;
      }
    }
    return text;
  };
  s.spindles.demand_orientations({1}, {90});
  EXPECT_EQ(alarm_after(60000),
            "Spindle S turns at 0 1/min and is -90.000 deg from its orientation angle 90.000 deg 26.2 s "
            "after the order: see what blocks or drives it, then reset");
  s.spindles.acknowledge();
  s.status[0].homed = false;
  EXPECT_EQ(alarm_after(60000),
            "Spindle S turns at 0 1/min and has not passed its index mark 26.2 s after the order of its "
            "orientation: see what blocks it, and its encoder, then reset");
  s.spindles.demand_orientations({});
  EXPECT_EQ(alarm_after(60000), "");
}

}  // namespace
}  // namespace trunnion::drive
