// SPDX-License-Identifier: Apache-2.0
#include "path_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trunnion::integration {
namespace {

// To 10 and back again in steps of 0.1: each place is passed twice.
Rows there_and_back() {
  Rows rows;
  for (int i = 0; i <= 100; ++i) rows.push_back({0.1 * i, 0});
  for (int i = 99; i >= 0; --i) rows.push_back({0.1 * i, 0});
  return rows;
}

TEST(PathFollower, FollowsAPathThatRetracesItselfToItsEnd) {
  const auto reference = there_and_back();
  PathFollower follower(reference);
  for (const auto& row : reference) ASSERT_TRUE(follower.follow(row, 0.01));
  EXPECT_TRUE(follower.arrived(0.01));
  EXPECT_EQ(follower.largest(), 0);
}

TEST(PathFollower, SlowerAndStandingRowsAreOnThePath) {
  const auto reference = there_and_back();
  PathFollower follower(reference);
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(follower.follow({std::min(5.0, 0.03 * i), 0.004}, 0.01));
  EXPECT_FALSE(follower.arrived(0.01)) << "it stands in the middle";
  EXPECT_NEAR(follower.largest(), 0.004, 1e-12);
}

TEST(PathFollower, ARowBesideThePathIsRefused) {
  const auto reference = there_and_back();
  PathFollower follower(reference);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(follower.follow(reference[i], 0.01));
  EXPECT_FALSE(follower.follow({2.0, 0.011}, 0.01));
  EXPECT_FALSE(follower.follow({2.0, NAN}, 0.01));
}

TEST(PathFollower, APartLeftOutIsRefused) {
  const auto reference = there_and_back();
  PathFollower follower(reference);
  ASSERT_TRUE(follower.follow({0.0, 0}, 0.01, 30));
  EXPECT_FALSE(follower.follow({4.0, 0}, 0.01, 30)) << "40 cycles on, 30 allowed";
  EXPECT_TRUE(follower.follow({2.5, 0}, 0.01, 30));
}

TEST(PathFollower, AWayBackIsCounted) {
  const auto reference = there_and_back();
  PathFollower follower(reference);
  for (int i = 0; i <= 60; ++i) ASSERT_TRUE(follower.follow(reference[i], 0.01));
  ASSERT_TRUE(follower.follow(reference[40], 0.01));
  EXPECT_EQ(follower.farthest_back(), 20u);
}

TEST(PathFollower, RowsAreTheSameOnlyInNumberAndValue) {
  auto rows = there_and_back();
  EXPECT_TRUE(same_rows(rows, there_and_back(), 0));
  rows[7][1] = 1e-8;
  EXPECT_FALSE(same_rows(rows, there_and_back(), 1e-9));
  rows.pop_back();
  EXPECT_FALSE(same_rows(rows, there_and_back(), 1));
}

}  // namespace
}  // namespace trunnion::integration
