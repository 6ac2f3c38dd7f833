// SPDX-License-Identifier: Apache-2.0
// Overrides, gears and accelerations of the spindle in a tap.
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "machine/alarm_constants.hpp"
#include "tapping_fixture.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using tapping_test::hole;
using tapping_test::Tap;

TEST_F(Tap, TheSpindleIsNeverAskedForMoreThanItsSpeedAndItsAcceleration) {
  start(hole);
  run();
  const auto rows = coupled();
  for (std::size_t i = 2; i < rows.size(); ++i) {
    const double before = (rows[i - 1].second - rows[i - 2].second) * 60000;  // 1/min
    const double now = (rows[i].second - rows[i - 1].second) * 60000;
    ASSERT_LE(std::abs(now), 400 * (1 + 1e-6));
    ASSERT_LE(std::abs(now - before), 2 * (1 + 1e-3)) << "2000 1/min in a second are 2 in a cycle";
  }
}

TEST_F(Tap, TheFeedOverrideDoesNotActInTheThreadButElsewhere) {
  start(hole);
  run();
  const auto thread = coupled();
  const auto rows = drive.rows.size();
  drive = testing::FakeDrive(3);
  begin();
  load(hole);
  ask(CommandKind::FEED_OVERRIDE, "", 0.1);
  ask(CommandKind::RAPID_OVERRIDE, "", 0.02);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(coupled(), thread);
  EXPECT_GT(drive.rows.size(), rows);
}

/// The highest speed of the spindle in `rows` of coupled(), 1/min: a cycle is 1 ms.
double highest_speed(const std::vector<std::pair<double, double>>& rows) {
  double highest = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    highest = std::max(highest, std::abs(rows[i].second - rows[i - 1].second) * 60000);
  return highest;
}

TEST_F(Tap, TheSpindleOverrideActsOnBothAndTheyKeepTheLead) {
  for (const double override_ : {0.5, 1.25}) {
    drive = testing::FakeDrive(3);
    begin();
    load(hole);
    ask(CommandKind::SPINDLE_OVERRIDE, "", override_);
    ask(CommandKind::CYCLE_START);
    run();
    const auto rows = coupled();
    for (const auto& [z, turns] : rows) ASSERT_NEAR(2 - z, 1.25 * turns, 1e-9);
    EXPECT_NEAR(highest_speed(rows), 400 * override_, 0.01) << "S400";
    EXPECT_EQ(drive.rows.back()[2], 20);
  }
}

TEST_F(Tap, AChangeOfTheSpindleOverrideInTheThreadActsAtOnceWithinTheAccelerationOfTheSpindle) {
  cycles_per_round = 8;
  start(hole);
  while (drive.rows.empty() || drive.rows.back()[2] > -2) round();
  const auto before = coupled().size();
  ask(CommandKind::SPINDLE_OVERRIDE, "", 0.5);
  while (drive.rows.back()[2] > -8) round();
  const auto rows = coupled();
  const auto speed = [&](std::size_t i) { return (rows[i].second - rows[i - 1].second) * 60000; };
  EXPECT_NEAR(speed(before - 1), 400, 0.01);
  EXPECT_NEAR(speed(rows.size() - 1), 200, 0.01);
  for (std::size_t i = 2; i < rows.size(); ++i)
    ASSERT_LE(std::abs(speed(i) - speed(i - 1)), 2 * (1 + 1e-3)) << "2000 1/min in a second";
}

TEST_F(Tap, TheSpindleOverrideDoesNotTakeTheSpindleAboveItsHighestSpeed) {
  parameters->values[105948] = {450, ""};
  begin();
  load(hole);
  ask(CommandKind::SPINDLE_OVERRIDE, "", 1.5);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_NEAR(highest_speed(coupled()), 450, 0.01) << "and not 600";
}

/// What the drive says of one spindle in a gear.
std::vector<idl::stream::SpindleState> in_gear(std::uint8_t gear) {
  std::vector<idl::stream::SpindleState> states(1);
  states[0].gear = gear, states[0].master = -1;
  return states;
}

