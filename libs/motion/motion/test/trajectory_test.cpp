// SPDX-License-Identifier: Apache-2.0
#include "motion/trajectory.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "motion_fixture.hpp"
#include "testing_support/rounds.hpp"

namespace trunnion::motion::test {
namespace {

using canonical::Transformation;

Command rapid_to(const AxisValues& target) {
  Command c = line_to(target, 0);
  c.kind = CommandKind::rapid;
  return c;
}

Command dwell(double seconds, std::uint32_t number = 1) {
  Command c;
  c.kind = CommandKind::dwell;
  c.line = c.sequence = number;
  c.dwell_seconds = seconds;
  return c;
}

// 100 mm at a = 3000 up to 500 mm/s: 83.3 mm are accelerated and braked in 2 * 166.7 ms, 16.7 mm take 33.3 ms
// at 500: 366.7 ms, and the moving average of N = 50 cycles adds 50. Cycles round each of the phases up.
TEST(Trajectory, single_line_takes_the_time_of_its_trapezoid_plus_the_smoothing_window) {
  const Limits limits = uniform_limits(500, 3000, 50);
  Trajectory t(limits, nullptr, cycle);
  const Motion result = run(t, {line_to({100}, 30000)});
  ASSERT_TRUE(result.stopped);
  EXPECT_GE(result.setpoints.size(), 416U);
  EXPECT_LE(result.setpoints.size(), 421U);
  EXPECT_EQ(result.setpoints.back().position, (AxisValues{100}));
  const Ratios ratios = axis_ratios(result, {}, limits, nullptr, 0);
  EXPECT_LE(ratios.velocity, 1 + 1e-9);
  EXPECT_LE(ratios.acceleration, 1 + 1e-9);
  EXPECT_GE(ratios.acceleration, 0.99);  // and it uses what it has
}

// A = 3000 over T = 50 ms is a jerk of 60000; a reversal from +A to -A would be twice that, which a line of
// this length with its plateau of 33 ms < T does reach in part, never more.
TEST(Trajectory, jerk_of_a_line_is_bounded_by_twice_the_acceleration_over_the_window) {
  const Limits limits = uniform_limits(500, 3000, 50);
  Trajectory t(limits, nullptr, cycle);
  double x1 = 0, x2 = 0, x3 = 0, worst = 0;
  for (const Setpoint& s : run(t, {line_to({100}, 30000)}).setpoints) {
    const double x = s.position[0];
    worst = std::max(worst, std::abs(x - 3 * x1 + 3 * x2 - x3) / (cycle * cycle * cycle));
    x3 = x2, x2 = x1, x1 = x;
  }
  EXPECT_LE(worst, 2 * 3000 / 0.05 * (1 + 1e-3));
}

TEST(Trajectory, targets_that_are_not_representable_are_met_bit_for_bit_over_many_lines) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> position(-50, 50);
  Trajectory t(uniform_limits(300, 3000, 20), nullptr, cycle);
  for (int i = 0; i < 50; ++i) {
    AxisValues target{};
    for (double& v : target) v = position(random);
    const Motion result = run(t, {line_to(target, 10000)});
    ASSERT_TRUE(result.stopped);
    ASSERT_EQ(t.position(), target);
    ASSERT_EQ(result.setpoints.back().distance_to_go, AxisValues{});
    ASSERT_EQ(result.setpoints.back().fraction, 1);
  }
}

TEST(Trajectory, two_runs_of_the_same_calls_give_the_same_bits) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> position(-5, 5);
  std::vector<Command> program;
  for (int i = 0; i < 300; ++i) program.push_back(line_to({position(random), position(random)}, 6000));
  const geometry::Chain chain = ac_table();
  Trajectory a(uniform_limits(300, 3000, 20), &chain, cycle), b(uniform_limits(300, 3000, 20), &chain, cycle);
  run(b, {line_to({1, 2, 3}, 1000)});  // a history must leave no trace
  a.start({}, Transformation::rtcp, 50);
  b.start({}, Transformation::rtcp, 50);
  const Motion first = run(a, program), second = run(b, program);
  ASSERT_EQ(first.setpoints.size(), second.setpoints.size());
  for (std::size_t i = 0; i < first.setpoints.size(); ++i) {
    ASSERT_EQ(first.setpoints[i].position, second.setpoints[i].position) << i;
  }
}

