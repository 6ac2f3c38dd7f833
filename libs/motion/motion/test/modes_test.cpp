// SPDX-License-Identifier: Apache-2.0
// Machining modes (G5.1) and the tolerance of G64 P: each acts on the blocks that are programmed with it.
#include <gtest/gtest.h>

#include <random>

#include "motion_fixture.hpp"

namespace trunnion::motion::test {
namespace {

// Three modes that differ in everything.
Limits three_modes() {
  Limits limits = uniform_limits(200, 3000, 1);
  limits.contour_tolerance = 0.02;
  limits.modes = {PathMode{35, 0.005, 0.02, 80, 2500}, PathMode{10, 0.1, 0.05, 120, 1000}};
  return limits;
}

std::vector<Command> in_mode(std::vector<Command> program, std::uint8_t mode, double tolerance = 0) {
  for (Command& c : program) c.modal.smoothing = mode, c.modal.path_tolerance = tolerance;
  return program;
}

// Turns of 20 to 70 degrees, which none of the smooth corner angles stops at, a millimetre apart.
struct Bends {
  std::vector<AxisValues> points{{}};
  std::vector<Command> program;
  Bends() {
    std::mt19937_64 random(4);
    double direction = 0;
    for (int k = 1; k <= 60; ++k) {
      direction += (k % 2 == 0 ? 1 : -1) * (0.35 + 0.87 * static_cast<double>(random() % 1000) / 1000);
      points.push_back({points.back()[0] + std::cos(direction), points.back()[1] + std::sin(direction)});
      program.push_back(line_to(points.back(), 6000, static_cast<std::uint32_t>(k)));
    }
  }
};

// Bends that may be rounded are: the tolerance is used up to 98 %, of which the search for the reach may
// leave a quarter.
TEST(Modes, each_keeps_its_own_contour_tolerance_and_uses_it) {
  const Bends bends;
  Trajectory t(three_modes(), nullptr, cycle);
  for (const auto& [mode, own, tolerance] : {std::tuple(0, 0.0, 0.02),
                                             {1, 0.0, 0.005},
                                             {2, 0.0, 0.1},
                                             {0, 0.05, 0.05},
                                             {1, 0.05, 0.05},
                                             {2, 0.003, 0.003}}) {
    t.start({}, canonical::Transformation::none, 0);
    const Motion result = run(t, in_mode(bends.program, static_cast<std::uint8_t>(mode), own));
    ASSERT_TRUE(result.stopped);
    const double error = contour_error(result, bends.points);
    EXPECT_LE(error, tolerance) << "Q" << mode << " P" << own;
    EXPECT_GE(error, 0.6 * tolerance) << "Q" << mode << " P" << own;
  }
}

// Acceleration 3000 in 35 cycles of 1 ms: 85,700 mm/s3 would be above the axis' 60,000; with 1000 mm/s2 it is
// 28,571, and what Q0 with its one cycle uses is the axis' own.
TEST(Modes, smoothing_cycles_of_a_mode_bound_its_jerk) {
  Limits limits = three_modes();
  limits.axes[0].acceleration = 1000;
  Trajectory t(limits, nullptr, cycle);
  const auto jerk = [&](std::uint8_t mode) {
    t.start({}, canonical::Transformation::none, 0);
    double x1 = 0, x2 = 0, x3 = 0, worst = 0;
    for (const Setpoint& s : run(t, in_mode({line_to({50}, 9000)}, mode)).setpoints) {
      worst = std::max(worst, std::abs(s.position[0] - 3 * x1 + 3 * x2 - x3) / (cycle * cycle * cycle));
      x3 = x2, x2 = x1, x1 = s.position[0];
    }
    return worst;
  };
  EXPECT_NEAR(jerk(0), 60000, 60);
  EXPECT_NEAR(jerk(1), 1000 / 0.035, 30);
  EXPECT_NEAR(jerk(2), 60000, 60);  // 1000 / 0.01 is more than the axis permits
}

// At 90 degrees Q1 stops (80); Q2 (120) and Q0 (180) go round, at 10 mm/s, which a rounding by 0.1 mm
// permits: 6 tolerances / sqrt 2 of reach at 60,000 mm/s3 allow 18.6 mm/s.
TEST(Modes, smooth_corner_angle_of_a_mode_decides_where_motion_stops) {
  Limits limits = three_modes();
  limits.modes[0].contour_tolerance = 0.1;
  limits.contour_tolerance = 0.1;
  Trajectory t(limits, nullptr, cycle);
  const auto slowest_on_the_way = [&](std::uint8_t mode) {
    t.start({}, canonical::Transformation::none, 0);
    double slowest = 1e9;
    for (const Setpoint& s :
         run(t, in_mode({line_to({10}, 600, 1), line_to({10, 10}, 600, 2)}, mode)).setpoints)
      if (s.position[0] > 5 && s.position[1] < 5) slowest = std::min(slowest, s.path_speed);
    return slowest;
  };
  EXPECT_GT(slowest_on_the_way(0), 9);
  EXPECT_EQ(slowest_on_the_way(1), 0);
  EXPECT_GT(slowest_on_the_way(2), 9);
}

// A circle of R 10 mm: sqrt(2500 * 10) = 158.1 and sqrt(1000 * 10) = 100 mm/s, where the axes alone, with
// 3000 mm/s2, allow 173.
TEST(Modes, centripetal_acceleration_of_a_mode_bounds_the_speed_in_curves) {
  Trajectory t(three_modes(), nullptr, cycle);
  const auto fastest = [&](std::uint8_t mode) {
    t.start({10}, canonical::Transformation::none, 0);
    double speed = 0;
    for (const Setpoint& s : run(t, in_mode({arc_to({10}, 0, 0, 1440, false, 12000)}, mode)).setpoints)
      speed = std::max(speed, s.path_speed);
    return speed;
  };
  EXPECT_GT(fastest(0), 165);
  EXPECT_LE(fastest(1), 158.12);
  EXPECT_GT(fastest(1), 155);
  EXPECT_LE(fastest(2), 100.001);
  EXPECT_GT(fastest(2), 99);
}

TEST(Modes, another_mode_or_tolerance_begins_at_a_standstill_on_the_end_of_the_block_before) {
  const AxisValues corner{10.1, 0.3};
  for (const bool mode : {true, false}) {
    std::vector<Command> program{line_to(corner, 6000, 1), line_to({20, 8}, 6000, 2)};
    (mode ? program[1].modal.smoothing = 2 : program[1].modal.path_tolerance = 0.5);
    const Limits limits = three_modes();
    Trajectory t(limits, nullptr, cycle);
    const Motion result = run(t, program);
    ASSERT_TRUE(result.stopped);
    EXPECT_TRUE(std::any_of(result.setpoints.begin(), result.setpoints.end(),
                            [&](const Setpoint& s) { return s.position == corner && s.path_speed == 0; }));
    EXPECT_LE(contour_error(result, {{}, corner, {20, 8}}), 1e-12);
  }
}

// Modes change every few blocks; there and back over all of them.
TEST(Modes, changing_them_keeps_the_limits_also_backwards) {
  const Bends bends;
  const Limits limits = three_modes();
  Trajectory t(limits, nullptr, cycle);
  for (std::size_t k = 0; k < bends.program.size(); ++k) {
    Command c = bends.program[k];
    c.modal.smoothing = static_cast<std::uint8_t>(k / 7 % 3);
    c.modal.path_tolerance = k / 5 % 2 == 0 ? 0 : 0.03;
    ASSERT_TRUE(t.push(c));
  }
  t.finish();
  Motion all;
  while (all.setpoints.size() < 1000) all.setpoints.push_back(t.step(1, 1, false));
  t.retrace(true);
  while (!t.retraced_to_start() && all.setpoints.size() < 20000) all.setpoints.push_back(t.step(1, 1, false));
  ASSERT_TRUE(t.retraced_to_start());
  EXPECT_EQ(t.position(), AxisValues{});
  t.retrace(false);
  do all.setpoints.push_back(t.step(1, 1, false));
  while (!all.setpoints.back().at_rest && all.setpoints.size() < 40000);
  EXPECT_EQ(t.position(), bends.points.back());
  const Ratios ratios = axis_ratios(all, {}, limits, nullptr, 0);
  EXPECT_LE(ratios.velocity, 1.001);
  EXPECT_LE(ratios.acceleration, 1.001);
  EXPECT_LE(ratios.jerk, 1.001);
  EXPECT_LE(contour_error(all, bends.points), 0.1);
}

TEST(Modes, an_unknown_mode_or_tolerance_is_refused) {
  Trajectory t(three_modes(), nullptr, cycle);
  Command c = line_to({10}, 6000);
  c.modal.smoothing = 3;
  EXPECT_FALSE(t.push(c));
  c.modal.smoothing = 0;
  c.modal.path_tolerance = std::nan("");
  EXPECT_FALSE(t.push(c));
  EXPECT_TRUE(t.at_rest());
}

}  // namespace
}  // namespace trunnion::motion::test
