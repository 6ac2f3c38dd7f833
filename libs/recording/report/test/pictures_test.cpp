// SPDX-License-Identifier: Apache-2.0
// What the pictures of measurements draw: how many curves, where a value is in its batch.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "report/residual_picture.hpp"
#include "report/servo_pictures.hpp"
#include "report/truth_pictures.hpp"

namespace trunnion::report {
namespace {

using testing::HasSubstr;

std::size_t curves_of(const std::string& svg) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = svg.find("<polyline", at)) != std::string::npos; ++at) ++count;
  return count;
}

// Seven circles of the grid and two of readings; the largest deviation is 3 um, of 1, 2 or 5 um 2 are not
// above.
TEST(BallbarPictures, MagnifyTheLargestDeviation) {
  truth::BallbarMeasurement measured;
  measured.ccw = {{0, 0.003}, {90, 0}, {180, -0.001}};
  measured.cw = {{0, 0}, {90, 0}, {180, 0}};
  const auto svg = ballbar_picture(measured, "ac-table, plane XY");
  EXPECT_EQ(curves_of(svg), 9u);
  EXPECT_THAT(svg, HasSubstr("ac-table, plane XY"));
  EXPECT_THAT(svg, HasSubstr("; 2 um for each circle of the grid"));
}

// Two runs up and two down.
TEST(LaserPictures, DrawEveryRun) {
  truth::LaserMeasurement measured;
  measured.targets.push_back({0, {0.0, 0.0}, {0.0, 0.001}});
  measured.targets.push_back({100, {0.001, 0.002}, {0.003, 0.002}});
  const auto svg = laser_picture(measured, "ac-table EXX", 1e3, "um");
  EXPECT_EQ(curves_of(svg), 4u);
  EXPECT_THAT(svg, HasSubstr(">um</text>"));
}

// Before and after of X, Y and Z.
TEST(ResidualPictures, DrawBeforeAndAfter) {
  calibration::KinematicsResult result;
  result.poses.resize(3);
  result.poses[1].difference = calibration::Vec3(0.02, 0, 0);
  const auto svg = residual_picture(result, "a & b");
  EXPECT_EQ(curves_of(svg), 6u);
  EXPECT_THAT(svg, HasSubstr(">pose</text>"));
}

// Of 9000 points every third is drawn, so the last one, number 8997, is behind 2999 others.
TEST(ServoPictures, DrawAtMostFourThousandPointsOfACurve) {
  const auto curve = servo_analysis::over_time("speed", std::vector<double>(9000, 1.0), 0.001, 60);
  EXPECT_EQ(curve.points.back().y, 60);
  const auto svg = picture_of("X & Y", servo_analysis::Diagram{"s", "mm/min", {curve}});
  EXPECT_EQ(curves_of(svg), 1u);
  const auto begin = svg.find(" points=\""), end = svg.find("\"/>", begin);
  const auto points = svg.substr(begin, end - begin);
  EXPECT_EQ(std::count(points.begin(), points.end(), ','), 3000);
  EXPECT_THAT(svg, HasSubstr(">speed</text>"));
}

// Seven circles of the grid, that of the deviations and four lines at the quadrants.
TEST(ServoPictures, ShowWhatATestHasToShow) {
  servo_analysis::RoundnessFigures circle;
  for (int i = 0; i < 360; ++i) circle.points.push_back({static_cast<double>(i), 0.001});
  circle.quadrant_jump[1] = 0.0025;
  const auto svg = picture_of(servo_analysis::TestPicture{"roundness XY", circle});
  EXPECT_EQ(curves_of(svg), 12u);
  EXPECT_THAT(svg, HasSubstr(">2.5 um</text>"));
}

}  // namespace
}  // namespace trunnion::report
