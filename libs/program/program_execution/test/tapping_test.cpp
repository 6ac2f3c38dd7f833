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

TEST(Tapping, TheOverrideDoesNotTakeTheSpindleAboveItsHighestSpeed) {
  EXPECT_EQ(Tapping::override_of(1.5, 500, 0), 1.5) << "no limit";
  EXPECT_EQ(Tapping::override_of(1.5, 500, 750), 1.5);
  EXPECT_EQ(Tapping::override_of(1.5, 500, 625), 1.25) << "625 by 500";
  EXPECT_EQ(Tapping::override_of(0.5, 500, 625), 0.5);
  EXPECT_EQ(Tapping::override_of(1, 500, 500), 1);
}

}  // namespace
}  // namespace trunnion::program_execution