TEST(Trajectory, feed_is_reached_and_never_exceeded_on_a_long_line) {
  Trajectory t(uniform_limits(500, 3000, 20), nullptr, cycle);
  double fastest = 0;
  for (const Setpoint& s : run(t, {line_to({60, 80}, 6000)}).setpoints) fastest = std::max(fastest, s.feed);
  EXPECT_NEAR(fastest, 100, 1e-9);
}

// 30 mm and 90 degrees of C in F2 1/min: half a minute, 1 mm/s along the path.
TEST(Trajectory, inverse_time_feed_gives_the_time_of_the_whole_command) {
  Command c = line_to({30, 0, 0, 0, 0, 90}, 2);
  c.modal.feed_mode = canonical::FeedMode::inverse_time;
  Trajectory t(uniform_limits(500, 3000, 10), nullptr, cycle);
  const Motion whole = run(t, {c});
  EXPECT_NEAR(static_cast<double>(whole.setpoints.size()) * cycle, 30, 0.1);
  // The last third alone takes a third of the time.
  t.start({20, 0, 0, 0, 0, 60}, Transformation::none, 0);
  ASSERT_TRUE(t.push_from(c, 2.0 / 3));
  t.finish();
  std::size_t cycles = 1;
  while (!t.step(1, 1, false).at_rest) ++cycles;
  EXPECT_NEAR(static_cast<double>(cycles) * cycle, 10, 0.1);
}

// With a feed of 3600 deg/min C turns 60 deg/s.
TEST(Trajectory, feed_of_a_purely_rotary_move_counts_degrees) {
  Trajectory t(uniform_limits(500, 3000, 10), nullptr, cycle);
  double fastest = 0;
  for (const Setpoint& s : run(t, {line_to({0, 0, 0, 0, 0, 90}, 3600)}).setpoints)
    fastest = std::max(fastest, s.path_speed);
  EXPECT_NEAR(fastest, 60, 1e-9);
}

// 3 mm and 4 degrees with F1200: 20 units/s of the 5 they are together, so X has 12 mm/s; 20 mm/s when F
// counts X alone. With tool tip control F is the speed of the tip, whatever the rule.
TEST(Trajectory, feed_of_linear_and_rotary_axes_counts_both_or_the_linear_ones) {
  const geometry::Chain chain = ac_table();
  const auto fastest = [&](bool combined, Transformation transformation) {
    Limits limits = uniform_limits(500, 3000, 10);
    limits.combined_feed = combined;
    Trajectory t(limits, &chain, cycle);
    t.start({}, transformation, 0);
    t.push(line_to({30, 0, 0, 0, 0, 40}, 1200));
    t.finish();
    double most = 0;
    for (Setpoint s = t.step(1, 1, false); !s.at_rest; s = t.step(1, 1, false))
      most = std::max(most, s.path_speed);
    return most;
  };
  EXPECT_NEAR(fastest(true, Transformation::none), 12, 1e-6);
  EXPECT_NEAR(fastest(false, Transformation::none), 20, 1e-6);
  EXPECT_NEAR(fastest(true, Transformation::rtcp), 20, 1e-6);
}

// X has 200 mm/s at rapid and 100 to go, Y 50 mm/s and 100: Y rules, both arrive together.
TEST(Trajectory, rapid_moves_all_axes_together_at_the_pace_of_the_slowest) {
  Limits limits = uniform_limits(100, 2000, 10);
  limits.axes[0].rapid_velocity = 200;
  limits.axes[1].rapid_velocity = 50;
  Trajectory t(limits, nullptr, cycle);
  const Motion result = run(t, {rapid_to({100, 100})});
  double fastest = 0;
  for (std::size_t i = 1; i < result.setpoints.size(); ++i) {
    const AxisValues& p = result.setpoints[i].position;
    EXPECT_NEAR(p[0], p[1], 1e-9);
    fastest = std::max(fastest, (p[1] - result.setpoints[i - 1].position[1]) / cycle);
  }
  EXPECT_NEAR(fastest, 50, 1e-9);
  EXPECT_LE(axis_ratios(result, {}, limits, nullptr, 0, true).acceleration, 1.001);
}