// Gear 1 up to 1000 1/min, gear 2 up to 4000. S900 with 150 % is 1350.
TEST_F(Tap, TheSpindleOverrideDoesNotTakeTheSpindleAboveTheSpeedOfItsGear) {
  parameters->values[105985] = {1000, ""}, parameters->values[105986] = {4000, ""};
  const std::pair<std::uint8_t, double> gears[] = {{1, 1000}, {2, 1350}, {0, 1350}};
  for (const auto& [gear, highest] : gears) {
    drive = testing::FakeDrive(3);
    drive.spindle_states = [in = gear](std::uint64_t) { return in_gear(in); };
    begin();
    load("G90 G95 G0 Z5\nS900 M3\nG99 G84 X0 Y0 Z-20 R2 F1.25\nG80\nM30\n");
    ask(CommandKind::SPINDLE_OVERRIDE, "", 1.5);
    ask(CommandKind::CYCLE_START);
    run();
    EXPECT_NEAR(highest_speed(coupled()), highest, 0.01) << "gear " << static_cast<int>(gear);
  }
}

// The example of the manual: in at 500 1/min, out at 1250.
TEST_F(Tap, AWayOutAboveTheSpeedOfTheGearIsRefusedBeforeTheTapIsInTheHole) {
  parameters->values[105985] = {1000, ""}, parameters->values[105986] = {4000, ""};
  parameters->values[40959] = {1, ""};
  const std::string program = "S500 M3\nG84 Z-20 K1.25 EK2.5 EH2 ER5\nG0 Z20\nM2\n";
  drive.spindle_states = [](std::uint64_t) { return in_gear(1); };
  begin();
  start(program);
  run();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::spindle_speed_above);
  EXPECT_NE(events.back().text.find("the tap needs 1250 1/min, S has at most 1000 1/min in gear 1 (10a985)"),
            std::string::npos)
      << events.back().text;
  EXPECT_TRUE(coupled().empty());
  EXPECT_EQ(drive.rows.back()[2], 2);
  events.clear();
  drive = testing::FakeDrive(3);
  drive.spindle_states = [](std::uint64_t) { return in_gear(2); };
  begin();
  start(program);
  run();
  EXPECT_TRUE(events.empty());
  EXPECT_NEAR(highest_speed(coupled()), 1250, 0.01);
}

// 12000 deg/s2 up to 200 1/min: at 600, the highest speed that S400 can have, they are 4000, 666.7 1/min in a
// second.
TEST_F(Tap, AnAccelerationThatFallsWithTheSpeedIsThatOfTheHighestSpeedOfTheTap) {
  parameters->values[105971] = {1, ""};
  parameters->values[105972] = {200, ""}, parameters->values[105973] = {4000, ""};
  for (const double override_ : {1.0, 1.5}) {
    drive = testing::FakeDrive(3);
    begin();
    load(hole);
    ask(CommandKind::SPINDLE_OVERRIDE, "", override_);
    ask(CommandKind::CYCLE_START);
    run();
    const auto rows = coupled();
    ASSERT_GT(rows.size(), 1000u);
    for (std::size_t i = 2; i < rows.size(); ++i) {
      const double before = (rows[i - 1].second - rows[i - 2].second) * 60000;
      const double now = (rows[i].second - rows[i - 1].second) * 60000;
      ASSERT_LE(std::abs(now - before), 4000.0 / 6000 * (1 + 1e-3)) << "in a cycle of 1 ms";
    }
  }
}

TEST_F(Tap, ANumTapComesOutAtItsOwnSpeedAndTheSpindleTurnsAgainOrNot) {
  parameters->values[40959] = {1, ""};
  for (const bool stops : {false, true}) {
    auxiliaries.clear();
    drive = testing::FakeDrive(3);
    begin();
    // In at 200 1/min, out at 400; 12 mm at a lead of 1.25 mm are 9.6 turns.
    start(std::string("S200 M3\nG84 Z-10 K1.25 EK2 EH2 ER5") + (stops ? " M5" : "") + "\nG0 Z20\nM2\n");
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    const auto rows = coupled();
    ASSERT_FALSE(rows.empty());
    double in = 0, out = 0, most = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double speed = (rows[i].second - rows[i - 1].second) * 60000;
      in = std::max(in, speed), out = std::max(out, -speed), most = std::max(most, rows[i].second);
      ASSERT_NEAR(2 - rows[i].first, 1.25 * rows[i].second, 1e-9);
    }
    EXPECT_NEAR(in, 200, 0.01);
    EXPECT_NEAR(out, 400, 0.01);
    EXPECT_NEAR(most, 9.6, 1e-9);
    EXPECT_NEAR(rows.back().second, 0, 1e-9);
    EXPECT_EQ(drive.rows.back()[2], 20);
    EXPECT_EQ(m_codes(), (stops ? std::vector<int>{3, 5, 5, 2} : std::vector<int>{3, 5, 3, 2}));
  }
}

}  // namespace
}  // namespace trunnion::channel
