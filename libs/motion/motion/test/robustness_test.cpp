// SPDX-License-Identifier: Apache-2.0
// Paths no post-processor should write. They must end, stay finite and keep the limits.
#include <gtest/gtest.h>

#include <random>

#include "motion_fixture.hpp"
#include "testing_support/rounds.hpp"

namespace trunnion::motion::test {
namespace {

using canonical::Transformation;

void expect_sound(const Motion& result, const AxisValues& start, const AxisValues& end, const Limits& limits,
                  const geometry::Chain* chain = nullptr) {
  ASSERT_TRUE(result.stopped);
  for (const Setpoint& s : result.setpoints) {
    for (const double v : s.position) ASSERT_TRUE(std::isfinite(v));
  }
  EXPECT_EQ(result.setpoints.back().position, end);
  const Ratios ratios = axis_ratios(result, start, limits, chain, 0);
  EXPECT_LE(ratios.velocity, 1.001);
  EXPECT_LE(ratios.acceleration, 1.001);
  EXPECT_LE(ratios.jerk, 1.001);
}

TEST(Robustness, duplicate_points_do_nothing) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  const Motion result = run(t, {line_to({}, 600), line_to({10}, 6000), line_to({10}, 6000),
                                line_to({10}, 6000), line_to({20}, 6000), line_to({20}, 6000)});
  expect_sound(result, {}, {20}, limits);
  // No corner, so no slower than one line of 20 mm: 0.1 s ramp, 0.1 s at 100, 0.1 s ramp, window; and 5 %
  // less acceleration is kept for the joint.
  EXPECT_LE(result.setpoints.size(), 345U);
}

TEST(Robustness, program_of_moves_without_length_is_at_rest_at_once) {
  Trajectory t(uniform_limits(100, 1000, 20), nullptr, cycle);
  EXPECT_EQ(run(t, {line_to({}, 600), line_to({}, 600)}).setpoints.size(), 1U);
}

TEST(Robustness, thousands_of_segments_of_a_nanometre_end_soon) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  AxisValues p{};
  std::vector<Command> program;
  for (int i = 0; i < 8000; ++i) {
    p[0] += 1e-6;
    p[1] = 1e-6 * unit(random);
    program.push_back(line_to(p, 6000));
  }
  p = {1, 1};
  program.push_back(line_to(p, 6000));
  const Motion result = run(t, program, 60000);
  expect_sound(result, {}, p, limits);
}

TEST(Robustness, segments_of_1e_9_mm_between_long_ones_do_not_stall) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  std::vector<Command> program;
  AxisValues p{};
  for (int i = 0; i < 50; ++i) {
    p[0] += 5;
    program.push_back(line_to(p, 6000));
    p[1] += 1e-9;
    program.push_back(line_to(p, 6000));
  }
  const Motion result = run(t, program, 60000);
  expect_sound(result, {}, p, limits);
}

TEST(Robustness, reversals_of_180_degrees_reach_the_turning_point_within_the_tolerance) {
  Limits limits = uniform_limits(100, 1000, 20);
  limits.contour_tolerance = 0.02;
  Trajectory t(limits, nullptr, cycle);
  const Motion result = run(t, {line_to({10}, 6000), line_to({0}, 6000), line_to({5}, 6000)});
  expect_sound(result, {}, {5}, limits);
  double furthest = 0;
  for (const Setpoint& s : result.setpoints) furthest = std::max(furthest, s.position[0]);
  EXPECT_GE(furthest, 10 - 0.02);
  EXPECT_LE(furthest, 10);
}

TEST(Robustness, arc_of_a_kilometre_radius_runs_like_a_line) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  const double r = 1e6, sweep = 1e-4;  // radians: 100 mm
  const AxisValues end{r * std::sin(sweep), r * (1 - std::cos(sweep))};
  const Motion result = run(t, {arc_to(end, 0, r, sweep * 180 / 3.14159265358979323846, false, 6000)});
  expect_sound(result, {}, end, limits);
  EXPECT_NEAR(static_cast<double>(result.setpoints.size()), 1120,
              10);  // 100 mm at 100 mm/s, a ramp, the window
}

