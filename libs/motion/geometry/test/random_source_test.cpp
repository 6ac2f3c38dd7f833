// SPDX-License-Identifier: Apache-2.0
#include "geometry/random_source.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trunnion::geometry {
namespace {

TEST(RandomSource, IsSplitMix64) {
  // The first value of the published generator for seed 0 is 0xe220a8397b1dcdaf; the upper 53 bits count.
  RandomSource random(0);
  EXPECT_EQ(random.uniform(), static_cast<double>(0xe220a8397b1dcdafULL >> 11) * 0x1p-53);
}

TEST(RandomSource, NormalNumbersHaveMeanZeroAndDeviationOne) {
  RandomSource random(1);
  double sum = 0, squares = 0;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double value = random.normal();
    sum += value, squares += value * value;
  }
  EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
}

}  // namespace
}  // namespace trunnion::geometry
