// SPDX-License-Identifier: Apache-2.0
// A zone that a program forbids, anywhere on the way of a move.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "reading.hpp"

namespace trunnion::channel_setup {
namespace {

using language::Command;
using language::CommandKind;
using language::StrokeZone;

/// X, Y and Z from `low` to `high`.
StrokeZone box(language::Vector3 low, language::Vector3 high) {
  StrokeZone zone;
  zone.active = true;
  zone.bounded = {true, true, true};
  zone.low = low;
  zone.high = high;
  return zone;
}

Command move_to(CommandKind kind, const AxisValues& target) {
  Command move;
  move.kind = kind;
  move.target = target;
  return move;
}

struct Zone : testing::Test {
  ChannelSetup machine = test::setup_of("ac-table");
  std::string error(const AxisValues& from, const Command& move, const StrokeZone& zone,
                    const AxisValues& offset = {}) const {
    return machine.zone_error(from, move, zone, offset);
  }
};

TEST_F(Zone, ALineIsStoppedWhereItEntersTheBox) {
  const auto zone = box({50, -5, -5}, {60, 5, 5});
  EXPECT_EQ(error({}, move_to(CommandKind::rapid, {100}), zone),
            "it would enter it at X 50.0000 Y 0.0000 Z 0.0000");
  // From (0, 20) to (100, -20) it crosses Y 5 at X 37.5 and comes to X 50 at Y 0.
  EXPECT_EQ(error({0, 20}, move_to(CommandKind::line, {100, -20}), zone),
            "it would enter it at X 50.0000 Y 0.0000 Z 0.0000");
  // To (100, 0) it is at Y 5 at X 75, behind the box.
  EXPECT_EQ(error({0, 20}, move_to(CommandKind::line, {100, 0}), zone), "");
  EXPECT_EQ(error({0, 5}, move_to(CommandKind::line, {100, 5}), zone), "") << "along a side is not inside";
  EXPECT_EQ(error({0, 0}, move_to(CommandKind::line, {50, 0}), zone), "") << "up to it, too";
  EXPECT_NE(error({55}, move_to(CommandKind::line, {200}), zone), "") << "nor out of it: G23 first";
}

TEST_F(Zone, AxesWithoutSidesAreNotLookedAt) {
  StrokeZone zone = box({50, 0, 0}, {60, 0, 0});
  zone.bounded = {true, false, false};
  EXPECT_EQ(error({0, 200, -100}, move_to(CommandKind::line, {100, 200, -100}), zone),
            "it would enter it at X 50.0000");
}

// A half circle of radius 100 about 0 has its top at (0, 100).
TEST_F(Zone, AnArcIsLookedAtBetweenItsEnds) {
  Command move = move_to(CommandKind::arc, {-100});
  move.arc.sweep = 180;
  EXPECT_NE(error({100}, move, box({-1, 99.999, -1}, {1, 120, 1})), "");
  EXPECT_EQ(error({100}, move, box({-1, 100.001, -1}, {1, 120, 1})), "");
  // Within the chord of the arc, but not on it.
  EXPECT_EQ(error({100}, move, box({-50, -10, -1}, {50, 50, 1})), "");
}

// C takes the point (300, 150) over X = sqrt(300^2 + 150^2) = 335.41, from X 300 at C0 to X 279.9 at C60.
TEST_F(Zone, TheSwingOfATipThatIsHeldIsLookedAt) {
  Command move = move_to(CommandKind::line, {300, 150, 0, 0, 0, 60});
  move.modal.transformation = language::Transformation::rtcp;
  StrokeZone zone = box({335.4, 0, 0}, {340, 0, 0});
  zone.bounded = {true, false, false};
  EXPECT_NE(error({300, 150}, move, zone), "");
  zone.low[0] = 335.42;
  EXPECT_EQ(error({300, 150}, move, zone), "");
}

TEST_F(Zone, OutsideOfTheBoxIsForbiddenLikewise) {
  StrokeZone zone = box({-50, -50, -50}, {50, 50, 50});
  zone.outside = true;
  EXPECT_EQ(error({}, move_to(CommandKind::line, {50, -50, 50}), zone), "");
  EXPECT_EQ(error({}, move_to(CommandKind::line, {60}), zone),
            "X would go to 60.0000, its zone is -50.0000 .. 50.0000");
  // The half circle from (40, 0) to (-40, 0) about (0, 0), and one of radius 60 that starts outside.
  Command arc = move_to(CommandKind::arc, {-40});
  arc.arc.sweep = 180;
  EXPECT_EQ(error({40}, arc, zone), "");
  zone.high[1] = 39.999;
  EXPECT_NE(error({40}, arc, zone), "");
}

TEST_F(Zone, AHandwheelOffsetShiftsTheWay) {
  const auto zone = box({50, 5, -5}, {60, 15, 5});
  EXPECT_EQ(error({}, move_to(CommandKind::line, {100}), zone), "");
  EXPECT_NE(error({}, move_to(CommandKind::line, {100}), zone, {0, 10}), "");
}

// Random arcs against points of the circle 0.05 degrees apart.
TEST_F(Zone, RandomArcsAreStoppedWhereTheirPointsAreInTheBox) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-150, 150), radius(10, 100), size(1, 60), turn(5, 700);
  int entered = 0;
  for (int i = 0; i < 400; ++i) {
    const double r = radius(random), sweep = turn(random), x = place(random), y = place(random);
    const double low_x = place(random), low_y = place(random);
    const auto zone = box({low_x, low_y, -1}, {low_x + size(random), low_y + size(random), 1});
    const auto point = [&](double degrees) {
      const double angle = degrees * std::numbers::pi / 180;
      return AxisValues{x + r * std::cos(angle), y + r * std::sin(angle)};
    };
    Command move = move_to(CommandKind::arc, point(sweep));
    move.arc.centre = {x, y, 0};
    move.arc.sweep = sweep;
    double depth = -1e9;  // how far the deepest point is inside of all sides
    for (double degrees = 0; degrees <= sweep; degrees += 0.05) {
      const AxisValues p = point(degrees);
      depth = std::max(depth, std::min({p[0] - zone.low[0], zone.high[0] - p[0], p[1] - zone.low[1],
                                        zone.high[1] - p[1]}));
    }
    // Between two points the circle bends by less than 1e-5 of its radius; at 0.05 degrees they are 0.09 mm
    // apart.
    if (std::abs(depth) < 0.1) continue;
    EXPECT_EQ(error(point(0), move, zone) != "", depth > 0) << i << " " << depth;
    entered += depth > 0 ? 1 : 0;
  }
  EXPECT_GT(entered, 30);
}

}  // namespace
}  // namespace trunnion::channel_setup
