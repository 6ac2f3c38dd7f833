// SPDX-License-Identifier: Apache-2.0
// Curves in short lines, from the program to the setpoints: size, time, feed, limits and tolerance.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "circle_points.hpp"
#include "motion_fixture.hpp"

namespace trunnion::motion::test {
namespace {

using canonical::Transformation;

struct Dense {
  std::vector<AxisValues> points;
  std::vector<Command> program;
};

Dense through(const std::vector<AxisValues>& points, double feed) {
  Dense dense;
  for (const AxisValues& p : points) {
    if (!dense.points.empty() && dense.points.back() == p) continue;
    if (!dense.points.empty())
      dense.program.push_back(line_to(p, feed, static_cast<std::uint32_t>(dense.points.size())));
    dense.points.push_back(p);
  }
  return dense;
}

Dense dense_circle(double radius, double chord, double grain, double feed) {
  return through(circle_points(radius, chord, grain), feed);
}

Limits strong_limits() {
  Limits limits = uniform_limits(500, 3000, 1);
  for (std::size_t i = canonical::A; i <= canonical::C; ++i) limits.axes[i] = {360, 360, 3000, 60000};
  return limits;
}

void expect_motion_limits(const Motion& result, const AxisValues& start, const Limits& limits,
                          const geometry::Chain* chain = nullptr, double tool_length = 0) {
  ASSERT_TRUE(result.stopped);
  const Ratios ratios = axis_ratios(result, start, limits, chain, tool_length);
  EXPECT_LE(ratios.velocity, 1.001);
  EXPECT_LE(ratios.acceleration, 1.001);
  EXPECT_LE(ratios.jerk, 1.001);
}

// At 25 mm/s every cycle is 0.025 mm: 6283 setpoints on the circle, equally spaced but for the ramps.
TEST(DensePath, a_circle_in_chords_is_true_to_size_at_any_tolerance) {
  for (const double tolerance : {0.01, 0.05}) {
    const Dense dense = dense_circle(25, 0.1, 1e-4, 1500);
    Limits limits = strong_limits();
    limits.contour_tolerance = tolerance;
    Trajectory t(limits, nullptr, cycle);
    t.start(dense.points.front(), Transformation::none, 0);
    const Motion result = run(t, dense.program);
    expect_motion_limits(result, dense.points.front(), limits);
    double sum = 0;
    for (const Setpoint& s : result.setpoints) sum += std::hypot(s.position[0], s.position[1]) - 25;
    const double sagitta = 0.1 * 0.1 / (8 * 25);
    EXPECT_LE(std::abs(sum / static_cast<double>(result.setpoints.size())), 2 * sagitta + 0.0002);
    EXPECT_LE(contour_error(result, dense.points), tolerance);
  }
}

// Chords of 0.016 mm rounded to 0.0025 mm: the rounding alone took 13 s. The same circle as one arc is the
// measure, and 3 tenths more for cells that keep the limits of all axes at once.
TEST(DensePath, rounding_of_coordinates_is_no_jerk) {
  const Dense dense = dense_circle(25.4, 0.016, 0.0025, 12000);
  const Limits limits = strong_limits();
  Trajectory t(limits, nullptr, cycle);
  t.start(dense.points.front(), Transformation::none, 0);
  const Motion chords = run(t, dense.program);
  expect_motion_limits(chords, dense.points.front(), limits);
  EXPECT_LE(contour_error(chords, dense.points), limits.contour_tolerance);
  t.start({25.4}, Transformation::none, 0);
  const Motion arc = run(t, {arc_to({25.4}, 0, 0, 360, false, 12000)});
  EXPECT_LE(static_cast<double>(chords.setpoints.size()), 1.3 * static_cast<double>(arc.setpoints.size()));
}

// Rounding makes the polyline longer than the curve: 0.0025 mm on 0.016 mm by about 1 %.
TEST(DensePath, the_programmed_feed_is_that_of_the_curve) {
  const Dense dense = dense_circle(25, 0.016, 0.0025, 1200);
  Trajectory t(strong_limits(), nullptr, cycle);
  t.start(dense.points.front(), Transformation::none, 0);
  const Motion result = run(t, dense.program);
  std::size_t cruising = 0;
  for (std::size_t k = 200; k + 200 < result.setpoints.size(); ++k) {
    ASSERT_NEAR(result.setpoints[k].feed, 20, 0.02) << k;
    ++cruising;
  }
  EXPECT_GT(cruising, 5000U);
}

// Largest deviation of a setpoint by the tolerances, tip and rotary axes at the same place of the polyline.
// Setpoints and legs run in the same sequence.
double share_of_tolerances(const Motion& run, const Dense& dense, const Limits& limits) {
  double worst = 0;
  for (const Setpoint& s : run.setpoints) {
    double best = 1e9;
    const std::size_t from = std::max<std::size_t>(s.line, 6) - 5;
    for (std::size_t k = from; k < std::min<std::size_t>(s.line + 6U, dense.points.size()); ++k) {
      const AxisValues &a = dense.points[k - 1], &b = dense.points[k];
      for (int n = 0; n <= 200; ++n) {
        const double share = n / 200.0;
        double tip = 0, turn = 0;
        for (std::size_t i = 0; i < canonical::axis_count; ++i) {
          const double off = s.position[i] - a[i] - share * (b[i] - a[i]);
          (canonical::is_rotary(i) ? turn : tip) += off * off;
        }
        best = std::min(best, std::max(std::sqrt(tip) / limits.contour_tolerance,
                                       std::sqrt(turn) / limits.orientation_tolerance));
      }
    }
    worst = std::max(worst, best);
  }
  return worst;
}

std::vector<AxisValues> surface(std::uint64_t seed, bool five_axis) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double grain = std::pow(10, -2 - static_cast<int>(random() % 3)), step = 0.05 + 0.3 * unit(random);
  const double height = 0.3 + 2 * unit(random), waves = 3 + 6 * unit(random);
  std::vector<AxisValues> points;
  for (int k = 0; k < 500; ++k) {
    const double f = step * k / 30;
    AxisValues p{30 * std::cos(f) + 5, 30 * std::sin(f) - 4, height * std::sin(waves * f)};
    if (five_axis) {
      p[canonical::A] = 20 + 15 * std::sin(0.7 * waves * f);
      p[canonical::C] = f * 180 / std::numbers::pi;
    }
    for (double& v : p) v = std::round(v / grain) * grain;
    points.push_back(p);
  }
  return points;
}

TEST(DensePath, limits_and_tolerances_hold_under_overrides_and_holds_with_three_axes_and_through_a_chain) {
  const geometry::Chain chain = ac_table();
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const bool five_axis = seed % 2 == 1;
    const Dense dense = through(surface(seed, five_axis), 6000);
    const Limits limits = strong_limits();
    const geometry::Chain* used = five_axis ? &chain : nullptr;
    Trajectory t(limits, used, cycle);
    t.start(dense.points.front(), five_axis ? Transformation::rtcp : Transformation::none, 100);
    std::mt19937_64 changes(seed);
    double value = 1;
    const Motion result = run(t, dense.program, 400000, [&](std::size_t) {
      if (changes() % 60 == 0) value = 1.5 * static_cast<double>(changes() % 5) / 4;
      return value;
    });
    expect_motion_limits(result, dense.points.front(), limits, used, 100);
    EXPECT_EQ(t.position(), dense.points.back());
    EXPECT_LE(contour_error(result, dense.points), limits.contour_tolerance);
    // 200 places of a leg of up to 0.35 mm are 0.9 um or less beside the nearest: a tenth of the tolerance.
    if (five_axis && seed < 4) {
      EXPECT_LE(share_of_tolerances(result, dense, limits), 1.1);
    }
  }
}

