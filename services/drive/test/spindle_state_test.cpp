// SPDX-License-Identifier: Apache-2.0
// The spindle of a drive with everything that parameters, outputs and truth.yaml can say of it.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "bus/json.hpp"
#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "simulated_hardware.hpp"
#include "two_axes.hpp"

namespace trunnion::drive {
namespace spindle_state_test {
namespace {

using idl::stream::SpindleCondition;

// 20000 deg/s2 are 3333.33 1/min in a second.
machine::Parameters with_spindle() {
  auto p = two_axes();
  p.values[105000] = {0, "S"}, p.values[105001] = {machine::axis_type_spindle, ""};
  p.values[105036] = {20000, ""};
  return p;
}

struct Machine {
  explicit Machine(const machine::Parameters& parameters,
                   std::map<std::string, truth::SpindleTruth> spindles = {})
      : core(std::make_unique<SimulatedHardware>(
            std::map<std::string, truth::DriveTruth>(), std::optional<ProbeSetup>(),
            std::optional<volumetric::BeamErrors>(), std::move(spindles))) {
    core.configure(parameters, false);
    core.set_enables({1, 1}, false);
  }
  const idl::stream::SpindleState& periods(int count) {
    for (int i = 0; i < count; ++i) core.step();
    core.fill(feedback);
    return feedback.spindles.at(0);
  }
  double speed() const { return feedback.spindle_speed.at(0); }
  DriveCore core;
  idl::stream::Feedback feedback;
};

TEST(SpindleState, IsThatOfASpindleThatSpeedsUpAndIsSwitchedOff) {
  Machine m(with_spindle());
  EXPECT_EQ(m.periods(1).condition, SpindleCondition::SPINDLE_STOPPED);
  m.core.set_spindle_speed({1000});
  EXPECT_EQ(m.periods(100).condition, SpindleCondition::SPINDLE_ACCELERATING);
  EXPECT_EQ(m.feedback.spindles[0].reference, 1000) << "without 10a971 it is the commanded speed";
  EXPECT_TRUE(m.feedback.spindles[0].homed);
  EXPECT_EQ(m.feedback.spindles[0].torque, 0) << "there is no motor in truth.yaml";
  EXPECT_EQ(m.periods(250).condition, SpindleCondition::SPINDLE_AT_SPEED);
  m.core.set_enables({1, 1}, true);
  EXPECT_EQ(m.periods(100).condition, SpindleCondition::SPINDLE_ACCELERATING) << "it runs down";
  EXPECT_EQ(m.feedback.spindles[0].reference, 0);
  EXPECT_EQ(m.periods(300).condition, SpindleCondition::SPINDLE_STOPPED);
}

// 0.625 s to 2000 1/min, see SpindleRamp; at 1500 1/min 0.45 s have passed.
TEST(SpindleState, TheSpindleFollowsItsRamp) {
  auto p = with_spindle();
  p.values[105971] = {1, ""}, p.values[105972] = {1500, ""}, p.values[105973] = {4000, ""};
  Machine m(p);
  EXPECT_TRUE(m.core.take_events().empty());
  m.core.set_spindle_speed({2000});
  EXPECT_NEAR(m.periods(450).reference, 1500, 10 / 3.0);
  EXPECT_NEAR(m.speed(), m.feedback.spindles[0].reference, 1e-6);
  EXPECT_LT(m.periods(170).reference, 2000);
  EXPECT_EQ(m.periods(7).reference, 2000);
  EXPECT_EQ(m.feedback.spindles[0].condition, SpindleCondition::SPINDLE_AT_SPEED);
}

// 600 1/min are 10 rev/s, 2.5 turns in 250 ms. It has had that speed since 0.18 s at 20000 deg/s2.
TEST(SpindleState, HasTheAngleOfTheEncoderWithItsTurns) {
  Machine m(with_spindle());
  EXPECT_EQ(m.periods(1).angle, 0);
  m.core.set_spindle_speed({600});
  const double before = m.periods(1000).angle;
  EXPECT_NEAR(m.periods(250).angle - before, 2.5, 1e-9);
  EXPECT_GT(before, 1);
}

TEST(SpindleState, UnusableDataOfTheRampAreAnAlarmAtTheStart) {
  auto p = with_spindle();
  p.values[105971] = {1, ""}, p.values[105973] = {4000, ""};
  Machine m(p);
  const auto events = m.core.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::spindle_parameters);
  EXPECT_EQ(events[0].part, 5u);
  m.core.set_spindle_speed({2000});
  EXPECT_EQ(m.periods(500).reference, 0);
  EXPECT_EQ(m.speed(), 0);
}

TEST(SpindleState, TheGearLimitsTheSpeed) {
  auto p = with_spindle();
  p.values[105985] = {500, ""}, p.values[105986] = {1000, ""};
  Machine m(p);
  m.core.set_spindle_speed({1200});
  m.core.set_spindle_gears({1});
  EXPECT_EQ(m.periods(500).gear, 1);
  EXPECT_EQ(m.speed(), 500);
  m.core.set_spindle_gears({2});
  EXPECT_EQ(m.periods(500).gear, 2);
  EXPECT_EQ(m.speed(), 1000);
  m.core.set_spindle_gears({});
  EXPECT_EQ(m.periods(500).gear, 0);
  EXPECT_EQ(m.speed(), 1200);
}

// From the start to the mark 200 deg ahead, and 90 deg on.
TEST(SpindleState, AnOrientationHomesTheSpindleAndTurnsItToTheOrderedAngle) {
  truth::SpindleTruth truth;
  truth.mark = 200;
  Machine m(with_spindle(), {{"S", truth}});
  EXPECT_FALSE(m.periods(1).homed);
  m.core.set_spindle_orientation({1}, {90});
  EXPECT_EQ(m.periods(100).condition, SpindleCondition::SPINDLE_POSITIONING);
  // 290 deg at 600 deg/s, and the ends.
  EXPECT_EQ(m.periods(1000).condition, SpindleCondition::SPINDLE_ORIENTED);
  EXPECT_TRUE(m.feedback.spindles[0].homed);
  EXPECT_EQ(m.feedback.spindle_oriented[0], 1);
  EXPECT_TRUE(m.core.take_events().empty());
}

truth::SpindleTruth everything() {
  truth::SpindleTruth truth{0.05, {{0, 40}, {1500, 40}, {6000, 10}}};
  truth.speed_error = 0.01, truth.ripple = 0.02, truth.ripple_frequency = 3;
  truth.load_torque = 5, truth.gears = {4, 1}, truth.mark = 200;
  return truth;
}

TEST(SpindleState, ADriveContinuesWithTheSameBitsWhateverItsSpindleDoes) {
  auto p = with_spindle();
  p.values[105971] = {1, ""}, p.values[105972] = {1500, ""}, p.values[105973] = {4000, ""};
  p.values[105978] = {20, ""}, p.values[105985] = {800, ""}, p.values[105986] = {3000, ""};
  std::mt19937 random(7);
  const auto act = [](Machine& m, unsigned choice) {
    switch (choice % 5) {
      case 0:
        m.core.set_spindle_speed({static_cast<double>(choice % 4001) - 2000});
        break;
      case 1:
        m.core.set_spindle_gears({static_cast<std::uint8_t>(choice % 4)});
        break;
      case 2:
        m.core.set_spindle_orientation({static_cast<std::uint8_t>(choice % 3 == 0 ? 0 : 1)},
                                       {static_cast<double>(choice % 400) - 40});
        break;
      case 3:
        m.core.set_enables({1, 1}, choice % 20 == 3);
        break;
      default:
        m.core.acknowledge();
    }
    m.periods(static_cast<int>(choice % 211));
  };
  for (int sample = 0; sample < 20; ++sample) {
    Machine one(p, {{"S", everything()}}), other(p, {{"S", everything()}});
    const auto before = 1 + random() % 20;
    for (unsigned i = 0; i < before; ++i) act(one, static_cast<unsigned>(random()));
    one.core.take_events();
    other.core.continue_from(bus::Json::parse(bus::text_of(one.core.explicit_state())));
    EXPECT_EQ(bus::text_of(other.core.explicit_state()), bus::text_of(one.core.explicit_state()));
    for (int i = 0; i < 20; ++i) {
      const auto choice = static_cast<unsigned>(random());
      act(one, choice);
      act(other, choice);
      ASSERT_EQ(other.feedback, one.feedback) << "sample " << sample << ", " << i << " behind the state";
      ASSERT_EQ(other.core.take_events().size(), one.core.take_events().size());
    }
    EXPECT_EQ(bus::text_of(other.core.explicit_state()), bus::text_of(one.core.explicit_state()));
  }
}

}  // namespace
}  // namespace spindle_state_test
}  // namespace trunnion::drive
