// SPDX-License-Identifier: Apache-2.0
#include "text/printed.hpp"

#include <gtest/gtest.h>

namespace trunnion::text {
namespace {

TEST(Printed, IsAsOfPrintfAndOfAnyLength) {
  EXPECT_EQ(printed("axis %c at %.3f %s", 'X', 1.5, "mm"), "axis X at 1.500 mm");
  EXPECT_EQ(printed("%s", ""), "");
  EXPECT_EQ(printed("%0*d", 5000, 7).size(), 5000u);
}

}  // namespace
}  // namespace trunnion::text