TEST(Trajectory, rapid_override_slows_rapids_only_and_feed_override_feeds_only) {
  Trajectory t(uniform_limits(100, 2000, 10), nullptr, cycle);
  const auto fastest_of = [&](const Command& c, double feed, double rapid) {
    t.start({}, Transformation::none, 0);
    t.push(c);
    t.finish();
    double fastest = 0;
    Setpoint s;
    do {
      s = t.step(feed, rapid, false);
      fastest = std::max(fastest, s.feed);
    } while (!s.at_rest);
    return fastest;
  };
  EXPECT_NEAR(fastest_of(rapid_to({100}), 0.5, 0.25), 50, 1e-9);       // 200 * 0.25
  EXPECT_NEAR(fastest_of(line_to({100}, 3000), 0.5, 0.25), 25, 1e-9);  // 50 * 0.5
  EXPECT_NEAR(fastest_of(line_to({100}, 3000), 1.5, 1), 75, 1e-9);     // 50 * 1.5
  EXPECT_NEAR(fastest_of(line_to({100}, 5400), 1.5, 1), 100, 1e-9);    // 135, but the axis allows 100
}

TEST(Trajectory, exact_stop_reaches_the_corner_bit_for_bit_before_the_next_line_starts) {
  Trajectory t(uniform_limits(500, 3000, 30), nullptr, cycle);
  const AxisValues corner{10.1, 0.3};
  std::vector<Command> program{line_to(corner, 6000, 1), line_to({10.1, 20}, 6000, 2)};
  program[0].modal.path_control = canonical::PathControl::exact_stop;
  const Motion result = run(t, program);
  bool met = false;
  for (const Setpoint& s : result.setpoints) met = met || s.position == corner;
  EXPECT_TRUE(met);
  // Without it the corner is rounded within the tolerance.
  t.start({}, Transformation::none, 0);
  program[0].modal.path_control = canonical::PathControl::continuous;
  met = false;
  for (const Setpoint& s : run(t, program).setpoints) met = met || s.position == corner;
  EXPECT_FALSE(met);
}

TEST(Trajectory, dwell_stands_on_the_point_at_least_as_long_as_programmed) {
  Trajectory t(uniform_limits(500, 3000, 20), nullptr, cycle);
  const Motion result = run(t, {line_to({10}, 6000, 1), dwell(0.25, 2), line_to({20}, 6000, 3)});
  ASSERT_TRUE(result.stopped);
  int standing = 0;
  bool dwelling_reported = false;
  for (const Setpoint& s : result.setpoints) {
    if (s.position[0] == 10) ++standing;
    dwelling_reported = dwelling_reported || (s.dwelling && s.line == 2);
  }
  EXPECT_GE(standing, 250);
  EXPECT_LE(standing, 255);
  EXPECT_TRUE(dwelling_reported);
  EXPECT_EQ(t.position(), (AxisValues{20}));
}

TEST(Trajectory, a_program_of_a_dwell_alone_ends) {
  Trajectory t(uniform_limits(500, 3000, 20), nullptr, cycle);
  const Motion result = run(t, {dwell(0.1)}, 1000);
  ASSERT_TRUE(result.stopped);
  EXPECT_NEAR(static_cast<double>(result.setpoints.size()), 100, 25);  // and the smoothing window
}

