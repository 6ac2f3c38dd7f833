// SPDX-License-Identifier: Apache-2.0
// Each kind of table against a calculation by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "machine/kinematics.hpp"
#include "one_channel.hpp"

namespace trunnion::compensation {
namespace {

constexpr int X = 0, Y = 1, Z = 2;

void expect_rows(const std::vector<double>& actual, const std::vector<double>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(actual[i], expected[i], 1e-12) << i;
}

std::string refusal(const machine::Parameters& p) {
  CompensationCore core;
  try {
    core.configure(p, 0);
  } catch (const machine::KinematicsError& e) {
    return e.what();
  }
  return "";
}

// The manual's example: 20 points, 60 mm apart, 3 of them below the reference point: from -3 * 60 = -180 to
// (20 - 3 - 1) * 60 = 960. Value i is i um: at 30 it is (30 + 180) / 60 = 3.5 um.
TEST(TableKinds, TwentyPointsOfSixtyWithThreeBelowZeroCoverTheirTravel) {
  auto p = axes({X});
  Set set{p};
  set(300020, 1), set(300021, -3 * 60), set(300022, 20), set(300023, 60);
  for (std::uint32_t i = 0; i < 20; ++i) set(700000 + i, i * 1e-3);
  expect_rows(Channel(p).run({-200, -180, 30, 960, 1000}, 1), {-200, -180, 30.0035, 960.019, 1000.019});
}

// 300 mm * tan(0.01 deg) = 0.0523599 mm; the sign: more than 90 deg is positive, positive moves positive.
TEST(TableKinds, SquarenessIsTheDistanceFromTheReferencePointTimesTheTangent) {
  auto p = axes({X, Y, Z});
  Set set{p};
  set(301030, 1), set(301031, X), set(301033, 0.01);
  set(301040, 1), set(301041, Z), set(301042, -100), set(301043, -0.01);
  const auto out = Channel(p).run({300, 5, -100, 300, 5, 200, 0, 5, -100}, 3);
  EXPECT_NEAR(out[1], 5.0524, 5e-5);
  EXPECT_NEAR(out[1], 5 + 0.052359878, 1e-8);
  EXPECT_NEAR(out[4], 5 + 0.052359878 - 0.052359878, 1e-8) << "Z is 300 mm from its reference point";
  EXPECT_EQ(out[7], 5);
  EXPECT_EQ(out[0], 300) << "the reference axis is not moved";
}

// Over Y: 0 10 -10 um at 0 100 200, twice that by the magnification, added to Z; and over X in both
// directions: up 2 um, down 6 um.
TEST(TableKinds, StraightnessIsTheTableOfTheReferenceAxisInItsDirection) {
  auto p = axes({X, Y, Z});
  Set set{p};
  set(302050, Y), set(302051, 1), set(302052, 0), set(302053, 3), set(302054, 100), set(302056, 2);
  set.table(700000, {0, 0.010, -0.010});
  set(302065, X), set(302066, 2), set(302067, 0), set(302068, 2), set(302069, 100), set(302072, 700100);
  set.table(700100, {0.002, 0.002, 0.006, 0.006});
  // Y at 50: 2 * 5 um; at 150: 0; beyond the end 2 * -10 um. X goes up, then down.
  expect_rows(Channel(p).run({0, 50, 7, 10, 150, 7, 5, 250, 7}, 3),
              {0, 50, 7.012, 10, 150, 7.002, 5, 250, 7 - 0.020 + 0.006});
}

TEST(TableKinds, AModuloTableInBothDirectionsRepeats) {
  auto p = axes({X, Y});
  Set set{p};
  set(301050, X), set(301051, 2), set(301053, 4), set(301054, 90), set(301055, 1);
  set.table(700000, {0, 0.01, 0, -0.01, 0.1, 0.2, 0.3, 0.4});
  // 450 is 90 + 360; 405 lies half way between 0 (360) and 90. Down at 315: half way between 0.4 at 270 and
  // 0.1 at 360.
  expect_rows(Channel(p).run({0, 0, 405, 0, 450, 0, 315, 0}, 2), {0, 0, 405, 0.005, 450, 0.01, 315, 0.25});
}

// X turns the carriage by 0.01 deg at x = 100; Z is the arm, from -200; Y is compensated: at z = 100 by
// 300 * tan(0.01 deg) = 0.05236 mm, at x = 50 by half of it (to 1e-9).
TEST(TableKinds, AnAngleActsByItsLeverArm) {
  auto p = axes({X, Y, Z});
  Set set{p};
  set(302080, X), set(302081, Y), set(302082, -200), set(302083, 1), set(302084, 0), set(302085, 2);
  set(302086, 100), set.table(700000, {0, 0.01});
  const auto out = Channel(p).run({100, 0, 100, 50, 0, 100, 100, 0, -200}, 3);
  EXPECT_NEAR(out[1], 0.052359878, 1e-8);
  EXPECT_NEAR(out[4], 0.052359878 / 2, 1e-8);
  EXPECT_EQ(out[7], 0);
  set(302095, Y), set(302096, X), set(302098, 2), set(302100, 1), set(302101, 1);
  set(302104, 700010), set.table(700010, {0.01, -0.01});
  // The second: constant 0.01 deg while Y goes up, -0.01 down; arm z = 300 from 0.
  const auto both = Channel(p).run({0, 0, 300, 0, 1, 300, 0, 0, 300}, 3);
  EXPECT_NEAR(both[3], 0.052359878, 1e-8);
  EXPECT_NEAR(both[6], -0.052359878, 1e-8);
}

// Offset 0 10 30 um at 20 30 40 degrees: 20 um at 35. Slope 0 0.1 mm/m at 20 40: at 30 degrees 0.05 mm/m, at
// 500 mm from the reference point 25 um. Rates: 5 um and 5 um/m in one cycle.
TEST(TableKinds, ThermalCompensationFollowsTheTemperaturesOfItsSensors) {
  auto p = axes({X});
  Set set{p};
  set(300005, 3), set(300006, 100), set(300017, 0.005);
  set(300007, 20), set(300008, 3), set(300009, 10), set(300010, 3), set.table(700000, {0, 0.01, 0.03});
  set(300012, 20), set(300013, 2), set(300014, 20), set(300015, 0), set(300016, 700010);
  set.table(700010, {0, 0.1});
  set(10953, 35), set(10950, 30);
  Channel channel(p);
  const auto out = channel.run(std::vector<double>(12, 600), 1);
  EXPECT_NEAR(out[0], 600 + 0.005 + 0.005e-3 * 500, 1e-12) << "one step of each";
  EXPECT_NEAR(out[11], 600 + 0.020 + 0.05e-3 * 500, 1e-12);
}

// 1 ms cycles, 24000 mm/min = 0.4 mm a cycle: faster than that is rapid traverse.
TEST(TableKinds, InRapidTraverseBacklashHasAnotherValue) {
  auto p = axes({X});
  Set set{p};
  set(300000, 2), set(300001, 0.02), set(300003, 0.03), set(300002, 1);
  expect_rows(Channel(p).run({0, 0.4, 0.3, 0.2, -0.3, -0.8, -0.9, 0}, 1),
              {0, 0.4, 0.28, 0.18, -0.33, -0.83, -0.92, 0});
}

// Delay 2, rise 10, fall 20 cycles of 1 ms: half of the amount 2 + 5 and 2 + 10 + 10 cycles after the first
// cycle of the new direction, all of it after 12, nothing until 2 and from 32 on.
TEST(TableKinds, AReversalAddsAPulseInTheNewDirection) {
  auto p = axes({X});
  Set set{p};
  set(300110, 1), set(300111, 0.01), set(300112, 2), set(300113, 10), set(300114, 20);
  Channel channel(p);
  std::vector<double> x{0, 1};
  for (int i = 0; i <= 40; ++i) x.push_back(-0.1 * i);
  const auto out = channel.run(x, 1);
  const auto added = [&](std::size_t age) { return out[2 + age] - x[2 + age]; };
  for (const std::size_t age : {0u, 1u, 2u, 32u, 33u, 40u}) EXPECT_EQ(added(age), 0) << age;
  for (const std::size_t age : {7u, 22u}) EXPECT_NEAR(added(age), -0.005, 1e-12) << age;
  EXPECT_NEAR(added(12), -0.01, 1e-12);
}

TEST(TableKinds, ASlaveHasItsOwnSquarenessAndReversal) {
  auto p = axes({X, Y});
  Set set{p};
  p.values[100000] = {0, "X"}, p.values[101000] = {0, "Y1"}, p.values[102000] = {0, "Y2"};
  set(10050, 1), set(10051, 2), set(102100, 1), set(102101, 1), set(102129, 100);
  set(302030, 1), set(302031, X), set(302033, 0.01);
  Channel channel(p);
  const auto out = channel.run({300, 7}, 2);
  ASSERT_EQ(channel.out.axes.size(), 3u);
  EXPECT_EQ(out[1], 7);
  EXPECT_NEAR(out[2], 107 + 0.052359878, 1e-8);
}

TEST(TableKinds, MoreValuesThanPermittedAreRefused) {
  auto p = axes({X, Y});
  Set set{p};
  set(300020, 2), set(300022, 30), set(910, 100);
  EXPECT_EQ(refusal(p), "");
  set(301020, 1), set(301022, 41);
  EXPECT_EQ(refusal(p),
            "parameter 000910 (volumetric_values_maximum) permits 100 values in all tables of a channel; "
            "there are 101 or more");
  set(301022, 40);
  EXPECT_EQ(refusal(p), "");
}

TEST(TableKinds, WhatMakesNoSenseNamesItsParameter) {
  using testing::HasSubstr;
  const auto with = [](const std::vector<std::pair<std::uint32_t, double>>& values) {
    auto p = axes({X, Y});
    for (const auto& [number, value] : values) p.values[number] = {value, ""};
    return refusal(p);
  };
  EXPECT_THAT(with({{300020, 1}, {300022, 2}, {300026, 709999}}),
              HasSubstr("parameter 300026 (pitch_table) is 709999: 2 values end after 709999"));
  EXPECT_THAT(with({{300030, 1}, {300031, 5}}),
              HasSubstr("parameter 300031 (squareness_first_axis) is 5: channel 0 has no such axis"));
  EXPECT_THAT(with({{300051, 1}, {300053, 2}, {300050, 1}}),
              HasSubstr("parameter 300054 (straightness_first_interval) must be above 0"));
  EXPECT_THAT(with({{300083, 1}, {300085, 2}, {300086, 1}, {300080, 1}}),
              HasSubstr("parameter 300081 (angle_first_compensated) is -1"));
  EXPECT_THAT(with({{300005, 1}, {300008, 2}, {300009, 1}}),
              HasSubstr("parameter 300010 (thermal_offset_sensor) must be the number of a sensor, 0 .. 15"));
}

// Values at 0, 30 ... over Y, which turns: of its own, and of X over Y.
TEST(TableKinds, ATableOverAnAxisThatCountsModulo360RepeatsWithItsTurn) {
  const auto with = [](double way, double modulo, double points, double interval) {
    auto p = axes({X, Y});
    Set set{p};
    set(101001, 3), set(101949, way);
    set(301020, 1), set(301021, 0), set(301022, points), set(301023, interval), set(301024, modulo);
    const auto own = refusal(p);
    set(301020, 0), set(300050, Y), set(300051, 1), set(300053, points), set(300054, interval);
    set(300055, modulo);
    EXPECT_EQ(own.empty(), refusal(p).empty()) << own;
    return own;
  };
  EXPECT_EQ(with(0, 0, 13, 30), "");
  for (const double way : {1.0, 2.0}) {
    EXPECT_EQ(with(way, 1, 12, 30), "");
    EXPECT_EQ(with(way, 1, 6, 10), "") << "six times in a turn";
    EXPECT_EQ(with(way, 0, 13, 30),
              "parameter 301024 (pitch_modulo) is 0 and the table 390 deg long; axis 1 counts modulo 360 "
              "(parameter 101949), so the table must repeat (1) after 360 deg or a whole part of it");
    EXPECT_NE(with(way, 0, 12, 30), "");
    EXPECT_NE(with(way, 1, 13, 30), "");
    EXPECT_NE(with(way, 1, 7, 30), "");
  }
}

}  // namespace
}  // namespace trunnion::compensation