TEST(Robustness, arc_of_a_micrometre_radius_ends) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  const Motion result =
      run(t, {line_to({1}, 6000), arc_to({1.002, 0}, 1.001, 0, 180, true, 6000), line_to({5}, 6000)});
  expect_sound(result, {}, {5}, limits);
}

TEST(Robustness, tiny_feed_moves_at_that_feed) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  const Motion result = run(t, {line_to({0.001}, 0.06)});  // 1 um/s over 1 um
  expect_sound(result, {}, {0.001}, limits);
  EXPECT_NEAR(static_cast<double>(result.setpoints.size()), 1000, 5);
}

TEST(Robustness, rotary_move_with_a_trace_of_linear_travel_ends) {
  const geometry::Chain chain = ac_table();
  const Limits limits = uniform_limits(100, 1000, 20);
  for (const double trace : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
    Trajectory t(limits, &chain, cycle);
    t.start({20, 0, 0}, Transformation::rtcp, 0);
    AxisValues a{20, 0, 0}, b{20 + trace, 0, 0};
    b[canonical::C] = 30;
    AxisValues c = b;
    c[0] += 10;
    const Motion result = run(t, {line_to(b, 6000), line_to(c, 6000)}, 200000);
    SCOPED_TRACE(trace);
    expect_sound(result, a, c, limits, &chain);
  }
}

// 3.6 million cycles. The motion rests on the path where it stopped and continues to the same end.
TEST(Robustness, an_override_of_zero_for_an_hour_loses_nothing) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  ASSERT_TRUE(t.push(line_to({50}, 6000)));
  ASSERT_TRUE(t.push(line_to({50, 50}, 6000)));
  t.finish();
  for (int k = 0; k < 300; ++k) t.step(1, 1, false);
  for (int k = 0; k < 1000; ++k) t.step(0, 1, false);
  const AxisValues stopped = t.position();
  for (int k = 0; k < 3600000; ++k) t.step(0, 1, false);
  EXPECT_EQ(t.position(), stopped);
  EXPECT_FALSE(t.at_rest());
  int cycles = 0;
  while (!t.step(1, 1, false).at_rest && ++cycles < 5000) {
  }
  EXPECT_EQ(t.position(), (AxisValues{50, 50}));
}

TEST(Robustness, feeds_that_make_no_motion_are_refused_before_anything_moves) {
  Trajectory t(uniform_limits(100, 1000, 20), nullptr, cycle);
  for (const double feed : {0.0, -100.0, std::nan(""), HUGE_VAL}) EXPECT_FALSE(t.push(line_to({10}, feed)));
  EXPECT_TRUE(t.at_rest());
  EXPECT_EQ(t.end_position(), AxisValues{});
}

TEST(Robustness, an_axis_without_limits_refuses_to_move_and_the_others_do_not_care) {
  for (const auto limit : {&AxisLimits::velocity, &AxisLimits::acceleration, &AxisLimits::jerk}) {
    Limits limits = uniform_limits(100, 1000, 20);
    limits.axes[canonical::Y].*limit = 0;
    Trajectory t(limits, nullptr, cycle);
    EXPECT_FALSE(t.push(line_to({10, 10}, 6000)));
    EXPECT_TRUE(t.push(line_to({10}, 6000)));
    t.finish();
    for (int k = 0; k < 2000 && !t.step(1, 1, false).at_rest; ++k) {
    }
    EXPECT_EQ(t.position(), AxisValues{10});
  }
}

