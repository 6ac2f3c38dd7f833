// SPDX-License-Identifier: Apache-2.0
// The limits of programmed circles. Streams of ordinary arcs are in interpreter_test.cpp.
#include "language/arc_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trunnion::language {
namespace {

constexpr double deviation = 0.1;

TEST(ArcFromCentre, RadiiMayDifferByTheDeviationAndNotMore) {
  Arc arc;
  // Start radius 5 about (5, 0); the end on the far side at 10.1 has 5.1 within rounding.
  EXPECT_EQ(arc_from_centre({}, {10.0999}, {5, 0, 0}, 1, deviation, arc), AlarmNumber::none);
  EXPECT_NEAR(arc.sweep, 180, 1e-9);
  EXPECT_EQ(arc_from_centre({}, {10.1001}, {5, 0, 0}, 1, deviation, arc), AlarmNumber::arc_radii_differ);
}

TEST(ArcFromCentre, EndNearTheStartIsAFullCircleOrAShortArc) {
  Arc arc;
  EXPECT_EQ(arc_from_centre({}, {0, 1e-7}, {5, 0, 0}, 1, deviation, arc), AlarmNumber::none);
  EXPECT_EQ(arc.sweep, 360);
  // About (5, 0) the start is at 180 degrees; anticlockwise from there leads downwards. 0.001 mm of 5 mm are
  // 0.0002 radians = 0.01146 degrees.
  EXPECT_EQ(arc_from_centre({}, {0, -0.001}, {5, 0, 0}, 1, deviation, arc), AlarmNumber::none);
  EXPECT_NEAR(arc.sweep, 0.01146, 1e-5);
  EXPECT_EQ(arc_from_centre({}, {0, 0.001}, {5, 0, 0}, 1, deviation, arc), AlarmNumber::none);
  EXPECT_NEAR(arc.sweep, 359.98854, 1e-5);
}

TEST(ArcFromCentre, EndOnTheStartsRayIsAFullTurn) {
  Arc arc;
  EXPECT_EQ(arc_from_centre({}, {0.05}, {5, 0, 0}, 1, deviation, arc), AlarmNumber::none);
  EXPECT_EQ(arc.sweep, 360);
}

TEST(ArcFromRadius, HalfCircleForgivesARadiusThatIsALittleShort) {
  for (const bool clockwise : {false, true}) {
    for (const double radius : {5.0, 4.9001, -4.9001, -5.0}) {
      Arc arc;
      arc.clockwise = clockwise;
      ASSERT_EQ(arc_from_radius({}, {10, 0, 3}, radius, 1, deviation, arc), AlarmNumber::none);
      EXPECT_EQ(arc.sweep, 180);
      EXPECT_EQ(arc.centre[0], 5);
      EXPECT_EQ(arc.centre[1], 0);
      EXPECT_EQ(arc.centre[2], 0);
    }
  }
  Arc arc;
  EXPECT_EQ(arc_from_radius({}, {10}, 4.8999, 1, deviation, arc), AlarmNumber::arc_radius_too_small);
}

TEST(ArcFromRadius, CentreIsOnTheSideTheDirectionAndTheSignSay) {
  // Chord 6 along +X, radius 5: the centre is 4 from it. Anticlockwise and short: left, that is +Y.
  struct Case {
    bool clockwise;
    double radius;
    double centre_y;
  };
  for (const Case& c : {Case{false, 5, 4}, {false, -5, -4}, {true, 5, -4}, {true, -5, 4}}) {
    Arc arc;
    arc.clockwise = c.clockwise;
    ASSERT_EQ(arc_from_radius({}, {6}, c.radius, 1, deviation, arc), AlarmNumber::none);
    EXPECT_NEAR(arc.centre[0], 3, 1e-12);
    EXPECT_NEAR(arc.centre[1], c.centre_y, 1e-12);
    // 2 asin(3 / 5) = 73.7397952917 degrees.
    EXPECT_NEAR(arc.sweep, c.radius > 0 ? 73.7397952917 : 360 - 73.7397952917, 1e-9);
  }
}

// From (10, 0) about the zero over 300 degrees: Y turns back at 90 and 270 degrees, X at 0 and 180.
TEST(TurningShares, AreWhereACircleTurnsBackAlongAnAxis) {
  Arc arc;
  arc.sweep = 300;
  for (const bool clockwise : {false, true}) {
    arc.clockwise = clockwise;
    EXPECT_NEAR(turning_shares({10}, arc, Y)[0], 0.3, 1e-12);
    EXPECT_NEAR(turning_shares({10}, arc, Y)[1], 0.9, 1e-12);
  }
  EXPECT_NEAR(turning_shares({10}, arc, X)[1], 0.6, 1e-12);
  EXPECT_EQ(turning_shares({10}, arc, Z)[0], -1) << "the circle is across it";
  arc.sweep = 60;
  EXPECT_EQ(turning_shares({10}, arc, Y)[0], -1) << "it ends before";
  // From (6, 8) anticlockwise it is 90 - atan(8 / 6) = 36.87 degrees to the largest Y, a tenth of 368.7.
  arc.sweep = 10 * (90 - std::atan2(8, 6) * degrees_per_radian);
  arc.clockwise = false;
  EXPECT_NEAR(turning_shares({6, 8}, arc, Y)[0], 0.1, 1e-12);
}

TEST(PlaneAxes, TheThirdIsTheRightHandedNormal) {
  EXPECT_EQ(plane_axes(Plane::xy).normal, Z);
  EXPECT_EQ(plane_axes(Plane::zx).first, Z);
  EXPECT_EQ(plane_axes(Plane::zx).normal, Y);
  EXPECT_EQ(plane_axes(Plane::yz).normal, X);
}

}  // namespace
}  // namespace trunnion::language
