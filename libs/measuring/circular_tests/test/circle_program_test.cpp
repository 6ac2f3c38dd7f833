// SPDX-License-Identifier: Apache-2.0
// The program of a circular test, the feed that it reaches, and the report with the letters of the axes.
#include "circular_tests/circle_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "circular_tests/circle_report.hpp"
#include "circular_tests/turns.hpp"

namespace trunnion::circular_tests {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

// At 30 deg the circle of 10 mm is 8.660254 and 5 mm beside its centre.
TEST(CircleProgram, GoesRadiallyToTheCircleAndBackInBothSenses) {
  CircleMotion motion;
  motion.centre = geometry::Vec3(1, 2, 3);
  motion.radius = 10, motion.start = 30, motion.overrun = 0;
  EXPECT_EQ(circle_program(motion, {{'X', 0.0}, {'Z', 40.0}}),
            "G17 G90 G94\n"
            "G53 G1 X1.000000 Y2.000000 Z3.000000 F6000\n"
            "G53 G1 X9.660254 Y7.000000 F1000.000\n"
            "G3 I-8.660254 J-5.000000 F1000.000\n"
            "G53 G1 X1.000000 Y2.000000 F6000\n"
            "G53 G1 X9.660254 Y7.000000 F1000.000\n"
            "G2 I-8.660254 J-5.000000 F1000.000\n"
            "G53 G1 X1.000000 Y2.000000 F6000\n"
            "G53 G1 X0.000000 F6000\n"
            "G53 G1 Z40.000000 F6000\n"
            "G17\nM30\n");
}

// From -45 deg a turn and then to 45 deg: 10 / sqrt 2 = 7.071068 mm beside the centre. In G18 the sense is
// the other one.
TEST(CircleProgram, RunsOverAtBothEnds) {
  CircleMotion motion;
  motion.plane = "XZ", motion.radius = 10;
  const auto program = circle_program(motion, {});
  EXPECT_THAT(program, HasSubstr("G18 G90 G94\n"));
  EXPECT_THAT(program, HasSubstr("G53 G1 X7.071068 Z-7.071068 F1000.000\nG2 I-7.071068 K7.071068 F1000.000\n"
                                 "G91 G2 X0.000000 Z14.142136 I-7.071068 K7.071068\nG90\n"));
  EXPECT_THAT(program, HasSubstr("G3 I-7.071068 K-7.071068 F1000.000\n"));
}

TEST(CircleProgram, HasThePlaneOfItsAxes) {
  EXPECT_EQ(plane_of("YZ").first, 1u);
  EXPECT_EQ(plane_of("YZ").second, 2u);
}

// Ten steps of 0.1 mm in 1 ms each are 100 mm/s.
TEST(FeedReached, IsThatOfTheTurnAlone) {
  std::vector<PlanePoint> commanded;
  for (int i = 0; i < 100; ++i) commanded.push_back({i < 50 ? 0 : 0.1 * (i - 50), 0});
  EXPECT_NEAR(feed_reached(commanded, {60, 71, 1, 0, 0}, 0.001), 6000, 1e-6);
}

TEST(CircleReport, NamesTheAxesOfItsPlane) {
  std::vector<RadialReading> ccw, cw;
  for (int i = 0; i < 360; ++i) ccw.push_back({1.0 * i, 0}), cw.push_back({-1.0 * i, 0});
  const auto report = circle_report("YZ", 100, ccw, cw);
  std::vector<std::string> names;
  for (const auto& share : report.shares) names.push_back(share.name);
  EXPECT_THAT(names, UnorderedElementsAre("squareness", "scale mismatch", "servo mismatch", "lost motion Y",
                                          "lost motion Z", "spike Y", "spike Z"));
  EXPECT_NEAR(report.figures.bidirectional, 0, 1e-9);
}

}  // namespace
}  // namespace trunnion::circular_tests