// C by half a turn within a millimetre of tip travel, forth and back: the rotary axis sets the pace.
TEST(Robustness, flips_of_the_orientation_run_at_the_pace_of_the_rotary_axis) {
  const geometry::Chain chain = ac_table();
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, &chain, cycle);
  const AxisValues start{20, 0, 0, 30};
  t.start(start, Transformation::rtcp, 50);
  std::vector<Command> program;
  AxisValues p = start;
  for (int k = 0; k < 6; ++k) {
    p[0] += 1;
    p[canonical::A] = -p[canonical::A];
    p[canonical::C] += k % 2 == 0 ? 180 : -180;
    program.push_back(line_to(p, 6000));
  }
  const Motion result = run(t, program, 200000);
  ASSERT_TRUE(result.stopped);
  EXPECT_EQ(t.position(), p);
  const Ratios ratios = axis_ratios(result, start, limits, &chain, 50);
  EXPECT_LE(ratios.velocity, 1.001);
  EXPECT_LE(ratios.acceleration, 1.001);
  EXPECT_LE(ratios.jerk, 1.001);
}

// The end of the program is not reported: the motion stops by itself at the end of the known path, within the
// limits, and reports that it is not at rest. A block is known when its curve is, for which 16 mm and 16
// lines behind it are awaited, and the line that follows has begun.
TEST(Robustness, a_program_that_ends_in_motion_without_an_end_stops_on_its_path) {
  const Limits limits = uniform_limits(100, 1000, 20);
  Trajectory t(limits, nullptr, cycle);
  Motion motion;
  for (int k = 1; k <= 40; ++k) ASSERT_TRUE(t.push(line_to({1.0 * k}, 6000)));
  for (int k = 0; k < 2000; ++k) motion.setpoints.push_back(t.step(1, 1, false));
  EXPECT_EQ(motion.setpoints.back().path_speed, 0);
  EXPECT_FALSE(t.at_rest());
  EXPECT_GE(t.position()[0], 40 - 17);
  EXPECT_LE(t.position()[0], 40);
  t.finish();
  for (int k = 0; k < 2000 && !t.at_rest(); ++k) motion.setpoints.push_back(t.step(1, 1, false));
  EXPECT_EQ(t.position(), AxisValues{40});
  EXPECT_LE(axis_ratios(motion, {}, limits, nullptr, 0).jerk, 1.001);
}

// 0.02 mm at 100 mm/s are a fifth of a cycle. The feeder brings 20 blocks in every cycle, 0.4 mm, four times
// what is travelled; so the speed comes up and stays.
TEST(Robustness, blocks_shorter_than_a_cycle_do_not_starve) {
  const Limits limits = uniform_limits(200, 2000, 4);
  Trajectory t(limits, nullptr, cycle);
  std::uint32_t next = 1;
  int slow = 0;
  for (int k = 0; k < 1500; ++k) {
    for (int n = 0; n < 20 && t.can_accept(); ++n, ++next) {
      const double x = 0.02 * next;
      ASSERT_TRUE(t.push(line_to({x, std::sin(0.05 * x)}, 6000, next)));
    }
    const Setpoint s = t.step(1, 1, false);
    if (k > 300 && s.path_speed < 99) ++slow;
  }
  EXPECT_EQ(slow, 0);
}

// Rapids and feeds in turn; every override and the hold change at random cycles.
TEST(Robustness, rapids_under_random_overrides_and_holds_keep_the_limits) {
  for (std::uint64_t seed = 1; seed <= testing_support::rounds(10); ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const Limits limits = uniform_limits(150, 2000, static_cast<int>(1 + random() % 40));
    Trajectory t(limits, nullptr, cycle);
    AxisValues p{};
    for (int k = 0; k < 30; ++k) {
      const double size = std::pow(10, 1.5 * unit(random));
      for (std::size_t i = 0; i < 6; ++i)
        if (random() % 2 == 0) p[i] += size * unit(random);
      Command c = line_to(p, 6000, static_cast<std::uint32_t>(k + 1));
      if (random() % 2 == 0) c.kind = CommandKind::rapid;
      ASSERT_TRUE(t.push(c));
    }
    t.finish();
    double feed = 1, rapid = 1;
    bool hold = false;
    const std::uint64_t pause = 1 + random() % 80;
    Motion result;
    while (result.setpoints.size() < 400000 && !t.at_rest()) {
      if (random() % pause == 0) feed = 1.5 * static_cast<double>(random() % 7) / 6;
      if (random() % pause == 0) rapid = static_cast<double>(random() % 5) / 4;
      if (random() % pause == 0) hold = random() % 3 == 0;
      result.setpoints.push_back(t.step(feed, rapid, hold));
    }
    result.stopped = t.at_rest();
    SCOPED_TRACE(seed);
    ASSERT_TRUE(result.stopped);
    EXPECT_EQ(t.position(), p);
    const Ratios ratios = axis_ratios(result, {}, limits, nullptr, 0, true);
    EXPECT_LE(ratios.velocity, 1.001);
    EXPECT_LE(ratios.acceleration, 1.001);
    EXPECT_LE(ratios.jerk, 1.001);
  }
}

