// SPDX-License-Identifier: Apache-2.0
#include "program_execution/tapping.hpp"

#include <gtest/gtest.h>

namespace trunnion::program_execution {
namespace {

language::Command stroke_to(double z, double lead, double speed = 0) {
  language::Command stroke;
  stroke.kind = language::CommandKind::tap;
  stroke.target[language::Z] = z;
  stroke.value = lead;
  stroke.spindle_speed = speed;
  stroke.modal.spindle_speed = 500;
  return stroke;
}

// 1.25 mm times 500 1/min in, times 1250 1/min out.
TEST(Tapping, AStrokeHasTheSpeedOfTheSpindleOrOneOfItsOwn) {
  const language::Command in = Tapping::line(stroke_to(-200, 1.25)),
                          out = Tapping::line(stroke_to(2, 1.25, 1250));
  EXPECT_EQ(in.kind, language::CommandKind::line);
  EXPECT_EQ(in.modal.feed, 625);
  EXPECT_EQ(out.modal.feed, 1562.5);
  EXPECT_EQ(Tapping::line(stroke_to(-200, -1.25)).modal.feed, 625) << "a left-hand thread";
}

// 202 mm by 1.25 mm.
TEST(Tapping, TheSpindleTurnsByTheLead) {
  Tapping tapping;
  AxisValues start{}, bottom{};
  start[language::Z] = 2, bottom[language::Z] = -200;
  tapping.begin(start, stroke_to(-200, 1.25));
  EXPECT_DOUBLE_EQ(tapping.revolutions(bottom), 161.6);
  EXPECT_EQ(tapping.revolutions(start), 0);
  tapping.begin(start, stroke_to(-200, -1.25));
  EXPECT_DOUBLE_EQ(tapping.revolutions(bottom), -161.6);
}

// 10 mm by 1.2 mm, clockwise, at 1.2 mm times 200 1/min.
TEST(Tapping, TheRemovalOfATapIsOneStrokeInItsDirection) {
  auto out = stroke_to(10, 1.2);
  out.modal.spindle_speed = 200;
  Tapping tapping;
  tapping.begin({}, out);
  EXPECT_DOUBLE_EQ(tapping.revolutions(out.target), 10 / 1.2);
  EXPECT_DOUBLE_EQ(Tapping::line(out).modal.feed, 240);
}

// 10 mm by 1.25 mm. X is as far away as a tilted plane rounds.
TEST(Tapping, AStrokeAlongASecondaryAxisTurnsTheSpindleByItsWay) {
  AxisValues start{};
  start[language::X] = 1, start[language::W] = 5;
  auto out = stroke_to(0, -1.25);
  out.target[language::X] = 1 + 1e-13, out.target[language::W] = 15;
  Tapping tapping;
  tapping.begin(start, out);
  AxisValues position = start;
  EXPECT_EQ(tapping.revolutions(position), 0);
  position[language::W] = 7.5;
  EXPECT_DOUBLE_EQ(tapping.revolutions(position), -2);
  position[language::Z] = 100;
  EXPECT_DOUBLE_EQ(tapping.revolutions(position), -2);
  EXPECT_DOUBLE_EQ(tapping.revolutions(out.target), -8);
  // As of the test below.
  motion::Limits limits;
  EXPECT_DOUBLE_EQ(tapping.limits(limits, 9000).axes[language::W].acceleration, 31.25);
  EXPECT_EQ(tapping.limits(limits, 9000).axes[language::Z].acceleration, limits.axes[0].acceleration);
  // The same object then taps along Z.
  tapping.begin({}, stroke_to(-10, 1.25));
  EXPECT_DOUBLE_EQ(tapping.limits(limits, 9000).axes[language::Z].acceleration, 31.25);
  EXPECT_DOUBLE_EQ(tapping.revolutions(stroke_to(-10, 1.25).target), 8);
}

// 1.25 mm times 9000 deg/s2 are 31.25 mm/s2, of 4500 deg/s2 half of that.
TEST(Tapping, TheAccelerationIsThatOfTheFastestSpeedOfTheHole) {
  EXPECT_EQ(Tapping::fastest(stroke_to(-20, 1.25), 0), 750) << "500 1/min with an override of 150 %";
  EXPECT_EQ(Tapping::fastest(stroke_to(-20, 1.25), 700), 700);
  auto in = stroke_to(-20, 1.25);
  in.hole_speed = 1250;
  EXPECT_EQ(Tapping::fastest(in, 0), 1875) << "it comes out at 1250 1/min";
  EXPECT_EQ(Tapping::fastest(in, 4000), 1875);
  in.hole_speed = 250;
  EXPECT_EQ(Tapping::fastest(in, 0), 750) << "it comes out more slowly";
  Tapping tapping;
  tapping.begin({}, in, 700);
  EXPECT_EQ(tapping.highest_speed(), 700);
  motion::Limits limits;
  EXPECT_DOUBLE_EQ(tapping.limits(limits, 9000).axes[language::Z].acceleration, 31.25);
  EXPECT_DOUBLE_EQ(tapping.limits(limits, 4500).axes[language::Z].acceleration, 15.625);
}

TEST(Tapping, TheOverrideDoesNotTakeTheSpindleAboveItsHighestSpeed) {
  EXPECT_EQ(Tapping::override_of(1.5, 500, 0), 1.5) << "no limit";
  EXPECT_EQ(Tapping::override_of(1.5, 500, 750), 1.5);
  EXPECT_EQ(Tapping::override_of(1.5, 500, 625), 1.25) << "625 by 500";
  EXPECT_EQ(Tapping::override_of(0.5, 500, 625), 0.5);
  EXPECT_EQ(Tapping::override_of(1, 500, 500), 1);
}

}  // namespace
}  // namespace trunnion::program_execution