TEST(Trajectory, hold_brakes_on_the_path_stands_and_resumes_to_the_same_end) {
  const Limits limits = uniform_limits(500, 2000, 20);
  Trajectory t(limits, nullptr, cycle);
  for (const std::size_t at : {5U, 60U, 150U, 290U}) {
    t.start({}, Transformation::none, 0);
    t.push(line_to({10, 10}, 6000));
    t.push(line_to({20, 0}, 6000));
    t.finish();
    Motion result;
    std::size_t standing = 0;
    for (std::size_t k = 0; k < 5000; ++k) {
      const bool hold = k >= at && k < at + 1000;
      result.setpoints.push_back(t.step(1, 1, hold));
      const std::size_t n = result.setpoints.size();
      if (hold && n > 1 && result.setpoints[n - 1].position == result.setpoints[n - 2].position) ++standing;
      if (result.setpoints.back().at_rest) break;
    }
    EXPECT_GE(standing, 800U) << at;
    EXPECT_EQ(t.position(), (AxisValues{20, 0}));
    EXPECT_LE(axis_ratios(result, {}, limits, nullptr, 0).acceleration, 1.001) << at;
    EXPECT_LE(contour_error(result, {{}, {10, 10}, {20, 0}}), limits.contour_tolerance) << at;
  }
}

TEST(Trajectory, override_that_changes_at_any_cycle_keeps_the_limits_and_the_path) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(-1, 1);
  Limits limits = uniform_limits(150, 2000, 25);
  std::vector<AxisValues> points{{}};
  std::vector<Command> program;
  for (int i = 1; i < 150; ++i) {
    const double size = i % 3 == 0 ? 8 : 0.7;
    points.push_back(
        {points.back()[0] + size * (0.5 + unit(random)), points.back()[1] + size * unit(random)});
    program.push_back(line_to(points.back(), 6000 + 3000 * unit(random)));
  }
  for (std::uint64_t seed = 0; seed < testing_support::rounds(10); ++seed) {
    std::mt19937_64 changes(seed);
    double value = 1;
    Trajectory t(limits, nullptr, cycle);
    const Motion result = run(t, program, 1000000, [&](std::size_t) {
      if (changes() % 40 == 0) value = 1.5 * static_cast<double>(changes() % 5) / 4;
      return value;
    });
    ASSERT_TRUE(result.stopped);
    const Ratios ratios = axis_ratios(result, {}, limits, nullptr, 0);
    EXPECT_LE(ratios.velocity, 1.001);
    EXPECT_LE(ratios.acceleration, 1.001);
    EXPECT_LE(contour_error(result, points), limits.contour_tolerance);
    EXPECT_EQ(t.position(), points.back());
  }
}

TEST(Trajectory, abort_stops_on_the_path_within_the_braking_distance_and_drops_the_rest) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  t.push(line_to({1000}, 6000));
  t.finish();
  for (int k = 0; k < 500; ++k) t.step(1, 1, false);
  const double at = t.position()[0];
  t.abort();
  EXPECT_FALSE(t.can_accept());
  int cycles = 0;
  while (!t.step(1, 1, false).at_rest) ASSERT_LT(++cycles, 200);
  // The acceleration of 1000 builds up in 20 cycles, so j = 50000: v / 2 (v / a + a / j) = 50 (0.1 + 0.02) =
  // 6 mm.
  EXPECT_NEAR(t.position()[0] - at, 6, 0.11);
  EXPECT_EQ(t.end_position(), t.position());
  const AxisValues where = t.position();
  const Motion back = run(t, {line_to({0}, 6000)});
  EXPECT_TRUE(back.stopped);
  EXPECT_NEAR(back.setpoints.front().position[0], where[0], 1e-3);
  EXPECT_EQ(t.position(), AxisValues{});
}

TEST(Trajectory, abort_of_a_standing_trajectory_changes_nothing) {
  Trajectory t(uniform_limits(100, 1000, 20), nullptr, cycle);
  t.abort();
  EXPECT_TRUE(t.at_rest());
  EXPECT_TRUE(run(t, {line_to({1}, 600)}).stopped);
}

