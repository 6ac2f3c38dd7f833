// SPDX-License-Identifier: Apache-2.0
#include "text/quantity.hpp"

#include <gtest/gtest.h>

namespace trunnion::text {
namespace {

TEST(Quantity, HasItsUnitAndNoZerosThatSayNothing) {
  EXPECT_EQ(quantity(1.5, "s"), "1.5 s");
  EXPECT_EQ(quantity(120, "%"), "120 %");
  EXPECT_EQ(quantity(0, "mm"), "0 mm");
  EXPECT_EQ(quantity(-0.0), "0");
  EXPECT_EQ(quantity(-0.25, "mm"), "-0.25 mm");
}

TEST(Quantity, IsRoundedToItsSignificantDigits) {
  EXPECT_EQ(quantity(2.0 / 3, "mm"), "0.666667 mm");
  EXPECT_EQ(quantity(1234.56789, "mm/min"), "1234.57 mm/min");
  EXPECT_EQ(quantity(0.0012345678, "mm", 3), "0.00123 mm");
  EXPECT_EQ(quantity(1e6, "mm"), "1000000 mm");
  EXPECT_EQ(quantity(9.9999999, "s"), "10 s");
}

TEST(Quantity, IsWrittenWithAnExponentOnlyWhereNobodyWouldWriteItOut) {
  EXPECT_EQ(quantity(1e-9, "mm"), "1e-09 mm");
  EXPECT_EQ(quantity(2.5e15), "2.5e+15");
}

}  // namespace
}  // namespace trunnion::text