TEST(DensePath, going_back_and_forward_again_stays_on_the_same_curve_within_the_limits) {
  const Dense dense = through(surface(4, false), 6000);
  const Limits limits = strong_limits();
  Trajectory t(limits, nullptr, cycle);
  t.start(dense.points.front(), Transformation::none, 0);
  for (const Command& command : dense.program) ASSERT_TRUE(t.push(command));
  t.finish();
  Motion result;
  for (int k = 0; k < 100000; ++k) {
    if (k == 400) t.retrace(true);
    if (k == 700) t.retrace(false);
    result.setpoints.push_back(t.step(1, 1, false));
    if (result.setpoints.back().at_rest) break;
  }
  result.stopped = result.setpoints.back().at_rest;
  expect_motion_limits(result, dense.points.front(), limits);
  EXPECT_LE(contour_error(result, dense.points), limits.contour_tolerance);
  EXPECT_EQ(t.position(), dense.points.back());
}

// The curve depends on the sequence of the blocks alone: every setpoint of a program that arrives slowly lies
// on the curve of the same program that was known at once.
TEST(DensePath, the_curve_does_not_depend_on_when_its_blocks_arrive) {
  const Dense dense = through(surface(6, false), 1500);
  Trajectory at_once(strong_limits(), nullptr, cycle), slowly(strong_limits(), nullptr, cycle);
  at_once.start(dense.points.front(), Transformation::none, 0);
  slowly.start(dense.points.front(), Transformation::none, 0);
  const Motion whole = run(at_once, dense.program);
  Motion pieces;
  for (const Command& command : dense.program) {
    ASSERT_TRUE(slowly.push(command));
    for (int k = 0; k < 7; ++k) pieces.setpoints.push_back(slowly.step(1, 1, false));
  }
  slowly.finish();
  while (!slowly.at_rest()) pieces.setpoints.push_back(slowly.step(1, 1, false));
  std::vector<AxisValues> curve;
  for (const Setpoint& s : whole.setpoints) curve.push_back(s.position);
  // Between setpoints 0.025 mm apart on a radius of 0.1 mm or more a chord strays by 0.8 um.
  EXPECT_LE(contour_error(pieces, curve), 0.0008);
}

}  // namespace
}  // namespace trunnion::motion::test
