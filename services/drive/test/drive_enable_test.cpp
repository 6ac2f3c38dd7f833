// SPDX-License-Identifier: Apache-2.0
#include "drive_enable.hpp"

#include <gtest/gtest.h>

namespace trunnion::drive {
namespace {

TEST(DriveEnable, IsLateWhenTheDrivesStayOffAlthoughTheyAreEnabled) {
  constexpr double period = 0.5;
  constexpr int in_time = static_cast<int>(drives_on_timeout / period);
  DriveEnable enable;
  for (int i = 0; i < 2 * in_time; ++i) EXPECT_FALSE(enable.is_late(true, period)) << "not demanded";
  enable.demand(true);
  for (int i = 0; i < in_time; ++i) EXPECT_FALSE(enable.is_late(true, period));
  EXPECT_TRUE(enable.is_late(true, period));
  EXPECT_FALSE(enable.is_late(false, period)) << "on";
  for (int i = 0; i < in_time; ++i) EXPECT_FALSE(enable.is_late(true, period)) << "waits anew";
  enable.lose();
  EXPECT_FALSE(enable.granted());
  EXPECT_FALSE(enable.is_late(true, period));
  enable.acknowledge();
  EXPECT_TRUE(enable.granted());
  for (int i = 0; i < in_time; ++i) EXPECT_FALSE(enable.is_late(true, period));
  EXPECT_TRUE(enable.is_late(true, period));
}

}  // namespace
}  // namespace trunnion::drive
