// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/ball_signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace trunnion::circular_tests {
namespace {

constexpr double pi = 3.14159265358979323846;

TEST(RotatingErrorFilter, TakesTheNoiseFromAnEccentricityAndKeepsItsPhase) {
  // 10 um turning at 0.46 rad/s, noise of 2 um: at 2 kHz a filter of 20 Hz leaves about
  // sqrt(2 pi 20 / (2 * 2000)) = 0.18 of it.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 2e-3);
  RotatingErrorFilter filter({0.0005, 0.46, 4e-6, 4e-6, 20});
  double sum = 0, raw = 0, along = 0;
  int n = 0;
  for (int i = 0; i < 27000; ++i) {
    const double angle = 0.46 * 0.0005 * i;
    const double x = 10e-3 * std::cos(angle), y = 10e-3 * std::sin(angle);
    const double rx = x + noise(random), ry = y + noise(random);
    const auto [fx, fy] = filter.next(rx, ry);
    if (i < 2000) continue;
    sum += std::pow(fx - x, 2), raw += std::pow(rx - x, 2), ++n;
    along += (fx * -std::sin(angle) + fy * std::cos(angle));
  }
  EXPECT_NEAR(std::sqrt(raw / n), 2e-3, 5e-5);
  EXPECT_NEAR(std::sqrt(sum / raw), 0.18, 0.04);
  EXPECT_NEAR(along / n, 0, 2e-5) << "no lag: the filter turns with the error";
  EXPECT_NEAR(filter.speed(), 0.46, 0.02 * 0.46);
}

TEST(TurnHarmonics, OfAToothErrorAreFoundWithOrderAmplitudeAndPhaseInBothSenses) {
  for (const double sense : {1.0, -1.0}) {
    std::vector<double> angles, values;
    // Uneven: the axis accelerates at first.
    for (int i = 0; i <= 20000; ++i) {
      const double share = i / 20000.0, angle = -90 + sense * 360 * (0.9 * share + 0.1 * share * share);
      angles.push_back(angle);
      values.push_back(3 + 0.22 * std::sin((12 * angle + 40) * pi / 180) +
                       1.5 * std::sin((angle + 10) * pi / 180));
    }
    const auto harmonics = turn_harmonics(angles, values, 100);
    EXPECT_NEAR(harmonics[0].amplitude, 3, 1e-3);
    EXPECT_NEAR(harmonics[1].amplitude, 1.5, 1e-3);
    EXPECT_NEAR(harmonics[1].phase, 10, 0.1);
    EXPECT_NEAR(harmonics[12].amplitude, 0.22, 1e-3);
    EXPECT_NEAR(harmonics[12].phase, 40, 0.5);
    const auto peaks = harmonic_peaks(harmonics, 0.01);
    ASSERT_EQ(peaks.size(), 1u);
    EXPECT_EQ(peaks[0].order, 12u);
    EXPECT_NEAR(value_at(peaks, 30), 0.22 * std::sin((360 + 40) * pi / 180), 2e-3);
  }
  EXPECT_THROW(turn_harmonics({0, 1, 2, 3, 4, 5, 6, 7}, std::vector<double>(8, 0.0), 4),
               std::invalid_argument);
}

TEST(DirectionRanges, AreThoseAlongTheRadiusAcrossItAndAlongTheAxis) {
  // Ball at 100 mm from an axis along +Z through (10, 0); deviations 3 um radial, 2 um tangential at one
  // place, 1 um axial at another.
  const std::vector<Vec3> places = {{110, 0, 5}, {10, 100, 5}, {-90, 0, 5}};
  const std::vector<Vec3> deviations = {{3e-3, 2e-3, 0}, {0, 0, 1e-3}, {0, 0, 0}};
  const auto ranges = direction_ranges(places, deviations, Vec3::UnitZ(), {10, 0, 0});
  EXPECT_NEAR(ranges.radial, 3e-3, 1e-12);
  EXPECT_NEAR(ranges.tangential, 2e-3, 1e-12);
  EXPECT_NEAR(ranges.axial, 1e-3, 1e-12);
}

}  // namespace
}  // namespace trunnion::circular_tests
