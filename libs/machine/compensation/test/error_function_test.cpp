// SPDX-License-Identifier: Apache-2.0
#include "compensation/error_function.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "compensation/warm_up.hpp"

namespace trunnion::volumetric {
namespace {

TEST(ErrorFunction, APolynomialIsInUnitsFromItsOrigin) {
  ErrorFunction f;
  f.terms.polynomials.push_back({100, 400, {1, 2, 4}});
  // u = (300 - 100) / 400 = 0.5: 1 + 2 * 0.5 + 4 * 0.25 = 3
  EXPECT_DOUBLE_EQ(f.value(300, 0), 3);
}

TEST(ErrorFunction, AHarmonicHasItsPeriodAmplitudeAndPhase) {
  ErrorFunction f;
  f.terms.harmonics.push_back({10, 2, 90});
  EXPECT_EQ(f.value(0, 0), 2);
  EXPECT_EQ(f.value(2.5, 0), 0);
  EXPECT_EQ(f.value(5, 0), -2);
  EXPECT_EQ(f.value(30, 0), 2);
}

TEST(ErrorFunction, ALinearTableInterpolatesAndKeepsItsBoundaryValues) {
  ErrorFunction f;
  f.terms.tables.push_back({{-100, 0, 300}, {4, 0, 6}, 0, false, {}});
  EXPECT_DOUBLE_EQ(f.value(-50, 0), 2);
  EXPECT_DOUBLE_EQ(f.value(100, 0), 2);
  EXPECT_EQ(f.value(-500, 0), 4);
  EXPECT_EQ(f.value(300, 0), 6);
  EXPECT_EQ(f.value(1e6, 0), 6);
}

TEST(ErrorFunction, ACubicTableReproducesAParabolaWithinItsInnerPoints) {
  Table table;
  for (const double x : {0.0, 40.0, 100.0, 150.0, 220.0}) {
    table.positions.push_back(x);
    table.values.push_back(3 + 0.1 * x - 0.002 * x * x);
  }
  table.cubic = true;
  table.finish();
  // Slopes from parabolas through three points are exact for a parabola, and so is Hermite's cubic.
  for (double x = 40; x <= 150; x += 1) EXPECT_NEAR(table.value(x), 3 + 0.1 * x - 0.002 * x * x, 1e-12);
}

TEST(ErrorFunction, AModuloTableRepeatsAndJoinsWithoutAJump) {
  Table table{{0, 90, 180, 270}, {0, 2, 0, -2}, 360, false, {}};
  EXPECT_DOUBLE_EQ(table.value(315), -1);
  EXPECT_DOUBLE_EQ(table.value(360 + 45), 1);
  EXPECT_DOUBLE_EQ(table.value(-45), -1);
  table.cubic = true;
  table.finish();
  EXPECT_NEAR(table.value(359.999999), table.value(0), 1e-7);
  EXPECT_NEAR((table.value(1e-4) - table.value(0)) / 1e-4, (table.value(0) - table.value(-1e-4)) / 1e-4,
              1e-6);
}

TEST(ErrorFunction, TheReversalValueIsTheDifferenceOfTheDirectionsAndTheirMeanIsWithoutIt) {
  ErrorFunction f;
  f.reversal = 6;
  f.positive.polynomials.push_back({0, 1, {4}});
  f.negative.polynomials.push_back({0, 1, {2}});
  EXPECT_EQ(f.value(0, 1), 4 + 3);
  EXPECT_EQ(f.value(0, -1), 2 - 3);
  EXPECT_EQ(f.value(0, 0), 3);
}

TEST(WarmUp, FollowsTheExponentialAndTheFinalRise) {
  HeatSources sources;
  sources[0].rise_per_speed = 0.05;  // K per mm/s
  sources[0].time_constant = 600;
  WarmUp warm;
  std::array<double, heat_source_count> speeds{};
  speeds[0] = -200;
  for (int i = 0; i < 600; ++i) warm.step(sources, speeds, 1);
  // After one time constant 1 - 1/e of 10 K; backward Euler is off by less than dt / time constant.
  EXPECT_NEAR(warm.temperatures()[0], 10 * (1 - std::exp(-1)), 10.0 / 600);
  for (int i = 0; i < 12000; ++i) warm.step(sources, speeds, 1);
  EXPECT_NEAR(warm.temperatures()[0], 10, 1e-6);
  EXPECT_EQ(warm.temperatures()[1], 0);
}

}  // namespace
}  // namespace trunnion::volumetric
