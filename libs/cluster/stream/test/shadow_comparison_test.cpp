// SPDX-License-Identifier: Apache-2.0
#include "stream/shadow_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace trunnion::stream::shadow_comparison_test {
namespace {

idl::stream::AxisFrame frame(std::uint64_t first, std::uint16_t channel = 0, double add = 0) {
  idl::stream::AxisFrame f;
  f.channel = channel, f.stage = idl::stream::Stage::KINEMATICS, f.epoch = 1, f.first = first, f.count = 4;
  f.axes = {0};
  for (int i = 0; i < 4; ++i) f.setpoints.push_back(static_cast<double>(first) + i + add);
  return f;
}

// Property over 100 seeded interleavings in which each side keeps its own order: every cycle counts once.
TEST(ShadowComparison, CountsEqualCyclesWhoeverIsFirst) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    ShadowComparison comparison;
    std::uint64_t at[2] = {0, 0};
    while (at[0] < 200 || at[1] < 200) {
      const bool shadow = at[0] == 200 || (at[1] < 200 && random() % 2 == 0);
      if (shadow)
        comparison.shadow(frame(at[1])), at[1] += 4;
      else
        comparison.original(frame(at[0])), at[0] += 4;
    }
    ASSERT_EQ(comparison.equal_cycles(), 200u);
    ASSERT_FALSE(comparison.first_difference());
  }
}

TEST(ShadowComparison, NamesTheOriginalsValueFirstWhoeverCameFirst) {
  for (const bool shadow_first : {false, true}) {
    ShadowComparison comparison;
    if (shadow_first) comparison.shadow(frame(8, 0, 0.5));
    comparison.original(frame(8));
    if (!shadow_first) comparison.shadow(frame(8, 0, 0.5));
    ASSERT_TRUE(comparison.first_difference());
    EXPECT_EQ(comparison.first_difference()->cycle, 8u);
    EXPECT_THAT(comparison.first_difference()->values, testing::HasSubstr("column 0: 8 and 8.5"));
    EXPECT_EQ(comparison.equal_cycles(), 0u);
  }
}

TEST(ShadowComparison, ChannelsAreApartAndWhatHasNoCounterpartIsForgotten) {
  ShadowComparison comparison;
  comparison.original(frame(8, 0));
  comparison.shadow(frame(8, 1, 1));
  EXPECT_FALSE(comparison.first_difference());
  comparison.original(frame(8 + ShadowComparison::window_cycles + 4, 0));
  comparison.shadow(frame(8, 0, 1));  // its counterpart is too old
  EXPECT_FALSE(comparison.first_difference());
}

}  // namespace
}  // namespace trunnion::stream::shadow_comparison_test
