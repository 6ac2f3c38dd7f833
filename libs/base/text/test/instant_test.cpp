// SPDX-License-Identifier: Apache-2.0
#include "text/instant.hpp"

#include <gtest/gtest.h>

namespace trunnion::text {
namespace {

// 10^9 s after the epoch: 11574 days and 6400 s; 11574 days are 2001-09-09, 6400 s are 1:46:40.
TEST(Instant, IsIso8601InUtcAndCutToItsDecimals) {
  EXPECT_EQ(instant(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(instant(1'000'000'000'250'999'999), "2001-09-09T01:46:40.250Z");
  EXPECT_EQ(instant(1'000'000'000'000'000'042, 9), "2001-09-09T01:46:40.000000042Z");
  EXPECT_EQ(whole_second(1'000'000'000), "2001-09-09T01:46:40Z");
}

}  // namespace
}  // namespace trunnion::text
