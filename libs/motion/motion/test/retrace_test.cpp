// SPDX-License-Identifier: Apache-2.0
// Motion backwards along the executed path: the same path, the same limits, as far back as is promised.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "motion_fixture.hpp"
#include "testing_support/rounds.hpp"

namespace trunnion::motion::test {
namespace {

using canonical::Transformation;

// Lines, corners, arcs and a dwell.
std::vector<Command> mixed_program() {
  std::vector<Command> program;
  std::uint32_t number = 0;
  const auto add = [&](Command c) {
    c.line = c.sequence = ++number;
    program.push_back(c);
  };
  add(line_to({20}, 6000));
  add(arc_to({20, 20}, 20, 10, 180, false, 6000));
  add(line_to({0, 20}, 3000));
  Command dwell;
  dwell.kind = CommandKind::dwell;
  dwell.dwell_seconds = 0.02;
  add(dwell);
  for (int k = 1; k <= 40; ++k) add(line_to({0.3 * k, 20 + 2 * std::sin(0.3 * k)}, 4000));
  return program;
}

struct Run {
  Motion motion;
  AxisValues start{};
};

void feed(Trajectory& t, const std::vector<Command>& program) {
  for (const Command& c : program) ASSERT_TRUE(t.push(c));
  t.finish();
}

TEST(Retrace, goes_back_to_the_start_over_corners_and_stops_and_forward_again_to_the_same_end) {
  const Limits limits = uniform_limits(200, 2000, 4);
  Trajectory t(limits, nullptr, cycle);
  const auto program = mixed_program();
  feed(t, program);
  Motion all;
  for (int k = 0; k < 900; ++k) all.setpoints.push_back(t.step(1, 1, false));
  t.retrace(true);
  std::size_t backwards = 0;
  while (!t.retraced_to_start() && ++backwards < 5000) {
    all.setpoints.push_back(t.step(1, 1, false));
    EXPECT_FALSE(all.setpoints.back().at_rest);
  }
  ASSERT_TRUE(t.retraced_to_start());
  EXPECT_EQ(t.position(), AxisValues{});
  EXPECT_EQ(all.setpoints.back().line, 1u);
  EXPECT_NEAR(all.setpoints.back().fraction, 0, 1e-12);
  t.retrace(false);
  do all.setpoints.push_back(t.step(1, 1, false));
  while (!all.setpoints.back().at_rest && all.setpoints.size() < 20000);
  ASSERT_TRUE(t.at_rest());
  EXPECT_EQ(t.position(), program.back().target);
  const Ratios r = axis_ratios(all, {}, limits, nullptr, 0);
  EXPECT_LE(r.velocity, 1.001);
  EXPECT_LE(r.acceleration, 1.001);
  EXPECT_LE(r.jerk, 1.001);
}

// Backwards every setpoint lies on the curve that was executed. Neighbours of that run are at most 5000
// mm/min times 1 ms = 0.083 mm apart, so with a radius of 10 mm and roundings of 0.01 mm their chord strays
// by well below a micrometre from it; overlapped stops were left by the tolerance.
TEST(Retrace, stays_on_the_executed_path_and_names_its_lines_in_reverse) {
  Limits limits = uniform_limits(200, 2000, 4);
  limits.contour_tolerance = 0.002;
  Trajectory t(limits, nullptr, cycle);
  feed(t, mixed_program());
  std::vector<AxisValues> executed{{}};
  while (!t.step(1, 1, false).at_rest) executed.push_back(t.position());
  executed.push_back(t.position());
  t.retrace(true);
  std::uint32_t line = 1000;
  Motion back;
  for (int k = 0; k < 20000 && !t.retraced_to_start(); ++k) {
    const Setpoint s = t.step(1, 1, false);
    EXPECT_LE(s.line, line);
    EXPECT_FALSE(s.dwelling);
    line = s.line;
    if (k % 7 == 0) back.setpoints.push_back(s);
  }
  ASSERT_TRUE(t.retraced_to_start());
  EXPECT_LE(contour_error(back, executed), 0.0021);
}

TEST(Retrace, five_thousand_blocks_can_be_gone_back_over_and_no_block_is_lost_forwards) {
  const Limits limits = uniform_limits(500, 3000, 1);
  Trajectory t(limits, nullptr, cycle);
  const auto point = [](std::size_t k) {
    return AxisValues{0.1 * static_cast<double>(k), 2 * std::sin(0.02 * static_cast<double>(k))};
  };
  std::size_t next = 1;
  Setpoint s;
  const auto step = [&](std::size_t upto) {
    while (next <= upto && t.can_accept())
      t.push(line_to(point(next), 6000, static_cast<std::uint32_t>(next))), ++next;
    if (next > upto) t.finish();
    s = t.step(1, 1, false);
  };
  while (s.sequence < 20000) step(25000);
  t.retrace(true);
  for (int k = 0; k < 120000 && !t.retraced_to_start(); ++k) step(25000);
  ASSERT_TRUE(t.retraced_to_start());
  EXPECT_LE(s.sequence, 20000 - Trajectory::history);
  t.retrace(false);
  while (!s.at_rest) step(25000);
  EXPECT_EQ(t.position(), point(25000));
}

TEST(Retrace, turning_at_any_cycle_under_any_override_keeps_the_limits_through_a_chain) {
  const geometry::Chain chain = ac_table();
  for (std::uint64_t seed = 1; seed <= testing_support::rounds(12); ++seed) {
    std::mt19937_64 random(seed);
    Limits limits = uniform_limits(200, 2000, 1 + static_cast<int>(seed % 10));
    const bool rtcp = seed % 2 == 0;
    Trajectory t(limits, &chain, cycle);
    t.start({}, rtcp ? Transformation::rtcp : Transformation::none, 60);
    std::vector<Command> program;
    AxisValues p{};
    for (std::uint32_t k = 1; k <= 60; ++k) {
      p[0] += 0.5;
      p[1] = 3 * std::sin(0.2 * k);
      p[canonical::A] = 20 * std::sin(0.1 * k);
      p[canonical::C] += 1;
      program.push_back(line_to(p, 3000, k));
    }
    feed(t, program);
    Motion all;
    double override_now = 1;
    const std::uint64_t pause = 20 + random() % 200;
    for (int k = 0; k < 6000; ++k) {
      if (random() % pause == 0) t.retrace(random() % 2 == 0);
      if (random() % pause == 0) override_now = 0.25 * static_cast<double>(random() % 7);
      all.setpoints.push_back(t.step(override_now, 1, false));
    }
    t.retrace(false);
    for (int k = 0; k < 20000 && !t.at_rest(); ++k) all.setpoints.push_back(t.step(1, 1, false));
    ASSERT_TRUE(t.at_rest()) << seed;
    EXPECT_EQ(t.position(), p);
    const Ratios r = axis_ratios(all, {}, limits, rtcp ? &chain : nullptr, 60);
    EXPECT_LE(r.velocity, 1.001) << seed;
    EXPECT_LE(r.acceleration, 1.001) << seed;
    EXPECT_LE(r.jerk, 1.001) << seed;
  }
}

TEST(Retrace, abort_while_going_back_stops_there_and_a_trajectory_without_a_path_stays_at_rest) {
  Trajectory t(uniform_limits(200, 2000, 4), nullptr, cycle);
  t.retrace(true);
  EXPECT_TRUE(t.step(1, 1, false).at_rest);
  feed(t, {line_to({100}, 6000)});
  for (int k = 0; k < 500; ++k) t.step(1, 1, false);
  const double farthest = t.position()[0];
  t.retrace(true);
  for (int k = 0; k < 300; ++k) t.step(1, 1, false);
  const double turned = t.position()[0];
  EXPECT_LT(turned, farthest);
  t.abort();
  for (int k = 0; k < 500; ++k) t.step(1, 1, false);
  EXPECT_TRUE(t.at_rest());
  EXPECT_LT(t.position()[0], turned);
  EXPECT_GT(t.position()[0], 0);
  EXPECT_EQ(t.end_position(), t.position());
}

}  // namespace
}  // namespace trunnion::motion::test
