// SPDX-License-Identifier: Apache-2.0
#include "program_execution/tap_in_hole.hpp"

#include <gtest/gtest.h>

namespace trunnion::program_execution {
namespace {

using language::AxisValues;

AxisValues at(double x, double y, double z) {
  AxisValues position{};
  position[language::X] = x, position[language::Y] = y, position[language::Z] = z;
  return position;
}

// In at X10 Y20 from Z2 down, lead 1.25 mm, right-hand.
const TapInHole tap_of_hole = TapInHole::of(1.25, at(10, 20, 2), at(10, 20, -10));

TEST(TapInHole, IsAsDeepAsTheAxesAreBelowWhereItBegan) {
  EXPECT_DOUBLE_EQ(tap_of_hole.depth(at(10, 20, -4.5)), 6.5);
  EXPECT_EQ(tap_of_hole.depth(at(10, 20, 2)), 0);
  EXPECT_EQ(tap_of_hole.depth(at(10, 20, 5)), 0);
  EXPECT_EQ(tap_of_hole.depth(at(10.2, 20, -4.5)), 0) << "beside it";
  EXPECT_EQ(TapInHole{}.depth(at(10, 20, -4.5)), 0);
  // Down along (3, 4, 0) / 5.
  EXPECT_NEAR(TapInHole::of(1, at(0, 0, 0), at(3, 4, 0)).depth(at(1.5, 2, 0)), 2.5, 1e-12);
}

TEST(TapInHole, ComesOutTheOtherWayRoundAndInTheOtherDirection) {
  const auto inside = at(10, 20, -4.5), out = at(10, 20, 8), in = at(10, 20, -8), across = at(14, 20, -4.5);
  EXPECT_FALSE(tap_of_hole.contradicts(inside, out, -1.25));
  EXPECT_FALSE(tap_of_hole.contradicts(inside, out, -1.255)) << "0.4 %";
  EXPECT_TRUE(tap_of_hole.contradicts(inside, out, 1.25)) << "as of a left-hand thread";
  EXPECT_TRUE(tap_of_hole.contradicts(inside, out, -1.5)) << "another lead";
  EXPECT_TRUE(tap_of_hole.contradicts(inside, in, -1.25));
  EXPECT_TRUE(tap_of_hole.contradicts(inside, across, -1.25));
  EXPECT_FALSE(tap_of_hole.contradicts(at(0, 0, -4.5), at(0, 0, 8), 2)) << "another place";
  EXPECT_FALSE(TapInHole{}.contradicts(inside, out, 2));
  // X, Y and Z rest, or are rounded.
  auto along_w = inside;
  along_w[language::W] = 12;
  EXPECT_TRUE(tap_of_hole.contradicts(inside, along_w, -1.25)) << "it stays in its hole";
  along_w[language::Z] += 1e-12;
  EXPECT_TRUE(tap_of_hole.contradicts(inside, along_w, -1.25));
  const auto left = TapInHole::of(-1.25, at(10, 20, 2), at(10, 20, -10));
  EXPECT_FALSE(left.contradicts(inside, out, 1.25));
  EXPECT_TRUE(left.contradicts(inside, out, -1.25));
}

TEST(TapInHole, TellsTheOperatorHandLeadAndDepth) {
  EXPECT_EQ(tap_of_hole.words(6.5), "right-hand thread, lead 1.25 mm, 6.500 mm deep");
  EXPECT_EQ(TapInHole::of(-0.75, at(0, 0, 0), at(0, 0, -8)).words(0.25),
            "left-hand thread, lead 0.75 mm, 0.250 mm deep");
}

TEST(TapInHole, IsNoneOfAStrokeWithoutLength) {
  EXPECT_EQ(TapInHole::of(1, at(1, 2, 3), at(1, 2, 3)), TapInHole{});
}

}  // namespace
}  // namespace trunnion::program_execution
