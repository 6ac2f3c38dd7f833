// SPDX-License-Identifier: Apache-2.0
// Brute force: every setpoint against the whole programmed path and against the limits of every machine axis.
#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <tuple>

#include "motion_fixture.hpp"

namespace trunnion::motion::test {
namespace {

using canonical::Transformation;

constexpr double allowed_ratio = 1.001;

struct Polyline {
  std::vector<AxisValues> points;
  std::vector<Command> program;
  void add(const AxisValues& p, double feed) {
    if (!points.empty()) program.push_back(line_to(p, feed, static_cast<std::uint32_t>(points.size())));
    points.push_back(p);
  }
};

void expect_within(const Motion& run, const AxisValues& start, const Limits& limits,
                   const geometry::Chain* chain, double tool_length) {
  ASSERT_TRUE(run.stopped);
  const Ratios ratios = axis_ratios(run, start, limits, chain, tool_length);
  EXPECT_LE(ratios.velocity, allowed_ratio);
  EXPECT_LE(ratios.acceleration, allowed_ratio);
  EXPECT_LE(ratios.jerk, allowed_ratio);
}

class Zigzag : public testing::TestWithParam<std::tuple<int, double, double>> {};

TEST_P(Zigzag, random_corners_keep_tolerance_velocity_and_acceleration) {
  const auto [cycles, size, tolerance] = GetParam();
  std::mt19937_64 random(static_cast<std::uint64_t>(cycles * 1000 + size * 10));
  std::uniform_real_distribution<double> unit(-1, 1);
  Polyline path;
  path.add({}, 6000);
  for (int i = 1; i < 120; ++i) {
    path.add({i * size * 0.7 + unit(random) * size * 0.3, size * unit(random), size * unit(random)}, 9000);
  }
  Limits limits = uniform_limits(200, 3000, cycles);
  limits.axes[1].velocity = 60;  // a slow and weak axis must rule the others
  limits.axes[2].acceleration = 800;
  limits.contour_tolerance = tolerance;
  Trajectory t(limits, nullptr, cycle);
  const Motion result = run(t, path.program);
  expect_within(result, {}, limits, nullptr, 0);
  EXPECT_LE(contour_error(result, path.points), tolerance);
  EXPECT_EQ(result.setpoints.back().position, path.points.back());
}

INSTANTIATE_TEST_SUITE_P(sizes, Zigzag,
                         testing::Combine(testing::Values(1, 2, 20, 64), testing::Values(0.05, 0.5, 5.0),
                                          testing::Values(0.002, 0.02, 0.5)));

class DenseCircle : public testing::TestWithParam<std::tuple<double, double, int>> {};

TEST_P(DenseCircle,
       line_into_short_segments_keeps_tolerance_and_reaches_most_of_the_speed_the_arc_formula_allows) {
  const auto [radius, chord, cycles] = GetParam();
  const double tolerance = 0.01;
  Polyline path;
  path.add({-20, 0}, 6000);
  path.add({0, 0}, 6000);
  const int n = static_cast<int>(std::min(1500.0, 4 * std::numbers::pi * radius / chord));
  for (int i = 1; i <= n; ++i) {
    path.add({radius * std::sin(i * chord / radius), radius * (1 - std::cos(i * chord / radius))}, 6000);
  }
  Limits limits = uniform_limits(500, 3000, cycles);
  limits.contour_tolerance = tolerance;
  Trajectory t(limits, nullptr, cycle);
  t.start(path.points[0], Transformation::none, 0);
  const Motion result = run(t, path.program);
  expect_within(result, path.points[0], limits, nullptr, 0);
  EXPECT_LE(contour_error(result, path.points), tolerance);
  // Where the chords are short against the window the polyline is an arc: v = sqrt(24 tol r) / T, or the
  // feed, or what half of the acceleration allows. 70 % of it is programmed: the plan keeps margins for
  // tolerance, cycles and corners.
  const double window = cycles * cycle;
  const double formula =
      std::min({100.0, std::sqrt(24 * tolerance * radius) / window, std::sqrt(0.5 * 3000 * radius)});
  if (chord < formula * window / 8) {
    const Setpoint& middle = result.setpoints[result.setpoints.size() * 3 / 4];
    EXPECT_GE(middle.path_speed, 0.7 * formula);
  }
}

INSTANTIATE_TEST_SUITE_P(radii, DenseCircle,
                         testing::Combine(testing::Values(1.0, 10.0, 100.0), testing::Values(0.03, 0.3),
                                          testing::Values(10, 50)));

// The moving average shrinks an arc by (v T)^2 / (24 r): the distance to the programmed circle must stay
// below the tolerance all along, also next to the corners where line and arc meet.
TEST(Contour, programmed_arcs_with_corners_at_their_ends_keep_the_tolerances) {
  for (const double radius : {0.5, 5.0, 50.0}) {
    for (const int cycles : {10, 50}) {
      Limits limits = uniform_limits(500, 3000, cycles);
      limits.arc_tolerance = 0.005;
      limits.contour_tolerance = 0.01;
      Trajectory t(limits, nullptr, cycle);
      t.start({-10, 0}, Transformation::none, 0);
      // Line along +X into the origin, then a half circle that starts at a right angle to -Y and one that is
      // tangent.
      for (const bool corner : {false, true}) {
        t.start({-10, 0}, Transformation::none, 0);
        const double cx = corner ? radius : 0, cy = corner ? 0 : radius;
        const AxisValues end = corner ? AxisValues{2 * radius, 0} : AxisValues{0, 2 * radius};
        const Motion result = run(t, {line_to({0, 0}, 6000), arc_to(end, cx, cy, 180, false, 6000)});
        expect_within(result, {-10, 0}, limits, nullptr, 0);
        for (const Setpoint& s : result.setpoints) {
          const double to_line = std::sqrt(square_to_leg(s.position, {-10, 0}, {0, 0}));
          const double to_circle = std::abs(std::hypot(s.position[0] - cx, s.position[1] - cy) - radius);
          ASSERT_LE(std::min(to_line, to_circle), 0.01 + 1e-9) << radius << " " << cycles << " " << corner;
        }
      }
    }
  }
}

class FiveAxis : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(FiveAxis, wavy_cap_with_rtcp_keeps_the_limits_of_the_machine_axes_and_the_tip_its_tolerance) {
  const auto [cycles, feed] = GetParam();
  const geometry::Chain chain = ac_table();
  Limits limits = uniform_limits(300, 3000, cycles);
  for (std::size_t i = 3; i < 6; ++i) limits.axes[i] = {100, 200, 600};
  Polyline path;
  for (int i = 0; i <= 600; ++i) {
    const double f = i * 2 * std::numbers::pi / 600;
    AxisValues p{30 * std::cos(f) + 5, 30 * std::sin(f) - 4, 2 * std::sin(6 * f)};
    p[canonical::A] = 20 + 15 * std::sin(9 * f);
    p[canonical::C] = 360 * i / 600.0;
    path.add(p, feed);
  }
  Trajectory t(limits, &chain, cycle);
  t.start(path.points[0], Transformation::rtcp, 100);
  const Motion result = run(t, path.program);
  expect_within(result, path.points[0], limits, &chain, 100);
  EXPECT_LE(contour_error(result, path.points), limits.contour_tolerance);
}

INSTANTIATE_TEST_SUITE_P(feeds, FiveAxis,
                         testing::Combine(testing::Values(5, 20, 50),
                                          testing::Values(1000.0, 4000.0, 20000.0)));

// A follows X degree by millimetre up to X10 and then rests: its corner may be rounded by the orientation
// tolerance only.
TEST(Contour, corners_of_a_rotary_axis_keep_the_orientation_tolerance) {
  for (const double tolerance : {0.001, 0.05}) {
    Limits limits = uniform_limits(500, 3000, 40);
    limits.orientation_tolerance = tolerance;
    Trajectory t(limits, nullptr, cycle);
    const Motion result = run(t, {line_to({10, 0, 0, 10}, 6000), line_to({20, 0, 0, 10}, 6000)});
    expect_within(result, {}, limits, nullptr, 0);
    double worst = 0;
    for (const Setpoint& s : result.setpoints) {
      worst = std::max(worst, std::abs(s.position[canonical::A] - std::min(s.position[0], 10.0)));
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GE(worst, 0.2 * tolerance);  // the corner is rounded, not stopped at
  }
}

TEST(Contour, random_five_axis_corners_with_rtcp_keep_the_limits_and_the_tolerance) {
  const geometry::Chain chain = ac_table();
  for (const int cycles : {5, 20, 50}) {
    for (const double size : {0.1, 1.0, 20.0}) {
      std::mt19937_64 random(17);
      std::uniform_real_distribution<double> unit(-1, 1);
      Limits limits = uniform_limits(300, 3000, cycles);
      for (std::size_t i = 3; i < 6; ++i) limits.axes[i] = {100, 200, 600};
      Polyline path;
      for (int i = 0; i < 60; ++i) {
        AxisValues p{i * size * 0.4 + unit(random) * size, unit(random) * size, unit(random) * size};
        p[canonical::A] = unit(random) * 3 * size;
        p[canonical::C] = unit(random) * 5 * size;
        path.add(p, 6000);
      }
      Trajectory t(limits, &chain, cycle);
      t.start(path.points[0], Transformation::rtcp, 80);
      const Motion result = run(t, path.program);
      SCOPED_TRACE(testing::Message() << cycles << " cycles, size " << size);
      expect_within(result, path.points[0], limits, &chain, 80);
      EXPECT_LE(contour_error(result, path.points), limits.contour_tolerance);
    }
  }
}

// Close to the centre of the table little travel is much rotation, and within a window the table turns by
// many degrees: the rates of X and Y change faster than anywhere else.
TEST(Contour, fast_rotation_near_the_centre_of_the_table_with_rtcp_keeps_the_limits) {
  const geometry::Chain chain = ac_table();
  for (const int cycles : {10, 30, 64}) {
    std::mt19937_64 random(23);
    std::uniform_real_distribution<double> unit(-1, 1);
    Limits limits = uniform_limits(150, 2000, cycles);
    for (std::size_t i = 3; i < 6; ++i) limits.axes[i] = {350, 400, 3000};
    Polyline path;
    for (int i = 0; i < 120; ++i) {
      AxisValues p{5 + unit(random), -4 + unit(random), unit(random)};
      p[canonical::A] = 10 * unit(random);
      p[canonical::C] = (i % 30 < 15 ? 20.0 : 5.0) * i;
      path.add(p, 6000);
    }
    Trajectory t(limits, &chain, cycle);
    t.start(path.points[0], Transformation::rtcp, 10);
    const Motion result = run(t, path.program);
    SCOPED_TRACE(cycles);
    expect_within(result, path.points[0], limits, &chain, 10);
    EXPECT_LE(contour_error(result, path.points), limits.contour_tolerance);
  }
}

}  // namespace
}  // namespace trunnion::motion::test
