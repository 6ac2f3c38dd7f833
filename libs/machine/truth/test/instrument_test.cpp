// SPDX-License-Identifier: Apache-2.0
#include "truth/instrument.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "circular_tests/ballbar_causes.hpp"
#include "outline.hpp"
#include "truth/ballbar.hpp"
#include "truth/position_accuracy.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::truth {
namespace {

TrueGeometry geometry_of(const std::string& text) {
  return make_geometry(parse_truth(text, "truth.yaml", ac).geometry, ac, "truth.yaml");
}

struct Ballbar {
  circular_tests::CircularFigures figures;
  circular_tests::BallbarCauses causes;
};

// Both circles in the plane XY; a lag of each axis in seconds at `speed` mm/s.
Ballbar ballbar(const TrueGeometry& geometry, double lag_x = 0, double lag_y = 0, double speed = 0) {
  BallbarPath path;
  path.centre = {20, -30, -100};
  path.radius = 150;
  std::vector<circular_tests::RadialReading> readings[2];
  for (const int sense : {1, -1})
    for (std::size_t i = 0; i < path.points; ++i) {
      const double angle = sense * 360.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(path.points);
      const double rate = sense * speed / path.radius * 180 / std::numbers::pi;  // deg/s
      const auto at = [](double degrees) { return degrees * std::numbers::pi / 180; };
      MachinePose pose;
      pose.positions[0] = path.centre.x() + path.radius * std::cos(at(angle - rate * lag_x));
      pose.positions[1] = path.centre.y() + path.radius * std::sin(at(angle - rate * lag_y));
      pose.positions[2] = path.centre.z();
      pose.approach[0] = -sense * std::sin(at(angle)) > 0 ? 1 : -1;
      pose.approach[1] = sense * std::cos(at(angle)) > 0 ? 1 : -1;
      readings[sense < 0].push_back({angle, ballbar_deviation(path, geometry.pose(pose).tip)});
    }
  return {circular_tests::circular_figures(readings[0], readings[1], path.radius),
          circular_tests::ballbar_causes(readings[0], readings[1], path.radius)};
}

TEST(Ballbar, FindsAKnownSquarenessWithinTwoPercent) {
  const auto found = ballbar(geometry_of("axes: {Y: {C0Y_urad: 40}}\n"));
  EXPECT_NEAR(found.causes.squareness, 40e-6, 0.02 * 40e-6);
  // dr = -R g sin cos: from -R g / 2 to R g / 2, 6 um.
  EXPECT_NEAR(found.figures.deviation_ccw, 150 * 40e-6, 0.02 * 150 * 40e-6);
  EXPECT_NEAR(found.causes.reversal_first, 0, 1e-5);
  EXPECT_NEAR(found.causes.scale_mismatch, 0, 1e-7);
}

TEST(Ballbar, FindsAKnownLostMotionOfEachAxisWithinTwoPercent) {
  const auto found =
      ballbar(geometry_of("axes: {X: {EXX: [{reversal_um: -8}]}, Y: {EYY: [{reversal_um: -3}]}}\n"));
  EXPECT_NEAR(found.causes.reversal_first, 8e-3, 0.02 * 8e-3);
  EXPECT_NEAR(found.causes.reversal_second, 3e-3, 0.02 * 3e-3);
  EXPECT_NEAR(found.causes.squareness, 0, 1e-7);
}

TEST(Ballbar, FindsAKnownMismatchOfTheGainsWithinTwoPercentAndKeepsItApartFromSquareness) {
  // Kv 50 1/s against 40 1/s at 50 mm/s: 50 * (1/50 - 1/40) = -0.25 mm.
  const auto found = ballbar(geometry_of("axes: {Y: {C0Y_urad: 40}}\n"), 1 / 50.0, 1 / 40.0, 50);
  EXPECT_NEAR(found.causes.lag_mismatch, -0.25, 0.02 * 0.25);
  EXPECT_NEAR(found.causes.squareness, 40e-6, 0.02 * 40e-6);
}

TEST(Ballbar, FindsAKnownMismatchOfTheScalesAndTheCentre) {
  const auto found = ballbar(geometry_of("axes: {X: {EXX: [{polynomial_um: [5, 20], unit_mm: 1000}]}}\n"));
  EXPECT_NEAR(found.causes.scale_mismatch, 20e-6, 0.02 * 20e-6);
  // 5 um and 20 um/m * 0.02 m at the centre.
  EXPECT_NEAR(found.causes.centre_first, 5.4e-3, 1e-4);
  EXPECT_NEAR(found.figures.deviation_ccw, 150 * 20e-6, 0.03 * 150 * 20e-6);
}

TEST(Laser, ReadsPositionStraightnessAndAngleOfAnAxis) {
  const auto geometry = geometry_of(R"(
axes:
  X:
    EXX: [{polynomial_um: [0, 30]}]
    EYX: [{polynomial_um: [0, 0, 50]}]
    EBX: [{polynomial_urad: [0, 100]}]
)");
  const auto pose = [&](double x) {
    MachinePose p;
    p.positions[0] = x;
    return geometry.pose(p);
  };
  const LaserSetup setup{pose(0), Vec3::UnitX(), Vec3::UnitY()};
  const LaserSetup pitch{pose(0), Vec3::UnitZ(), Vec3::UnitX()};
  EXPECT_NEAR(laser_distance(setup, pose(200)), 200.006, 1e-9);
  EXPECT_NEAR(laser_straightness(setup, pose(200)), 2e-3, 1e-9);  // 50 um * 0.2^2
  EXPECT_NEAR(laser_angle(pitch, pose(200)), 20e-6, 1e-12);
  EXPECT_NEAR(dial(pose(0).tip, -Vec3::UnitY(), pose(200).tip), -2e-3, 1e-9);
}

TEST(Nest, ThreeSensorsGiveThePlaceOfTheBall) {
  const auto nest = Nest::at({10, 20, -300});
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(
          nest.directions[static_cast<std::size_t>(i)].dot(nest.directions[static_cast<std::size_t>(k)]),
          i == k ? 1 : 0, 1e-15);
  const Vec3 tip(10.012, 19.995, -300.003);
  const auto readings = nest.readings(tip);
  // The first looks along (0.816, 0, 0.577): 0.816 * 12 um - 0.577 * 3 um.
  EXPECT_NEAR(readings[0], 0.8164966 * 0.012 - 0.5773503 * 0.003, 1e-9);
  EXPECT_LE((nest.place(readings) - tip).norm(), 1e-12);
}

TEST(Instrument, HasItsNoiseItsResolutionAndItsSeed) {
  Instrument a({0.001, 0, 7}), b({0.001, 0, 7}), c({0.001, 0, 8});
  double sum = 0, squares = 0;
  constexpr int n = 20000;
  bool same = true;
  for (int i = 0; i < n; ++i) {
    const double value = a.read(5) - 5;
    EXPECT_EQ(value, b.read(5) - 5);
    same = same && value == c.read(5) - 5;
    sum += value, squares += value * value;
  }
  EXPECT_FALSE(same);
  EXPECT_NEAR(sum / n, 0, 5 * 0.001 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.001, 0.03 * 0.001);
  Instrument coarse({0, 0.01, 1});
  EXPECT_NEAR(coarse.read(1.2345), 1.23, 1e-12);
}

TEST(PositionAccuracy, HasTheFiguresOfTheStandard) {
  // Two targets. The first: up 1 and 3 (mean 2, s = sqrt 2), down -1 and -1 (mean -1, s = 0); the second: up
  // 4 and 4, down 3 and 3.
  const auto a = position_accuracy({{0, {1, 3}, {-1, -1}}, {100, {4, 4}, {3, 3}}});
  const double s = std::sqrt(2.0);
  EXPECT_DOUBLE_EQ(a.reversal, 3);
  EXPECT_DOUBLE_EQ(a.mean_reversal, 2);
  EXPECT_DOUBLE_EQ(a.repeatability, 2 * s + 3) << "larger than 4 s";
  EXPECT_DOUBLE_EQ(a.mean_bidirectional, 3.5 - 0.5);
  EXPECT_DOUBLE_EQ(a.systematic, 4 - -1);
  EXPECT_DOUBLE_EQ(a.accuracy, 2 + 2 * s - -1) << "2 + 2 s is above 4";
  EXPECT_THROW(position_accuracy({{0, {1}, {2, 3}}}), std::invalid_argument);
}

}  // namespace
}  // namespace trunnion::truth
