// SPDX-License-Identifier: Apache-2.0
#include "motion/decimals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trunnion::motion {
namespace {

// 200 lines between points whose coordinates are multiples of `step`, beside an offset that is none.
Grain grain_of_points(double step, double offset, const BlendRules& rules) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-50, 50);
  Decimals decimals;
  AxisValues last{};
  for (std::uint64_t k = 0; k < 200; ++k) {
    AxisValues p{}, change{};
    for (const std::size_t i : {0U, 1U, 3U}) {
      p[i] = std::round(unit(random) / step) * step + offset;
      change[i] = p[i] - last[i];
    }
    last = p;
    decimals.begin(k);
    if (k > 0) decimals.add(change);
  }
  return decimals.about(100, rules);
}

TEST(Decimals, are_found_in_millimetres_inches_and_steps_beside_any_offset) {
  for (const double step : {0.01, 0.0025, 0.001, 0.0001, 25.4 * 0.0001})
    EXPECT_NEAR(grain_of_points(step, 17.3 / 7, {0.01, 0.05}).linear, step, 1e-9);
  EXPECT_NEAR(grain_of_points(0.001, 0, {0.01, 0.05}).rotary, 0.001, 1e-9);
}

TEST(Decimals, are_none_in_coordinates_that_are_not_rounded_and_far_above_the_tolerance) {
  EXPECT_LE(grain_of_points(std::sqrt(2.0) / 1e4, 0, {0.01, 0.05}).linear, 1e-6);
  EXPECT_EQ(grain_of_points(0.1, 0, {0.01, 0.05}).linear, 0);
}

}  // namespace
}  // namespace trunnion::motion
