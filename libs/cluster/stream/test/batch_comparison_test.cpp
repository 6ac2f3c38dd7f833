// SPDX-License-Identifier: Apache-2.0
#include "stream/batch_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace trunnion::stream::batch_comparison_test {
namespace {

idl::stream::AxisBatch batch(std::uint64_t first, std::uint16_t channel = 0, double add = 0) {
  idl::stream::AxisBatch f;
  f.channel = channel, f.stage = idl::stream::Stage::KINEMATICS, f.epoch = 1, f.first = first, f.count = 4;
  f.axes = {0};
  for (int i = 0; i < 4; ++i) f.setpoints.push_back(static_cast<double>(first) + i + add);
  return f;
}

// Property over 100 seeded interleavings in which each side keeps its own order: every cycle counts once.
TEST(BatchComparison, CountsEqualCyclesWhoeverIsFirst) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    BatchComparison comparison;
    std::uint64_t at[2] = {0, 0};
    while (at[0] < 200 || at[1] < 200) {
      const bool standby = at[0] == 200 || (at[1] < 200 && random() % 2 == 0);
      if (standby)
        comparison.standby(batch(at[1])), at[1] += 4;
      else
        comparison.original(batch(at[0])), at[0] += 4;
    }
    ASSERT_EQ(comparison.equal_cycles(), 200u);
    ASSERT_FALSE(comparison.first_difference());
  }
}

TEST(BatchComparison, NamesTheOriginalsValueFirstWhoeverCameFirst) {
  for (const bool standby_first : {false, true}) {
    BatchComparison comparison;
    if (standby_first) comparison.standby(batch(8, 0, 0.5));
    comparison.original(batch(8));
    if (!standby_first) comparison.standby(batch(8, 0, 0.5));
    ASSERT_TRUE(comparison.first_difference());
    EXPECT_EQ(comparison.first_difference()->cycle, 8u);
    EXPECT_THAT(comparison.first_difference()->values, testing::HasSubstr("column 0: 8 and 8.5"));
    EXPECT_EQ(comparison.equal_cycles(), 0u);
  }
}

TEST(BatchComparison, ChannelsAreApartAndWhatHasNoCounterpartIsForgotten) {
  BatchComparison comparison;
  comparison.original(batch(8, 0));
  comparison.standby(batch(8, 1, 1));
  EXPECT_FALSE(comparison.first_difference());
  comparison.original(batch(8 + BatchComparison::window_cycles + 4, 0));
  comparison.standby(batch(8, 0, 1));  // its counterpart is too old
  EXPECT_FALSE(comparison.first_difference());
}

}  // namespace
}  // namespace trunnion::stream::batch_comparison_test
