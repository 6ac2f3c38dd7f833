// SPDX-License-Identifier: Apache-2.0
#include "motion/transition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "motion/phase_list.hpp"

namespace trunnion::motion {
namespace {

// 0 to 478 mm/s with 3000 mm/s2 and 60000 mm/s3: 478 / 3000 + 3000 / 60000 = 0.20933 s, half the speed on
// average.
TEST(Transition, a_full_ramp_takes_v_by_a_plus_a_by_j_and_half_the_speed_of_path) {
  const Transition t(0, 0, 478, {3000, 60000});
  EXPECT_NEAR(t.duration(), 478.0 / 3000 + 0.05, 1e-12);
  EXPECT_NEAR(t.distance(0, 0), 239 * (478.0 / 3000 + 0.05), 1e-9);
}

// 0 to 100: sqrt(100 * 60000) = 2449 < 3000 is the peak, so 2 sqrt(100 / 60000) s.
TEST(Transition, a_short_ramp_never_reaches_the_acceleration_limit) {
  EXPECT_NEAR(Transition(100, 0, 0, {3000, 60000}).duration(), 2 * std::sqrt(100.0 / 60000), 1e-12);
}

TEST(Transition, ends_at_its_target_within_its_limits_from_any_state) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 20000; ++k) {
    const RampLimits limits{100 + 5000 * unit(random), 1e3 + 1e5 * unit(random)};
    const double v = 500 * unit(random), target = 500 * unit(random);
    const double a = limits.acceleration * 1.5 * (2 * unit(random) - 1);
    const Transition t(v, a, target, limits);
    PathState state{0, v, a};
    for (const JerkPhase& phase : t.phases()) {
      ASSERT_GE(phase.time, 0);
      ASSERT_LE(std::abs(phase.jerk), limits.jerk * (1 + 1e-12));
      state = integrate(state, phase.jerk, phase.time);
      ASSERT_LE(std::abs(state.a), limits.acceleration * (1 + 1e-9));
    }
    ASSERT_NEAR(state.v, target, 1e-7);
    ASSERT_NEAR(state.a, 0, 1e-7);
    ASSERT_NEAR(t.distance(v, a), state.s, 1e-9);
  }
}

LimitCell cell(double at, double end, double speed, double acceleration, double jerk) {
  LimitCell c;
  c.at = at;
  c.end = end;
  c.speed = c.feed = speed;
  c.ramps.fill({acceleration, jerk});
  c.uniform = true;
  return c;
}

// Braking from 100 takes 4.08 mm: the slower cell behind 3 mm is entered at more than 10 mm/s, behind 4.2 at
// rest.
TEST(PhaseList, a_motion_into_a_slower_cell_is_refused_and_one_that_ends_before_it_is_not) {
  PhaseList phases;
  phases.add(Transition(100, 0, 0, {3000, 60000}));
  for (const double place : {3.0, 4.2}) {
    CellRing cells;
    cells.push(cell(0, place, 100, 3000, 60000));
    cells.push(cell(place, 10, 10, 3000, 60000));
    std::uint64_t at = 0;
    EXPECT_EQ(keeps_limits(phases, {0, 100, 0}, cells, at), place > 4.1);
  }
}

TEST(PhaseList, a_weak_or_rough_cell_on_the_way_and_the_end_of_the_path_are_refused) {
  PhaseList phases;
  phases.add(Transition(100, 0, 0, {3000, 60000}));
  const auto verdict = [&](const LimitCell& second) {
    CellRing cells;
    cells.push(cell(0, 2, 100, 3000, 60000));
    cells.push(second);
    std::uint64_t at = 0;
    return keeps_limits(phases, {0, 100, 0}, cells, at);
  };
  EXPECT_TRUE(verdict(cell(2, 10, 100, 3000, 60000)));
  EXPECT_FALSE(verdict(cell(2, 10, 100, 2000, 60000)));
  EXPECT_FALSE(verdict(cell(2, 10, 100, 3000, 50000)));
  EXPECT_FALSE(verdict(cell(2, 4, 100, 3000, 60000)));
  LimitCell stop = cell(2, 10, 100, 3000, 60000);
  stop.stop = true;
  EXPECT_FALSE(verdict(stop));
}

}  // namespace
}  // namespace trunnion::motion
