// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/circular_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include "radians.hpp"

namespace trunnion::circular_tests {
namespace {

// n readings, half a step beside the quadrants.
template <class Deviation>
std::vector<RadialReading> circle(std::size_t n, Deviation&& deviation, int sense = 1) {
  std::vector<RadialReading> readings;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = sense * 360.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    readings.push_back({angle, deviation(angle * radians)});
  }
  return readings;
}

TEST(CircularFigures, OfAnOvalAreItsDiametersAndOfACircleBesideItsPlaceNothing) {
  // 2 um cos 2t: 4 um between the circles; a centre 30 um beside changes F and not G.
  const auto oval = circle(720, [](double t) { return 2e-3 * std::cos(2 * t); });
  const auto f = circular_figures(oval, oval, 100);
  EXPECT_NEAR(f.deviation_ccw, 4e-3, 1e-6);
  EXPECT_NEAR(f.squares_ccw, 4e-3, 1e-6);
  EXPECT_NEAR(f.bidirectional, 4e-3, 1e-6);
  EXPECT_NEAR(f.hysteresis, 0, 1e-15);
  const auto beside = circle(720, [](double t) {
    // Distance from the origin of a circle of radius 100.005 about (0.03, 0) in the direction t.
    return 0.03 * std::cos(t) + std::sqrt(100.005 * 100.005 - std::pow(0.03 * std::sin(t), 2)) - 100;
  });
  const auto g = circular_figures(beside, beside, 100);
  EXPECT_NEAR(g.deviation_ccw, 0, 1e-7);
  EXPECT_NEAR(g.fitted.first, 0.03, 1e-8);
  EXPECT_NEAR(g.fitted.second, 0, 1e-8);
  EXPECT_NEAR(g.mean_radial, 5e-3, 1e-8);
  EXPECT_NEAR(g.radial_largest_ccw, 0.035, 1e-6);
  EXPECT_NEAR(g.radial_least_ccw, -0.025, 1e-6);
}

TEST(CircularFigures, TheMinimumZoneIsThatOfASearchOnAGrid) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> within(-5e-3, 5e-3);
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto path = circle(40, [&](double) { return within(random); });
    const auto zone = minimum_zone_circle(path, 60);
    double least = 1e300;
    for (double x = -4e-3; x <= 4e-3; x += 2e-5)
      for (double y = -4e-3; y <= 4e-3; y += 2e-5) {
        double low = 1e300, high = -1e300;
        for (const auto& r : path) {
          const double d = r.deviation - x * std::cos(r.angle * radians) - y * std::sin(r.angle * radians);
          low = std::min(low, d), high = std::max(high, d);
        }
        least = std::min(least, high - low);
      }
    // A step of the grid moves a point by 20 um / 1000 at most, both ends of the range by twice that.
    EXPECT_LE(zone.span(), least + 1e-6);
    EXPECT_GE(zone.span(), least - 6e-5);
    EXPECT_LE(zone.span(), least_squares_circle(path, 60).span() + 1e-9);
  }
}

TEST(CircularFigures, TheHysteresisIsTheLargestDifferenceAtOneAngleWhateverTheOrderOfTheReadings) {
  // ccw 3 um cos t, cw -1 um cos t: 4 um at 0 and 180 deg.
  const auto ccw = circle(720, [](double t) { return 3e-3 * std::cos(t); });
  const auto cw = circle(
      360, [](double t) { return -1e-3 * std::cos(t); }, -1);
  const auto f = circular_figures(ccw, cw, 100);
  EXPECT_NEAR(f.hysteresis, 4e-3, 1e-6);
  EXPECT_NEAR(std::abs(std::cos(f.hysteresis_angle * radians)), 1, 1e-3);
  EXPECT_NEAR(f.radial_largest_ccw, 3e-3, 1e-6);
  EXPECT_NEAR(f.radial_least_cw, -1e-3, 1e-6);
}

TEST(CircularFigures, RefusesReadingsThatAreNoCircle) {
  const auto few = circle(7, [](double) { return 0.0; });
  EXPECT_THROW(circular_figures(few, {}, 100), std::invalid_argument);
  const auto far = circle(20, [](double) { return 60.0; });
  EXPECT_THROW(circular_figures(far, {}, 100), std::invalid_argument);
  const auto good = circle(20, [](double) { return 1e-3; });
  EXPECT_THROW(circular_figures(good, {}, 0), std::invalid_argument);
  EXPECT_EQ(circular_figures(good, {}, 100).bidirectional, 0);
}

}  // namespace
}  // namespace trunnion::circular_tests
