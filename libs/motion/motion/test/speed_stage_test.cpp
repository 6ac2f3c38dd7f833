// SPDX-License-Identifier: Apache-2.0
// The speed stage alone, over cells written by hand in the place of a path.
#include "motion/speed_stage.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <vector>

namespace trunnion::motion {
namespace {

constexpr double cycle = 0.001, acceleration = 3000, jerk = 60000;

/// A straight stretch from `at` to `end`: the same limits everywhere.
LimitCell straight(double at, double end, double speed) {
  LimitCell cell;
  cell.at = at;
  cell.end = end;
  cell.speed = cell.top = cell.feed = speed;
  cell.ramps.fill({acceleration, jerk});
  cell.uniform = true;
  return cell;
}

struct Motion {
  std::vector<PathState> states;
  bool ended = false;
};

Motion run_stage(
    SpeedStage& stage, std::size_t most,
    const std::function<Overrides(std::size_t)>& overrides = [](std::size_t) { return Overrides{}; }) {
  Motion result;
  while (result.states.size() < most && !result.ended) {
    stage.step(overrides(result.states.size()));
    result.states.push_back(stage.state());
    result.ended = stage.at_end();
  }
  return result;
}

void expect_within_ramps(const Motion& run) {
  PathState last;
  for (const PathState& s : run.states) {
    ASSERT_LE(std::abs(s.a), acceleration * (1 + 1e-6));
    ASSERT_LE(std::abs(s.a - last.a), jerk * cycle * (1 + 1e-6));
    ASSERT_GE(s.v, -1e-9);
    ASSERT_GE(s.s, last.s - 1e-9);
    last = s;
  }
}

// v^2 / 3000 + v / 20 = 100 has v = 477.8 mm/s: 2 (477.8 / 3000 + 0.05) = 0.4186 s.
TEST(SpeedStage, one_cell_is_travelled_in_the_time_of_its_s_curve) {
  SpeedStage stage(cycle);
  stage.cells().push(straight(0, 100, 500));
  stage.set_finished(true);
  stage.extended();
  const Motion result = run_stage(stage, 1000);
  ASSERT_TRUE(result.ended);
  EXPECT_NEAR(static_cast<double>(result.states.size()) * cycle, 0.4186, 0.002);
  EXPECT_NEAR(result.states.back().s, 100, 1e-9);
  EXPECT_TRUE(stage.at_standstill());
  expect_within_ramps(result);
}

// 100 mm at 100 mm/s take 1 s, and the ramps 0.0816 s more; a tenth of a per cent less over 10 mm adds 0.1
// ms. The second slower cell is nearer to the stop than braking takes: the first one is not entered any
// slower for that.
TEST(SpeedStage, slightly_slower_cells_before_a_stop_take_no_more_than_their_time) {
  SpeedStage stage(cycle);
  stage.cells().push(straight(0, 90, 100));
  stage.cells().push(straight(90, 99.9, 99.9));
  stage.cells().push(straight(99.9, 100, 99.8));
  stage.set_finished(true);
  stage.extended();
  const Motion result = run_stage(stage, 3000);
  ASSERT_TRUE(result.ended);
  EXPECT_LE(static_cast<double>(result.states.size()) * cycle, 1.11);
  expect_within_ramps(result);
}

// A curve that permits 100 mm/s2 above 40 mm/s and 3000 below. Up: 0.0514 s over 1 mm to 39.6 mm/s, 0.604 s
// over 42.2 mm to 100. Down: 0.68 s over 44.9 mm to 32, 0.046 s over 0.7 mm. The 11.2 mm between take 0.112
// s: 1.493 s. With 100 mm/s2 down to the standstill it would be 1.724 s.
TEST(SpeedStage, a_stop_uses_the_braking_that_lower_speeds_permit) {
  SpeedStage stage(cycle);
  LimitCell curve = straight(0, 100, 100);
  curve.uniform = false;
  curve.ramps = {RampLimits{100, jerk}, {100, jerk}, {100, jerk}, {acceleration, jerk}};
  stage.cells().push(curve);
  stage.set_finished(true);
  stage.extended();
  const Motion result = run_stage(stage, 3000);
  ASSERT_TRUE(result.ended);
  EXPECT_LE(static_cast<double>(result.states.size()) * cycle, 1.51);
  EXPECT_EQ(stage.stopping_cycles(), 0U);
  for (const PathState& s : result.states) {
    if (s.v > 40.001) {
      ASSERT_LE(std::abs(s.a), 100 * (1 + 1e-6));
    }
  }
  expect_within_ramps(result);
}

// 20 mm/s from 60 to 61 mm: entered and left at no more, and the rest not slower for it: 100 mm at 100 mm/s
// take 1 s, the slow millimetre 0.04 s more, and each of four ramps, of 80 or 100 mm/s, less than 0.09 s.
TEST(SpeedStage, a_slow_cell_is_entered_at_its_speed_and_the_others_are_not_slowed) {
  SpeedStage stage(cycle);
  stage.cells().push(straight(0, 60, 100));
  stage.cells().push(straight(60, 61, 20));
  stage.cells().push(straight(61, 100, 100));
  stage.set_finished(true);
  stage.extended();
  const Motion result = run_stage(stage, 3000);
  ASSERT_TRUE(result.ended);
  double fastest = 0;
  for (const PathState& s : result.states) {
    if (s.s >= 60 && s.s <= 61) {
      EXPECT_LE(s.v, 20 * (1 + 1e-6));
    }
    fastest = std::max(fastest, s.v);
  }
  EXPECT_NEAR(fastest, 100, 1e-6);
  EXPECT_LT(static_cast<double>(result.states.size()) * cycle, 1 + 0.04 + 4 * 0.09);
  expect_within_ramps(result);
}

TEST(SpeedStage, a_stop_is_met_exactly_and_waited_at) {
  SpeedStage stage(cycle);
  stage.cells().push(straight(0, 10, 100));
  LimitCell second = straight(10, 20, 100);
  second.stop = true;
  second.wait_cycles = 50;
  stage.cells().push(second);
  stage.set_finished(true);
  stage.extended();
  const Motion result = run_stage(stage, 3000);
  ASSERT_TRUE(result.ended);
  EXPECT_GE(std::count_if(result.states.begin(), result.states.end(),
                          [](const PathState& s) { return std::abs(s.s - 10) < 1e-9 && s.v == 0; }),
            50);
  expect_within_ramps(result);
}

// Cells arrive while it moves; when none do it stops at the end of the last one, and it is not at the end.
TEST(SpeedStage, it_stands_at_the_end_of_what_it_knows_and_goes_on_when_more_is_known) {
  SpeedStage stage(cycle);
  stage.cells().push(straight(0, 10, 100));
  stage.extended();
  Motion result = run_stage(stage, 1000);
  EXPECT_TRUE(stage.at_standstill());
  EXPECT_NEAR(stage.state().s, 10, 1e-6);
  EXPECT_LE(stage.state().s, 10 + 1e-9);
  stage.cells().push(straight(10, 30, 100));
  stage.set_finished(true);
  stage.extended();
  result = run_stage(stage, 1000);
  EXPECT_TRUE(result.ended);
  EXPECT_NEAR(stage.state().s, 30, 1e-9);
}

// 10,000 cells of 0.02 mm that allow 600 mm/s at an acceleration of 1500: half of the 200 mm let it come to
// v^2 / 3000 + 0.0125 v = 100, 529 mm/s. So the stop at the end is seen 5,000 cells before it.
TEST(SpeedStage, looks_ahead_over_the_whole_stopping_distance_of_5000_cells) {
  SpeedStage stage(cycle);
  for (int k = 0; k < 10000; ++k) {
    LimitCell cell = straight(0.02 * k, 0.02 * (k + 1), 600);
    cell.ramps.fill({1500, jerk});
    stage.cells().push(cell);
  }
  stage.set_finished(true);
  stage.extended();
  const Motion result = run_stage(stage, 3000);
  ASSERT_TRUE(result.ended);
  std::size_t fastest = 0;
  for (std::size_t k = 0; k < result.states.size(); ++k)
    if (result.states[k].v > result.states[fastest].v) fastest = k;
  EXPECT_NEAR(result.states[fastest].v, 529, 3);
  EXPECT_NEAR(result.states[fastest].s, 100, 3);
  expect_within_ramps(result);
}

// Cells of random speeds; overrides and holds at random cycles, rapids among them.
TEST(SpeedStage, keeps_every_cell_under_random_overrides_and_holds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    SpeedStage stage(cycle);
    double at = 0;
    std::vector<double> ends, speeds;
    for (int k = 0; k < 60; ++k) {
      const double length = std::pow(10, -1 + 2 * static_cast<double>(random() % 1000) / 1000);
      LimitCell cell = straight(at, at + length, 20 + static_cast<double>(random() % 200));
      cell.rapid = random() % 3 == 0;
      cell.stop = k > 0 && random() % 12 == 0;
      stage.cells().push(cell);
      at += length;
      ends.push_back(at);
      speeds.push_back(cell.speed);
    }
    stage.set_finished(true);
    stage.extended();
    Overrides now;
    const std::uint64_t pause = 1 + random() % 100;
    const Motion result = run_stage(stage, 400000, [&](std::size_t) {
      if (random() % pause == 0) now.feed = 1.5 * static_cast<double>(random() % 7) / 6;
      if (random() % pause == 0) now.rapid = static_cast<double>(random() % 5) / 4;
      if (random() % pause == 0) now.hold = random() % 3 == 0;
      return now;
    });
    ASSERT_TRUE(result.ended) << seed;
    EXPECT_NEAR(result.states.back().s, at, 1e-6) << seed;
    expect_within_ramps(result);
    std::size_t cell = 0;
    for (const PathState& s : result.states) {
      while (cell + 1 < ends.size() && s.s > ends[cell]) ++cell;
      ASSERT_LE(s.v, speeds[cell] * (1 + 1e-6)) << "seed " << seed << ", cell " << cell;
    }
  }
}

}  // namespace
}  // namespace trunnion::motion
