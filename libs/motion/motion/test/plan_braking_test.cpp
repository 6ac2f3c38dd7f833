// SPDX-License-Identifier: Apache-2.0
// Braking along plans written by hand, on cells written by hand.
#include "motion/plan_braking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trunnion::motion::plan_braking_test {
namespace {

constexpr double cycle = 0.001, acceleration = 3000, jerk = 60000, speed = 40;

// One axis along a straight stretch of 100 mm.
SpeedStage straight_stage() {
  LimitCell cell;
  cell.end = 100;
  cell.speed = cell.top = cell.feed = cell.reachable = 500;
  cell.ramps.fill({acceleration, jerk});
  cell.uniform = cell.dense = true;
  cell.known_axes = 1;
  cell.axes[0].begin = cell.axes[0].end = {1, 0, 0};
  cell.axes[0].acceleration = static_cast<float>(acceleration);
  cell.axes[0].jerk = static_cast<float>(jerk);
  SpeedStage stage(cycle);
  stage.cells().push(cell);
  stage.set_finished(true);
  stage.extended();
  return stage;
}

SpeedPlan constant_plan(double length) {
  const SpeedPiece piece{0, length, speed * speed, 0, 0},
      last{length, 2 * speed * cycle, speed * speed, 0, 0};
  SpeedPlan plan;
  EXPECT_TRUE(plan.replace(0, {piece}, last));
  return plan;
}

struct Braked {
  std::vector<PathState> states;
  double rate = 1;
};

Braked run(SpeedStage& stage, SpeedPlan& plan, int hold, int cycles) {
  stage.place({0, speed, 0});
  PlanBraking braking;
  braking.start(plan, stage);
  Braked result{{stage.state()}, 1};
  for (int k = 0; k < cycles; ++k) {
    stage.place(braking.step(plan, stage, cycle, k < hold));
    result.states.push_back(stage.state());
  }
  result.rate = braking.rate();
  EXPECT_TRUE(braking.constant() || hold >= cycles);
  return result;
}

void expect_within_limits(const std::vector<PathState>& states) {
  for (std::size_t k = 1; k < states.size(); ++k) {
    const PathState &from = states[k - 1], &to = states[k];
    ASSERT_LE(std::abs(to.a), acceleration * 1.0003) << k;
    ASSERT_LE(std::abs(to.a - from.a), jerk * cycle * 1.0003) << k;
    // The strongest changes linearly within each half of a cycle: the mean of both ends is off by up to J
    // t^2 / 4.
    ASSERT_NEAR(to.v - from.v, (from.a + to.a) / 2 * cycle, jerk * cycle * cycle / 4) << k;
    ASSERT_GE(to.v, 0) << k;
  }
}

// 2 sqrt(v / J) = 51.6 ms from 40 mm/s at 60000 mm/s3; sqrt(v J) = 1549 mm/s2 is not the limit. To a
// hundredth of the speed in a tenth more.
TEST(PlanBraking, from_a_constant_speed_it_brakes_with_the_jerk_permitted) {
  SpeedStage stage = straight_stage();
  SpeedPlan plan = constant_plan(50);
  const Braked braked = run(stage, plan, 57, 57);
  expect_within_limits(braked.states);
  EXPECT_LE(braked.states.back().v, 0.01 * speed);
}

TEST(PlanBraking, a_hold_that_ends_leaves_a_constant_rate) {
  for (int hold = 1; hold < 50; hold += 3) {
    SpeedStage stage = straight_stage();
    SpeedPlan plan = constant_plan(50);
    const Braked braked = run(stage, plan, hold, 100);
    expect_within_limits(braked.states);
    EXPECT_EQ(braked.states.back().a, 0);
    EXPECT_NEAR(braked.states.back().v, braked.rate * speed, 1e-9 * speed);
    EXPECT_LT(braked.rate, 1);
  }
}

// 0.04 mm at 40 mm/s are one cycle: no time is left for the return to a constant rate.
TEST(PlanBraking, a_plan_that_ends_soon_is_left_as_it_is) {
  SpeedStage stage = straight_stage();
  SpeedPlan plan = constant_plan(0.04);
  const Braked braked = run(stage, plan, 2, 2);
  EXPECT_EQ(braked.rate, 1);
}

}  // namespace
}  // namespace trunnion::motion::plan_braking_test
