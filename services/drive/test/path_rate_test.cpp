// SPDX-License-Identifier: Apache-2.0
#include "path_rate.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trunnion::drive {
namespace {

// Cycles that have passed whole.
int whole_cycles(PathRate& rate, double cycles) {
  int passed = 0;
  rate.pass(cycles);
  for (; rate.due(); ++passed) rate.take_cycle();
  return passed;
}

TEST(PathRate, BrakesToItsEndInEqualSteps) {
  PathRate rate;
  rate.begin_braking(0.25);
  for (int i = 1; i < 4; ++i) {
    EXPECT_TRUE(rate.brake());
    EXPECT_EQ(rate.rate(), 1 - 0.25 * i);
    whole_cycles(rate, rate.rate());
  }
  EXPECT_FALSE(rate.brake());
  // 0.75 + 0.5 + 0.25 cycles.
  EXPECT_EQ(rate.phase(), 0.5);
}

TEST(PathRate, ReturnsFromAHoldToWholeCyclesWithinTheStep) {
  constexpr double step = 0.05;
  for (const double begun : {0.0, 0.1, 0.25, 0.999}) {
    PathRate rate;
    rate.pass(begun);
    rate.hold();
    double passed = begun, before = 0;
    int cycles = 0, periods = 0;
    while (!rate.whole() && ++periods < 1000) {
      const double left = rate.phase(), next = rate.next(rate.dips() ? 0 : step);
      // In the last period a cycle is passed less what had begun of it.
      const double gone = rate.whole() ? next - left : next;
      EXPECT_LE(std::abs(gone - before), step + 1e-12) << begun << ", period " << periods;
      before = gone;
      passed += gone;
      cycles += whole_cycles(rate, next);
    }
    EXPECT_TRUE(rate.whole()) << begun;
    EXPECT_FALSE(rate.dips());
    EXPECT_NEAR(before, 1, step + 1e-12) << begun;
    EXPECT_NEAR(cycles, passed, 1e-9) << begun;
  }
}

// A phase of 0.5 and steps of 0.125: a dip of ceil(sqrt(4)) = 2 steps down and back, of 0.5 / 2^2 each.
TEST(PathRate, ADipTakesThePhaseAway) {
  PathRate rate;
  rate.pass(0.5);
  EXPECT_EQ(rate.next(0.125), 0.875);
  EXPECT_TRUE(rate.dips());
  EXPECT_EQ(whole_cycles(rate, 0.875), 1);
  EXPECT_EQ(rate.next(0), 0.75);
  EXPECT_EQ(whole_cycles(rate, 0.75), 1);
  EXPECT_EQ(rate.phase(), 0.125) << "the loss of the last period";
  EXPECT_EQ(rate.next(0), 1);
  EXPECT_TRUE(rate.whole());
}

}  // namespace
}  // namespace trunnion::drive
