// SPDX-License-Identifier: Apache-2.0
// Plans of the speed on dense curves: limits under overrides, holds, resets and retracing, and repeatability.
#include "motion/planned_speed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <tuple>

#include "motion_fixture.hpp"

namespace trunnion::motion::test {
namespace {

using canonical::Transformation;

// A winding line with waves of random lengths in Z, its points rounded: smooth to kinked. With five axes the
// tool tilts and the table turns along it.
std::vector<AxisValues> relief(std::uint64_t seed, int count, bool five_axis = false) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double grain = std::pow(10, -2 - static_cast<int>(random() % 3)), step = 0.03 + 0.1 * unit(random);
  std::array<std::array<double, 3>, 12> waves{};
  for (auto& wave : waves) wave = {0.3 + 9 * unit(random), 6.3 * unit(random), 0.3 * (unit(random) - 0.5)};
  std::vector<AxisValues> points;
  for (int k = 0; k < count; ++k) {
    const double u = step * k;
    AxisValues p{u, 4 * std::sin(0.2 * u), 0};
    for (const auto& [number, phase, height] : waves) p[2] += height / number * std::sin(number * u + phase);
    if (five_axis) {
      p[canonical::A] = 20 + 10 * std::sin(0.3 * u);
      p[canonical::C] = 2 * u + 30 * std::sin(0.1 * u);
    }
    for (double& v : p) v = std::round(v / grain) * grain;
    points.push_back(p);
  }
  return points;
}

std::vector<Command> program_of(const std::vector<AxisValues>& points, double feed) {
  std::vector<Command> program;
  for (std::size_t k = 1; k < points.size(); ++k)
    if (points[k] != points[k - 1])
      program.push_back(line_to(points[k], feed, static_cast<std::uint32_t>(k)));
  return program;
}

Limits strong() {
  Limits limits = uniform_limits(500, 3000, 1);
  for (std::size_t i = canonical::A; i <= canonical::C; ++i) limits.axes[i] = {360, 360, 3000, 60000};
  return limits;
}

constexpr double relief_tool = 100;

void expect_limits(const std::vector<Setpoint>& setpoints, const AxisValues& start, const Limits& limits,
                   const geometry::Chain* chain = nullptr) {
  Motion motion;
  motion.setpoints = setpoints;
  const Ratios ratios = axis_ratios(motion, start, limits, chain, relief_tool);
  EXPECT_LE(ratios.velocity, 1.001);
  EXPECT_LE(ratios.acceleration, 1.001);
  EXPECT_LE(ratios.jerk, 1.001);
}

/// A trajectory that knows all of the path `points`, with five axes through the chain of an AC table.
struct KnownPath {
  KnownPath(const std::vector<AxisValues>& points, bool five_axis)
      : chain(ac_table()), used(five_axis ? &chain : nullptr), t(strong(), used, cycle) {
    t.start(points.front(), five_axis ? Transformation::rtcp : Transformation::none, relief_tool);
    for (const Command& command : program_of(points, 6000)) EXPECT_TRUE(t.push(command));
    t.finish();
  }
  const geometry::Chain chain;
  const geometry::Chain* used;
  Trajectory t;
};

class PlannedRelief : public ::testing::TestWithParam<std::tuple<std::uint64_t, bool>> {};
INSTANTIATE_TEST_SUITE_P(seeds_three_and_five_axes, PlannedRelief,
                         ::testing::Combine(::testing::Range<std::uint64_t>(0, 40), ::testing::Bool()));

// Every 10 to 300 cycles another override, a hold, a retrace, or a reset, which ends the run.
TEST_P(PlannedRelief, limits_hold_under_overrides_holds_retraces_and_resets) {
  const auto [seed, five_axis] = GetParam();
  const auto points = relief(seed, 400, five_axis);
  KnownPath path(points, five_axis);
  Trajectory& t = path.t;
  std::mt19937_64 random(seed + 1000);
  std::vector<Setpoint> setpoints;
  double feed = 1;
  bool hold = false, retrace = false;
  int next = 100;
  const bool resets = seed % 4 == 3;
  for (int k = 0; k < 200000; ++k) {
    if (k == next) {
      next += 10 + static_cast<int>(random() % 290);
      const auto what = random() % 6;
      hold = what == 0;
      if (seed % 4 == 2) retrace = what == 1;
      t.retrace(retrace);
      if (!hold) feed = 0.25 * static_cast<double>(random() % 7);
      if (resets && k > 2000) t.abort();
    }
    if (k > 100000) feed = 1, hold = false, t.retrace(retrace = false);
    setpoints.push_back(t.step(feed, 1, hold));
    if (setpoints.back().at_rest) break;
  }
  EXPECT_TRUE(setpoints.back().at_rest);
  if (!resets) {
    EXPECT_EQ(t.position(), points.back());
  }
  expect_limits(setpoints, points.front(), strong(), path.used);
}

class HeldRelief : public ::testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(seeds, HeldRelief, ::testing::Range<std::uint64_t>(0, 40));

// Without its jerk at the plan's own limits a stop from the programmed 100 mm/s takes 2 sqrt(v / J) = 82 ms
// at J = 60000 mm/s3; it reaches sqrt(v J) = 2449 mm/s2 of 3000. At its limits a plan of least time leaves
// jerk in one direction only. With a quarter of the jerk, the stop takes twice as long: 164 cycles.
TEST_P(HeldRelief, a_hold_stops_as_with_a_quarter_of_the_jerk_at_least) {
  const std::uint64_t seed = GetParam();
  KnownPath path(relief(seed, 400), false);
  Trajectory& t = path.t;
  for (int k = 0; k < 300 + static_cast<int>(17 * seed); ++k) t.step(1, 1, false);
  int cycles = 0;
  AxisValues before{};
  do {
    before = t.position();
    t.step(1, 1, true);
    ++cycles;
  } while (t.position() != before && cycles < 1000);
  EXPECT_LE(cycles, 164);
}

// Holds of 1 to 40 cycles, 1 to 90 cycles apart: most end while the motion still brakes.
TEST_P(PlannedRelief, limits_hold_when_holds_end_before_the_standstill) {
  const auto [seed, five_axis] = GetParam();
  const auto points = relief(seed, 600, five_axis);
  KnownPath path(points, five_axis);
  Trajectory& t = path.t;
  std::mt19937_64 random(seed + 2000);
  std::vector<Setpoint> setpoints;
  bool hold = false;
  while (!t.at_rest() && setpoints.size() < 100000) {
    for (auto left = 1 + random() % (hold ? 40 : 90); left > 0 && !t.at_rest(); --left)
      setpoints.push_back(t.step(1, 1, hold));
    hold = !hold;
  }
  EXPECT_EQ(t.position(), points.back());
  expect_limits(setpoints, points.front(), strong(), path.used);
}

// 5 mm to and fro at F100. At 3000 mm/s2 and 60000 mm/s3 its 1.67 mm/s are reached in 2 sqrt(v / J) = 10.5 ms
// at best, and the plan is made of pieces of 2.7 ms. Every cycle that is farther than 40 from a reversal has
// the programmed speed but for 1e-5 of it.
TEST(PlannedSpeed, a_straight_line_keeps_the_programmed_speed) {
  Trajectory t(strong(), nullptr, cycle);
  t.start({}, Transformation::none, 0);
  for (std::uint32_t k = 1; k <= 6; ++k) ASSERT_TRUE(t.push(line_to({k % 2 == 1 ? 5.0 : 0.0}, 100, k)));
  t.finish();
  std::vector<double> x{0};
  for (int k = 0; k < 100000; ++k) {
    const Setpoint setpoint = t.step(1, 1, false);
    x.push_back(setpoint.position[0]);
    if (setpoint.at_rest) break;
  }
  const double programmed = 100.0 / 60 * cycle;
  std::size_t kept = 0;
  for (std::size_t k = 40; k + 40 < x.size(); ++k) {
    const auto from = x.begin() + static_cast<std::ptrdiff_t>(k) - 40, to = from + 80;
    if (!std::is_sorted(from, to) && !std::is_sorted(from, to, std::greater<>())) continue;
    EXPECT_NEAR(std::abs(x[k] - x[k - 1]), programmed, 1.1e-5 * programmed) << "cycle " << k;
    ++kept;
  }
  // Six lines of 3 s, less the reversals.
  EXPECT_GT(kept, 6 * 2900u);
}

// A program that arrives in pieces runs to the same end within the limits; calls in the same cycles give the
// same bits.
TEST(PlannedSpeed, the_same_calls_give_the_same_bits) {
  const auto points = relief(5, 600);
  const auto program = program_of(points, 6000);
  const auto run_slowly = [&] {
    Trajectory t(strong(), nullptr, cycle);
    t.start(points.front(), Transformation::none, 0);
    std::vector<Setpoint> setpoints;
    for (const Command& command : program) {
      EXPECT_TRUE(t.push(command));
      for (int k = 0; k < 3; ++k) setpoints.push_back(t.step(1, 1, false));
    }
    t.finish();
    while (!t.at_rest()) setpoints.push_back(t.step(1, 1, false));
    return setpoints;
  };
  const auto first = run_slowly(), second = run_slowly();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) ASSERT_EQ(first[k].position, second[k].position) << k;
  EXPECT_EQ(first.back().position, points.back());
  expect_limits(first, points.front(), strong());
}

}  // namespace
}  // namespace trunnion::motion::test