TEST(Trajectory, restart_from_the_middle_of_an_arc_runs_the_rest_of_it) {
  const Limits limits = uniform_limits(100, 1000, 20);
  const Command arc = arc_to({-10, 0}, 0, 0, 180, false, 3000);
  Trajectory t(limits, nullptr, cycle);
  t.start({10, 0}, Transformation::none, 0);
  t.push(arc);
  t.finish();
  for (int k = 0; k < 300; ++k) t.step(1, 1, false);
  t.abort();
  Setpoint s;
  do s = t.step(1, 1, false);
  while (!s.at_rest);
  const double fraction = s.fraction;
  const AxisValues where = s.position;
  EXPECT_NEAR(std::hypot(where[0], where[1]), 10, limits.arc_tolerance);
  // The point at that fraction of the sweep: 180 * fraction degrees.
  EXPECT_NEAR(std::atan2(where[1], where[0]), std::numbers::pi * fraction, 1e-9);
  t.start(where, Transformation::none, 0);
  ASSERT_TRUE(t.push_from(arc, fraction));
  t.finish();
  do {
    s = t.step(1, 1, false);
    ASSERT_NEAR(std::hypot(s.position[0], s.position[1]), 10, limits.arc_tolerance);
    ASSERT_GE(s.fraction, fraction);
  } while (!s.at_rest);
  EXPECT_EQ(s.fraction, 1);
  EXPECT_EQ(t.position(), (AxisValues{-10, 0}));
}

