// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/spindle_sync_evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace trunnion::servo_analysis {
namespace spindle_sync_evaluation_test {
namespace {

using testing::HasSubstr;

// Both spindles, coupled, cycle by cycle; the slave follows the other way round with `reverse`.
struct Coupled {
  explicit Coupled(double ordered, bool opposite = false, double added = 0)
      : speed(ordered), reverse(opposite), angle(added) {}
  // The slave is `error` deg behind the angle that belongs to the master.
  void one(double error, bool cycle, double interval) {
    time += interval, master += speed / 60 * interval;
    const double wanted = (reverse ? -1 : 1) * (master + angle / 360);
    record.angles.push_back({time, master, wanted - error / 360 + 7, cycle});
    record.reports.push_back({record.angles.size() - 1, true, speed, error / 360 + slipped, correction});
  }
  void add(int cycles, const std::function<double(double)>& error) {
    for (int i = 0; i < cycles; ++i) one(error(i * 0.001), true, 0.001);
  }
  void add(int cycles, double error) {
    add(cycles, [error](double) { return error; });
  }
  double speed;
  bool reverse;
  double angle;
  double time = 100, master = 0, correction = 0, slipped = 0;
  SpindleSyncRecord record;
};

// 1 s, then 2 s that count.
SpindleSyncSettings settings_with(double window) {
  SpindleSyncSettings settings;
  settings.window = window, settings.settling = 1, settings.record = 2;
  return settings;
}

TestFindings findings_of(const Coupled& spindles, double window = 1, double next = 0) {
  const auto settings = settings_with(window);
  return spindle_sync_findings(spindles.speed, next, spindle_sync_figures(spindles.record, settings),
                               settings);
}

std::vector<std::string> failed(const TestFindings& findings) {
  std::vector<std::string> names;
  for (const auto& f : findings.figures)
    if (!f.reached()) names.push_back(f.name);
  return names;
}

// 0.1 % of 2000 1/min are 2 1/min: with 500 1/min for a turn 2 / 500 of a turn, which is 1.44 deg.
TEST(SpindleSync, ASlaveThatIsSlowLagsByItsSpeedOverTheGain) {
  Coupled spindles(2000);
  spindles.add(3000, 1.44);
  const auto steady = spindle_sync_figures(spindles.record, settings_with(1)).steady;
  EXPECT_NEAR(steady.master_speed, 2000, 1e-6);
  EXPECT_NEAR(steady.mean, 1.44, 1e-9);
  EXPECT_NEAR(steady.peak, 1.44, 1e-9);
  EXPECT_NEAR(steady.deviation, 0, 1e-9);
  EXPECT_NEAR(steady.drift, 0, 1e-9);
  EXPECT_FALSE(steady.growth);
  EXPECT_NEAR(steady.slow, 2, 1e-9);
  EXPECT_NEAR(steady.lag_without_integral, 1.44, 1e-9);
  EXPECT_NEAR(steady.drive_difference, 0, 1e-9);
  const auto findings = findings_of(spindles);
  EXPECT_THAT(failed(findings), testing::ElementsAre("S2000 largest error"));
  EXPECT_THAT(findings.notes.at(0), HasSubstr("spindle_integral 1"));
  EXPECT_TRUE(findings_of(spindles, 1.5).reached());
}

// The integral action adds these 2 1/min. A gain of 100 1/min would leave 2 / 100 of a turn, 7.2 deg.
TEST(SpindleSync, TheCorrectionSaysHowFarTheSlaveWouldLagWithoutIt) {
  Coupled spindles(2000);
  spindles.correction = 2;
  spindles.add(3000, 0.0);
  auto settings = settings_with(1);
  EXPECT_NEAR(spindle_sync_figures(spindles.record, settings).steady.lag_without_integral, 1.44, 1e-9);
  settings.gain = 100;
  const auto steady = spindle_sync_figures(spindles.record, settings).steady;
  EXPECT_NEAR(steady.correction, 2, 1e-12);
  EXPECT_NEAR(steady.slow, 2, 1e-9);
  EXPECT_NEAR(steady.lag_without_integral, 7.2, 1e-9);
  EXPECT_TRUE(findings_of(spindles).reached());
}

// 0.36 deg are a thousandth of a turn, 0.5 1/min. The slave turns counterclockwise and should be further
// clockwise: it is fast.
TEST(SpindleSync, TheOtherWayRoundTheAngleCountsFromTheMirroredMaster) {
  Coupled spindles(600, true, 90);
  spindles.add(3000, 0.36);
  auto settings = settings_with(1);
  settings.reverse = true, settings.angle = 90;
  const auto steady = spindle_sync_figures(spindles.record, settings).steady;
  EXPECT_NEAR(steady.mean, 0.36, 1e-9);
  EXPECT_NEAR(steady.slow, -0.5, 1e-9);
}

// Six periods in 2 s: 1.2 deg over the root of 2 are 0.8485 deg. A straight line through six periods rises by
// 6 * 1.2 / (6 pi), 0.38 deg.
TEST(SpindleSync, AnOscillationBeyondTheWindowFails) {
  Coupled spindles(1000);
  spindles.add(3000, [](double t) { return 1.2 * std::sin(2 * std::numbers::pi * 3 * t); });
  const auto steady = spindle_sync_figures(spindles.record, settings_with(1)).steady;
  EXPECT_NEAR(steady.deviation, 0.8485, 1e-3);
  EXPECT_NEAR(std::abs(steady.drift), 0.382, 2e-3);
  const auto findings = findings_of(spindles);
  EXPECT_THAT(failed(findings), testing::ElementsAre("S1000 largest error"));
  EXPECT_THAT(findings.notes.at(0), HasSubstr("the error oscillates"));
}

// It grows by e = 2.718 in each second, and is 0.74 deg at the end.
TEST(SpindleSync, AnOscillationThatGrowsFailsWithinTheWindow) {
  Coupled spindles(1000);
  spindles.add(3000, [](double t) { return 0.1 * std::exp(t - 1) * std::sin(2 * std::numbers::pi * 5 * t); });
  const auto figures = spindle_sync_figures(spindles.record, settings_with(1));
  ASSERT_TRUE(figures.steady.growth);
  EXPECT_NEAR(*figures.steady.growth, 2.718, 0.1);
  const auto findings = findings_of(spindles);
  EXPECT_THAT(failed(findings), testing::ElementsAre("S1000 growth of the oscillation"));
  EXPECT_THAT(findings.notes.at(0), HasSubstr("grows"));
}

// 0.3 deg in a second, 0.6 in the recording: more than half of the window of 1 deg.
TEST(SpindleSync, ADriftFailsWithinTheWindow) {
  Coupled spindles(1000);
  spindles.add(3000, [](double t) { return 0.3 * (t - 2); });
  const auto steady = spindle_sync_figures(spindles.record, settings_with(1)).steady;
  EXPECT_NEAR(steady.drift, 0.3 * 1.999, 1e-6);
  const auto findings = findings_of(spindles);
  EXPECT_THAT(failed(findings), testing::ElementsAre("S1000 drift in the recording"));
  EXPECT_THAT(findings.notes.at(0), HasSubstr("drifts"));
}

// 10 deg for 0.3 s while the loop closes, then 0.5 deg: the first angle within the window is the 301st.
TEST(SpindleSync, TheTimeToSynchronizeEndsWhereTheErrorStaysWithinTheWindow) {
  Coupled spindles(1000);
  spindles.add(300, 10.0);
  spindles.add(2800, 0.5);
  spindles.record.reports.front().follows = false;
  const auto figures = spindle_sync_figures(spindles.record, settings_with(1));
  ASSERT_TRUE(figures.synchronized);
  EXPECT_NEAR(*figures.synchronized, 0.299, 1e-9) << "it follows from the second cycle on";
  ASSERT_FALSE(figures.course.empty());
  EXPECT_NEAR(figures.course.front().x, 0.299, 1e-9);
  EXPECT_NEAR(figures.course.front().y, 0.5, 1e-9);
  EXPECT_FALSE(figures.step);
}

// The order comes with the last cycle of the dwell. 50 angles 10 ms apart, 100 cycles outside and the one
// that is within: 0.601 s.
TEST(SpindleSync, AStepOfTheSpeedHasItsLargestErrorAndTheTimeUntilItIsBack) {
  Coupled spindles(2000);
  spindles.add(3100, 0.1);
  spindles.speed = 3000;
  for (int i = 0; i < 50; ++i) spindles.one(-4, false, 0.01);
  spindles.add(100, -2.0);
  spindles.add(900, 0.1);
  const auto settings = settings_with(1);
  const auto figures = spindle_sync_figures(spindles.record, settings);
  EXPECT_NEAR(figures.steady.master_speed, 2000, 1e-6);
  ASSERT_TRUE(figures.step);
  EXPECT_NEAR(figures.step->largest, 4, 1e-9);
  ASSERT_TRUE(figures.step->back);
  EXPECT_NEAR(*figures.step->back, 0.601, 1e-9);
  EXPECT_NEAR(figures.step->at_end, 0.1, 1e-9);
  EXPECT_NEAR(figures.step->speed, 3000, 1e-6);
  EXPECT_NEAR(figures.step->resolution, 0.01, 1e-9);
  const auto findings = spindle_sync_findings(2000, 3000, figures, settings);
  EXPECT_TRUE(findings.reached());
  EXPECT_EQ(findings.figures.back().name, "S2000 to S3000 error at the end");
  EXPECT_EQ(findings.figures.back().most, 1.0);
}

TEST(SpindleSync, AStepFromWhichTheSlaveDoesNotComeBackFails) {
  Coupled spindles(2000);
  spindles.add(3100, 0.1);
  spindles.speed = 3000;
  spindles.add(1000, 5.0);
  const auto settings = settings_with(1);
  const auto figures = spindle_sync_figures(spindles.record, settings);
  ASSERT_TRUE(figures.step);
  EXPECT_FALSE(figures.step->back);
  const auto findings = spindle_sync_findings(2000, 3000, figures, settings);
  EXPECT_THAT(failed(findings), testing::ElementsAre("S2000 to S3000 error at the end"));
  EXPECT_THAT(findings.notes.back(), HasSubstr("does not come back"));
}

TEST(SpindleSync, AStepThatDoesNotComeIsNoted) {
  Coupled spindles(2000);
  spindles.add(3100, 0.1);
  EXPECT_THAT(findings_of(spindles, 1, 3000).notes.back(),
              HasSubstr("no change of the master's speed to 3000"));
}

// A whole turn: the angles are where they should be, the turns are not.
TEST(SpindleSync, ADriveThatReportsAnotherErrorIsNoted) {
  Coupled spindles(1000);
  spindles.slipped = 1;
  spindles.add(3000, 0.0);
  EXPECT_NEAR(spindle_sync_figures(spindles.record, settings_with(1)).steady.drive_difference, 360, 1e-9);
  EXPECT_THAT(findings_of(spindles).notes.back(), HasSubstr("360.000 deg"));
}

TEST(SpindleSync, AMasterWithAnotherSpeedIsNoted) {
  Coupled spindles(1600);
  spindles.add(3000, 0.0);
  const auto settings = settings_with(1);
  const auto findings =
      spindle_sync_findings(2000, 0, spindle_sync_figures(spindles.record, settings), settings);
  EXPECT_THAT(findings.notes.back(), HasSubstr("1600.0 1/min"));
}

TEST(SpindleSync, NeedsACouplingAndEveryCycleOfTheRecording) {
  Coupled spindles(1000);
  spindles.add(2999, 0.0);
  EXPECT_THROW(spindle_sync_figures(spindles.record, settings_with(1)), std::runtime_error);
  spindles.add(1, 0.0);
  EXPECT_NO_THROW(spindle_sync_figures(spindles.record, settings_with(1)));
  for (auto& report : spindles.record.reports) report.follows = false;
  EXPECT_THROW(spindle_sync_figures(spindles.record, settings_with(1)), std::runtime_error);
}

TEST(SpindleSync, TheWindowIsDrawnAroundTheTime) {
  const auto curve = window_curve(0.5, 8);
  ASSERT_EQ(curve.points.size(), 5u);
  EXPECT_EQ(curve.points[1].x, 8);
  EXPECT_EQ(curve.points[2].y, -0.5);
}

}  // namespace
}  // namespace spindle_sync_evaluation_test
}  // namespace trunnion::servo_analysis
