#include "motion/speed_planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <new>

#include "motion_fixture.hpp"

namespace {
std::size_t allocations = 0;
}

// Counting replacements of the global operators: the one way to see that nothing allocates.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace trunnion::motion::test {
namespace {

CornerRules rules_of(const Limits& limits) {
  CornerRules rules;
  rules.limits = limits;
  rules.window = limits.smoothing_cycles * cycle;
  rules.reach_window = rules.window + cycle;
  rules.contour_window = (limits.smoothing_cycles + 2) * cycle;
  return rules;
}

PlannedSegment segment(const AxisValues& from, const AxisValues& to, double feed) {
  PlannedSegment s;
  s.path = PathSegment::line(from, to);
  s.rates = sample_rates(s.path, nullptr, 0);
  s.feed = feed;
  return s;
}

TEST(SpeedPlanner, speed_changes_by_at_most_a_dt_and_lands_on_the_end_exactly) {
  SpeedPlanner planner(rules_of(uniform_limits(200, 1000, 20)), cycle);
  planner.push(segment({}, {33.3}, 150), false, 0);
  planner.finish();
  double before = 0, travelled = 0;
  for (int k = 0; k < 2000 && !planner.done(); ++k) {
    planner.step({});
    EXPECT_LE(std::abs(planner.speed() - before), 1000 * cycle * (1 + 1e-9));
    EXPECT_LE(planner.speed(), 150 * (1 + 1e-12));
    EXPECT_GE(planner.travelled(), travelled);
    before = planner.speed();
    travelled = planner.travelled();
  }
  EXPECT_TRUE(planner.done());
  EXPECT_EQ(planner.travelled(), planner.current().path.length());
}

// A right angle, |du| = sqrt 2: v T' / 8 sqrt 2 = tol with T' = 22 ms gives 0.01 * 8 / (0.022 * 1.41421)
// = 2.571 mm/s; planned with 95 % of the tolerance, and the search stops within 3 % below: 2.37 .. 2.443.
TEST(SpeedPlanner, a_right_angle_is_passed_at_the_speed_of_the_corner_formula) {
  SpeedPlanner planner(rules_of(uniform_limits(200, 1000, 20)), cycle);
  planner.push(segment({}, {10}, 100), false, 0);
  planner.push(segment({10}, {10, 10}, 100), false, 0);
  planner.finish();
  double at_corner = 1e9;
  while (!planner.done()) {
    planner.step({});
    if (planner.speed() > 0 && planner.current().path.target()[1] == 10 && at_corner == 1e9)
      at_corner = planner.speed();
  }
  EXPECT_GE(at_corner, 2.36);
  EXPECT_LE(at_corner, 2.443);
}

TEST(SpeedPlanner, a_slower_segment_is_entered_at_its_feed) {
  SpeedPlanner planner(rules_of(uniform_limits(200, 1000, 20)), cycle);
  planner.push(segment({}, {20}, 100), false, 0);
  planner.push(segment({20}, {40}, 10), false, 0);
  planner.finish();
  double fastest_in_second = 0;
  while (!planner.done()) {
    planner.step({});
    if (planner.current().feed == 10) fastest_in_second = std::max(fastest_in_second, planner.speed());
  }
  EXPECT_LE(fastest_in_second, 10 * (1 + 1e-12));
  EXPECT_GE(fastest_in_second, 10 * (1 - 1e-12));
}

TEST(SpeedPlanner, without_an_end_motion_stays_in_the_part_that_is_planned_and_stands_there) {
  SpeedPlanner planner(rules_of(uniform_limits(200, 1000, 20)), cycle);
  for (int i = 0; i < 100; ++i) planner.push(segment({1.0 * i}, {1.0 * (i + 1)}, 100), false, 0);
  for (int k = 0; k < 5000; ++k) planner.step({});
  EXPECT_FALSE(planner.done());
  EXPECT_EQ(planner.speed(), 0);
  // Half a window of travel at 150 mm/s (override 1.5) is 1.65 mm: all but the last few segments are
  // released.
  EXPECT_GE(planner.current().path.target()[0], 95);
  planner.finish();
  for (int k = 0; k < 1000; ++k) planner.step({});
  EXPECT_TRUE(planner.done());
}

TEST(SpeedPlanner, wait_in_front_of_a_segment_is_cycles_of_standstill_and_a_hold_stops_its_count) {
  SpeedPlanner planner(rules_of(uniform_limits(200, 1000, 20)), cycle);
  planner.push(segment({}, {1}, 100), false, 10);
  planner.finish();
  for (int k = 0; k < 5; ++k) planner.step({});
  for (int k = 0; k < 100; ++k) planner.step({1, 1, true});
  EXPECT_TRUE(planner.waiting());
  for (int k = 0; k < 4; ++k) planner.step({});
  EXPECT_EQ(planner.travelled(), 0);
  for (int k = 0; k < 2; ++k) planner.step({});
  EXPECT_GT(planner.travelled(), 0);
}

TEST(SpeedPlanner, nothing_allocates_after_construction) {
  const geometry::Chain chain = ac_table();
  Trajectory t(uniform_limits(200, 1000, 20), &chain, cycle);
  const std::size_t before = allocations;
  t.start({}, language::Transformation::rtcp, 100);
  int pushed = 0;
  for (int k = 0; k < 20000; ++k) {
    while (pushed < 6000 && t.can_accept()) {
      ++pushed;
      t.push(line_to({0.05 * pushed, std::sin(0.02 * pushed), 0, 0.01 * pushed, 0, 0.02 * pushed}, 3000));
    }
    if (pushed == 6000) t.finish();
    t.step(k % 100 < 50 ? 1 : 0.7, 1, k % 1000 < 20);
  }
  t.abort();
  for (int k = 0; k < 1000; ++k) t.step(1, 1, false);
  EXPECT_TRUE(t.at_rest());
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace trunnion::motion::test
