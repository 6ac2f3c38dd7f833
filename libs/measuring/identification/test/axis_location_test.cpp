// SPDX-License-Identifier: Apache-2.0
#include "identification/axis_location.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include "ac_machine.hpp"

namespace trunnion::identification {
namespace {

using truth::Vec3;

constexpr double tool_length = 100;

// Deviations of a ball by 4 x 4 matrices written here: a table C of direction -Z whose axis passes through
// (0, 0) is displaced by `shift` and inclined by `tilt` about the point (0, 0, -400).
std::vector<BallDeviation> deviations(const Vec3& ball, const Vec3& shift, const Vec3& tilt,
                                      std::size_t points, double noise = 0) {
  std::mt19937 random(5);
  std::normal_distribution<double> error(0, 1);
  std::vector<BallDeviation> readings;
  const Vec3 pivot(0, 0, -400);
  for (std::size_t i = 0; i < points; ++i) {
    BallDeviation reading;
    reading.angles[2] = 360.0 * static_cast<double>(i) / static_cast<double>(points);
    const Eigen::AngleAxisd turn(-reading.angles[2] * 3.14159265358979323846 / 180, Vec3::UnitZ());
    const Eigen::AngleAxisd lean(tilt.norm(), tilt.norm() > 0 ? Vec3(tilt.normalized()) : Vec3::UnitX());
    // The ball is fixed to the table; at zero it is where the control has it.
    const Vec3 here = turn * (ball - pivot) + pivot;
    const Vec3 at_zero = lean.inverse() * (ball - pivot - shift);
    const Vec3 there = lean * (turn * at_zero) + pivot + shift;
    // The tip is `here`; seen from the ball it is off by the negative.
    reading.deviation = here - there;
    if (noise > 0) reading.deviation += noise * Vec3(error(random), error(random), error(random));
    readings.push_back(reading);
  }
  return readings;
}

double value(const AxisLocation& location, const std::string& name) {
  for (const auto& error : location.errors)
    if (error.name == name) return error.value;
  ADD_FAILURE() << name << " is not among the results";
  return 0;
}

TEST(AxisLocation, OfATableAxisIsFoundFromOneTurnOfABall) {
  const auto parameters = DrawnMachine::parameters_of("ac-table");
  const auto machine = machine::outline_of(parameters, 0);
  // The tip is where the workpiece sees it: an axis that is displaced by +12 um moves the ball's circle by
  // +12 um, so XOC = 12 um.
  const Vec3 ball(72.411, 0, -350), shift(12e-3, -7e-3, 0), tilt(30e-6, -20e-6, 0);
  const auto found = locate_axis(machine, machine::make_chain(parameters, 0), 5, ball, tool_length,
                                 deviations(ball, shift, tilt, 72));
  EXPECT_TRUE(found.hidden.empty());
  EXPECT_NEAR(value(found, "XOC"), 12e-3, 1e-6);
  EXPECT_NEAR(value(found, "YOC"), -7e-3, 1e-6);
  EXPECT_NEAR(value(found, "AOC"), 30e-6, 1e-8);
  EXPECT_NEAR(value(found, "BOC"), -20e-6, 1e-8);
  EXPECT_LT(found.residual, 1e-7);
}

TEST(AxisLocation, HasAnUncertaintyThatCoversTheNoise) {
  const auto parameters = DrawnMachine::parameters_of("ac-table");
  const auto machine = machine::outline_of(parameters, 0);
  const Vec3 ball(72.411, 0, -350), shift(12e-3, -7e-3, 0), tilt(30e-6, -20e-6, 0);
  const auto found = locate_axis(machine, machine::make_chain(parameters, 0), 5, ball, tool_length,
                                 deviations(ball, shift, tilt, 2000, 1e-3));
  const double expected[] = {12e-3, -7e-3, 30e-6, -20e-6};
  ASSERT_EQ(found.errors.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(found.errors[k].value, expected[k], 4 * found.errors[k].uncertainty) << found.errors[k].name;
  // z = R (tilt): amplitude R, noise 1 um: 1e-3 / 72.4 * sqrt(2 / 2000) = 0.44 urad.
  EXPECT_NEAR(found.errors[2].uncertainty, 0.44e-6, 0.1e-6);
  EXPECT_NEAR(found.residual, 1e-3, 0.05e-3);
}

// Readings that a low-pass has smoothed over 1 / 40 of the turn. Of 2000 seeds 95 % of the values are
// within 2.04 standard uncertainties, Student's factor of the 30 values that these are made of; 93 and 97 %
// are four standard deviations of that count, sqrt(2000 0.95 0.05) = 9.7, beside it.
TEST(AxisLocation, CoversWhatSmoothedReadingsHaveInCommon) {
  const auto parameters = DrawnMachine::parameters_of("ac-table");
  const auto machine = machine::outline_of(parameters, 0);
  const auto model = machine::make_chain(parameters, 0);
  const Vec3 ball(72.411, 0, -350);
  constexpr std::size_t points = 360, width = 9;
  const auto exact = deviations(ball, Vec3::Zero(), Vec3::Zero(), points);
  std::array<int, 4> covered{};
  std::mt19937 random(17);
  std::normal_distribution<double> error(0, 1e-3);
  for (int seed = 0; seed < 2000; ++seed) {
    std::vector<Vec3> noise(points);
    for (auto& one : noise) one = {error(random), error(random), error(random)};
    auto readings = exact;
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t k = 0; k < width; ++k)
        readings[i].deviation += noise[(i + k) % points] / static_cast<double>(width);
    const auto found = locate_axis(machine, model, 5, ball, tool_length, readings);
    ASSERT_EQ(found.errors.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k)
      covered[k] += std::abs(found.errors[k].value) <= 2.04 * found.errors[k].uncertainty ? 1 : 0;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GE(covered[k], 1860) << k;
    EXPECT_LE(covered[k], 1940) << k;
  }
}

TEST(AxisLocation, SaysWhatABallOnTheAxisDoesNotShow) {
  const auto parameters = DrawnMachine::parameters_of("ac-table");
  const auto machine = machine::outline_of(parameters, 0);
  const Vec3 ball(0, 0, -300), shift(12e-3, -7e-3, 0);
  const auto found = locate_axis(machine, machine::make_chain(parameters, 0), 5, ball, tool_length,
                                 deviations(ball, shift, Vec3::Zero(), 36));
  // Displacement and inclination of the axis move such a ball alike.
  EXPECT_EQ(found.hidden.size(), 2u);
  EXPECT_THROW(locate_axis(machine, machine::make_chain(parameters, 0), 5, ball, tool_length, {}),
               std::runtime_error);
}

}  // namespace
}  // namespace trunnion::identification
