// SPDX-License-Identifier: Apache-2.0
#include "service/running_time.hpp"

#include <gtest/gtest.h>

namespace trunnion::service {
namespace {

TEST(RunningTime, PassesLikeTheClockWhileTheProcessRuns) {
  RunningTime time;
  const double began = time.advance(1000);
  for (int i = 1; i <= 500; ++i) time.advance(1000 + 0.02 * i);
  EXPECT_NEAR(time.now() - began, 10, 1e-9);
}

TEST(RunningTime, APauseCountsAsATenthOfASecondAtMost) {
  RunningTime time;
  const double began = time.advance(1000);
  time.advance(1000.05);
  time.advance(1060);  // suspended for a minute
  time.advance(1060.02);
  EXPECT_NEAR(time.now() - began, 0.05 + RunningTime::longest_pause + 0.02, 1e-9);
}

}  // namespace
}  // namespace trunnion::service
