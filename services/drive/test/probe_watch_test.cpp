// SPDX-License-Identifier: Apache-2.0
#include "probe_watch.hpp"

#include <gtest/gtest.h>

namespace trunnion::drive {
namespace {

TEST(ProbeWatch, SeesTheEdgeOfAContactOnce) {
  ProbeWatch probe;
  EXPECT_FALSE(probe.made(false, true));
  EXPECT_TRUE(probe.made(true, true));
  EXPECT_FALSE(probe.made(true, true));
  EXPECT_FALSE(probe.made(false, true));
  EXPECT_TRUE(probe.made(true, true)) << "the next contact";
}

TEST(ProbeWatch, AProbeThatIsSwitchedOnInContactHasNotMadeItNow) {
  ProbeWatch probe;
  EXPECT_FALSE(probe.made(false, false));
  EXPECT_FALSE(probe.made(true, true)) << "on and in contact in the same period";
  EXPECT_FALSE(probe.made(true, true));
  EXPECT_FALSE(probe.made(false, false));
  EXPECT_FALSE(probe.made(true, false)) << "off";
  EXPECT_FALSE(probe.made(true, true)) << "switched on while it is in contact";
}

}  // namespace
}  // namespace trunnion::drive