// A jog is a line to the end of the travel that is let go of at any cycle. The next one begins where it
// stopped.
TEST(Robustness, jogs_let_go_of_at_any_cycle_under_any_override_keep_the_limits_and_the_travel) {
  const Limits limits = uniform_limits(100, 1000, 20);
  for (std::uint64_t seed = 1; seed <= testing_support::rounds(10); ++seed) {
    std::mt19937_64 random(seed);
    Trajectory t(limits, nullptr, cycle);
    Motion result;
    for (int k = 0; k < 12; ++k) {
      AxisValues end = t.position();
      const std::size_t axis = random() % 3;
      end[axis] = random() % 2 == 0 ? 40 : -40;
      ASSERT_TRUE(t.push(line_to(end, 100 + 5900 * static_cast<double>(random() % 1000) / 1000)));
      t.finish();
      double feed = 1;
      bool hold = false;
      const std::uint64_t pause = 1 + random() % 60, held_for = random() % 1500;
      for (std::uint64_t n = 0; !t.at_rest() && n < 200000; ++n) {
        if (n == held_for) t.abort();
        if (random() % pause == 0) feed = 1.5 * static_cast<double>(random() % 7) / 6;
        if (random() % pause == 0) hold = random() % 4 == 0;
        result.setpoints.push_back(t.step(feed, 1, hold));
      }
      ASSERT_TRUE(t.at_rest());
      EXPECT_LE(std::abs(t.position()[axis]), 40);
    }
    SCOPED_TRACE(seed);
    const Ratios ratios = axis_ratios(result, {}, limits, nullptr, 0);
    EXPECT_LE(ratios.velocity, 1.001);
    EXPECT_LE(ratios.acceleration, 1.001);
    EXPECT_LE(ratios.jerk, 1.001);
  }
}

TEST(Robustness, mixed_noise_of_every_kind_ends_and_keeps_the_limits) {
  // In 171 a cell that permits almost no acceleration follows one that permits much.
  for (const std::uint64_t seed : {0, 1, 2, 3, 4, 5, 6, 7, 171}) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const Limits limits = uniform_limits(100, 1000, static_cast<int>(1 + random() % 64));
    Trajectory t(limits, nullptr, cycle);
    AxisValues p{};
    std::vector<Command> program;
    for (int i = 0; i < 30; ++i) {
      const AxisValues from = p;
      const double size = std::pow(10, 4 * unit(random) - 2.5);
      for (std::size_t k = 0; k < 9; ++k) {
        if (random() % 3 == 0) p[k] += size * unit(random);
      }
      if (random() % 4 == 0) {
        const double cx = from[0] + size * unit(random), cy = from[1] + size * unit(random);
        const double r = std::hypot(from[0] - cx, from[1] - cy);
        const double sweep = 180 * (1 + unit(random)) + 1;
        const double end = std::atan2(from[1] - cy, from[0] - cx) + sweep * 3.14159265358979323846 / 180;
        p[0] = cx + r * std::cos(end);
        p[1] = cy + r * std::sin(end);
        program.push_back(arc_to(p, cx, cy, sweep, false, 3000));
      } else {
        program.push_back(line_to(p, 3000 + 2900 * unit(random)));
      }
      if (random() % 20 == 0) program.back().modal.path_control = canonical::PathControl::exact_stop;
    }
    const Motion result = run(t, program, 400000);
    SCOPED_TRACE(seed);
    expect_sound(result, {}, p, limits);
  }
}

}  // namespace
}  // namespace trunnion::motion::test
