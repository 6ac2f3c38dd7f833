// SPDX-License-Identifier: Apache-2.0
#include "recording/cycle_coverage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace trunnion::recording {
namespace {

TEST(CycleCoverage, AGapInsideOfMotionIsLost) {
  CycleCoverage c;
  c.add(100, 8, true, false);
  c.add(116, 8, false, true);
  EXPECT_EQ(c.covered(), 16u);
  EXPECT_EQ(c.lost(), 8u);
}

TEST(CycleCoverage, AnIdleChannelLosesNothing) {
  CycleCoverage c;
  c.add(100, 8, true, true);
  c.add(500, 8, true, true);
  EXPECT_EQ(c.lost(), 0u);
  EXPECT_EQ(c.covered(), 16u);
}

TEST(CycleCoverage, AMissingEndOrStartIsAGap) {
  CycleCoverage no_end, no_start;
  no_end.add(100, 8, true, false);
  no_end.add(110, 8, true, false);
  EXPECT_EQ(no_end.lost(), 2u);
  no_start.add(100, 8, true, true);
  no_start.add(110, 8, false, false);
  EXPECT_EQ(no_start.lost(), 2u);
}

TEST(CycleCoverage, ARecordingThatCameLateDoesNotBeginAtAStart) {
  CycleCoverage c;
  EXPECT_TRUE(c.begins_at_a_start());
  c.add(108, 8, false, false);
  EXPECT_FALSE(c.begins_at_a_start());
  c.add(100, 8, true, false);
  EXPECT_TRUE(c.begins_at_a_start());
}

TEST(CycleCoverage, CopiesRepeatAndLateBatchesFillTheirGap) {
  CycleCoverage c;
  c.add(0, 8, true, false);
  c.add(0, 8, true, false);
  c.add(16, 8, false, true);
  EXPECT_EQ(c.lost(), 8u);
  c.add(8, 8, false, false);
  EXPECT_EQ(c.lost(), 0u);
  EXPECT_EQ(c.repeated(), 1u);
  EXPECT_EQ(c.late(), 1u);
  EXPECT_EQ(c.covered(), 24u);
}

// Whatever the order, and with batches of two replicas cut differently, the union is what counts.
TEST(CycleCoverage, OrderAndOverlapDoNotMatter) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<bool> there(400);
    struct Batch {
      std::uint64_t first, count;
    };
    std::vector<Batch> batches;
    for (int i = 0; i < 60; ++i) batches.push_back({random() % 380, 1 + random() % 20});
    CycleCoverage c;
    for (const auto& f : batches) {
      c.add(f.first, f.count, false, false);
      std::fill_n(there.begin() + static_cast<std::ptrdiff_t>(f.first), f.count, true);
    }
    const auto covered = static_cast<std::uint64_t>(std::count(there.begin(), there.end(), true));
    const auto begin = std::find(there.begin(), there.end(), true);
    const auto end = std::find(there.rbegin(), there.rend(), true).base();
    EXPECT_EQ(c.covered(), covered);
    EXPECT_EQ(c.lost(), static_cast<std::uint64_t>(end - begin) - covered);
  }
}

}  // namespace
}  // namespace trunnion::recording