TEST(Trajectory, motion_starts_before_the_program_is_known_to_its_end_and_can_always_stop_in_what_is_known) {
  const Limits limits = uniform_limits(200, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  std::vector<AxisValues> points{{}};
  Motion result;
  for (int i = 1; i <= 300; ++i) {  // a slow sender: one segment, of 0.2 mm, every ten cycles
    points.push_back({0.2 * i, 0.001 * (i % 2)});
    ASSERT_TRUE(t.push(line_to(points.back(), 6000)));
    for (int k = 0; k < 10; ++k) result.setpoints.push_back(t.step(1, 1, false));
  }
  EXPECT_GT(t.position()[0], 30);
  EXPECT_FALSE(t.at_rest());
  for (int k = 0; k < 500; ++k) result.setpoints.push_back(t.step(1, 1, false));  // then nothing: it waits
  EXPECT_LT(t.position()[0], 60);
  EXPECT_FALSE(t.at_rest());
  t.finish();
  while (!result.setpoints.back().at_rest) result.setpoints.push_back(t.step(1, 1, false));
  EXPECT_EQ(t.position(), points.back());
  EXPECT_LE(axis_ratios(result, {}, limits, nullptr, 0).acceleration, 1.001);
  EXPECT_LE(contour_error(result, points), limits.contour_tolerance);
}

TEST(Trajectory, refuses_what_makes_no_move_and_changes_nothing) {
  Trajectory t(uniform_limits(100, 1000, 20), nullptr, cycle);
  EXPECT_FALSE(t.push(line_to({std::numeric_limits<double>::quiet_NaN()}, 1000)));
  EXPECT_FALSE(t.push(line_to({std::numeric_limits<double>::infinity()}, 1000)));
  EXPECT_FALSE(t.push(line_to({1}, 0)));
  EXPECT_FALSE(t.push(line_to({1}, -5)));
  EXPECT_FALSE(t.push(arc_to({1}, 0, 0, -90, false, 1000)));
  EXPECT_FALSE(t.push(arc_to({1}, std::numeric_limits<double>::quiet_NaN(), 0, 90, false, 1000)));
  EXPECT_FALSE(t.push(dwell(-1)));
  EXPECT_FALSE(t.push_from(line_to({1}, 1000), 1.5));
  Command m;
  m.kind = CommandKind::auxiliary;
  EXPECT_FALSE(t.push(m));
  EXPECT_TRUE(t.at_rest());
  EXPECT_EQ(t.end_position(), AxisValues{});
}

// 10,500 blocks of 0.02 mm along a slight curve, 210 mm, at 1500 mm/s2: v^2 / 3000 + 0.0125 v = 105
// has v = 543 mm/s. The last 5,000 blocks, 100 mm, are what braking from 529 takes, so a planner that looks
// less far ahead stays slower.
TEST(Trajectory, brakes_for_an_end_that_is_5000_blocks_ahead) {
  Limits limits = uniform_limits(600, 1500, 1);
  Trajectory t(limits, nullptr, cycle);
  std::vector<Command> program;
  for (int k = 1; k <= 10500; ++k) program.push_back(line_to({0.02 * k, 0.02 * k * 0.02 * k / 2e6}, 36000));
  const Motion result = run(t, program);
  ASSERT_TRUE(result.stopped);
  double fastest = 0;
  for (const Setpoint& s : result.setpoints) fastest = std::max(fastest, s.path_speed);
  EXPECT_GE(fastest, 529);
  const Ratios ratios = axis_ratios(result, {}, limits, nullptr, 0);
  EXPECT_LE(ratios.velocity, 1.001);
  EXPECT_LE(ratios.acceleration, 1.001);
  EXPECT_LE(ratios.jerk, 1.001);
}

TEST(Trajectory, a_full_ring_refuses_and_accepts_again_while_it_runs) {
  Trajectory t(uniform_limits(100, 1000, 20), nullptr, cycle);
  int pushed = 0;
  while (t.can_accept()) ASSERT_TRUE(t.push(line_to({0.1 * ++pushed}, 6000)));
  EXPECT_GE(pushed, 5000);
  EXPECT_FALSE(t.push(line_to({0.1 * (pushed + 1)}, 6000)));
  for (int k = 0; k < 200; ++k) t.step(1, 1, false);
  EXPECT_TRUE(t.can_accept());
}

// Two lines with an exact stop between: without a check the stop is one cycle long, with one it lasts until
// it is ended, or its longest time.
TEST(Trajectory, an_exact_stop_with_a_position_check_lasts_until_it_is_ended) {
  for (const int ended_after : {5, 1000}) {
    constexpr int longest = 200;
    Trajectory t(uniform_limits(500, 3000, 20), nullptr, cycle);
    t.start({}, Transformation::none, 0);
    t.set_position_check(longest);
    auto first = line_to({10}, 6000, 1);
    first.modal.path_control = canonical::PathControl::exact_stop;
    ASSERT_TRUE(t.push(first));
    ASSERT_TRUE(t.push(line_to({20}, 6000, 2)));
    t.finish();
    int checked = 0, at_stop = 0;
    for (int n = 0; n < 5000 && !t.at_rest(); ++n) {
      if (t.position_check_left() > 0 && ++checked == ended_after) t.end_position_check();
      const auto setpoint = t.step(1, 1, false);
      if (setpoint.position[0] == 10) {
        ++at_stop;
        EXPECT_TRUE(setpoint.sequence != 1 || setpoint.fraction == 1) << "done while it is checked";
      }
    }
    EXPECT_TRUE(t.at_rest());
    EXPECT_EQ(t.position(), (AxisValues{20}));
    EXPECT_GE(at_stop, std::min(ended_after, longest));
    EXPECT_LE(at_stop, std::min(ended_after, longest) + 3);
  }
}

TEST(Trajectory, a_position_check_is_not_counted_down_while_held_and_can_be_restarted) {
  Trajectory t(uniform_limits(500, 3000, 20), nullptr, cycle);
  t.start({}, Transformation::none, 0);
  t.set_position_check(100);
  auto move = line_to({10}, 6000, 1);
  move.modal.path_control = canonical::PathControl::exact_stop;
  ASSERT_TRUE(t.push(move));
  t.finish();
  while (t.position_check_left() != 40) {
    ASSERT_FALSE(t.at_rest()) << "the end of the path is checked as well";
    t.step(1, 1, false);
  }
  for (int n = 0; n < 50; ++n) t.step(1, 1, true);
  EXPECT_EQ(t.position_check_left(), 40);
  t.restart_position_check();
  EXPECT_EQ(t.position_check_left(), 100);
  t.end_position_check();
  t.step(1, 1, false);
  EXPECT_TRUE(t.at_rest());
}

}  // namespace
}  // namespace trunnion::motion::test
