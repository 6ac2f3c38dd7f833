// SPDX-License-Identifier: Apache-2.0
#include "motion/path_segment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trunnion::motion {
namespace {

using canonical::Arc;
using canonical::Plane;

TEST(PathSegment, line_runs_all_axes_in_proportion_and_ends_on_the_target_bit_for_bit) {
  const AxisValues target{0.1, 0.2, 0.2, 30, 0, -60, 0, 0, 9};
  const PathSegment line = PathSegment::line({}, target);
  EXPECT_DOUBLE_EQ(line.length(), 0.3);  // sqrt(0.01 + 0.04 + 0.04): rotary and further axes add no length
  EXPECT_EQ(line.position(line.length()), target);
  EXPECT_NEAR(line.position(0.15)[canonical::C], -30, 1e-12);
  EXPECT_NEAR(line.derivative(0)[canonical::A], 100, 1e-9);
}

TEST(PathSegment, length_of_a_purely_rotary_move_is_degrees_and_of_u_v_w_alone_millimetres) {
  const PathSegment rotary = PathSegment::line({}, {0, 0, 0, 3, 0, 4});
  EXPECT_EQ(rotary.unit(), LengthUnit::degree);
  EXPECT_DOUBLE_EQ(rotary.length(), 5);
  const PathSegment quill = PathSegment::line({}, {0, 0, 0, 0, 0, 0, 0, 0, 7});
  EXPECT_EQ(quill.unit(), LengthUnit::millimetre);
  EXPECT_DOUBLE_EQ(quill.length(), 7);
}

// Radius 10 from (10, 0) counterclockwise by 90 degrees about the origin: half way is (10/sqrt 2, 10/sqrt 2),
// the length 5 pi; with 12 mm along Z the helix is hypot(5 pi, 12).
TEST(PathSegment, arc_and_helix_in_the_xy_plane) {
  const PathSegment arc = PathSegment::arc({10, 0, 0}, {0, 10, 0}, {Plane::xy, false, {0, 0, 0}, 90});
  EXPECT_NEAR(arc.length(), 5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(arc.position(arc.length() / 2)[0], 10 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(arc.position(arc.length() / 2)[1], 10 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(arc.curvature(), 0.1, 1e-12);
  EXPECT_EQ(arc.position(arc.length()), (AxisValues{0, 10, 0}));
  const PathSegment helix = PathSegment::arc({10, 0, 0}, {0, 10, 12}, {Plane::xy, false, {0, 0, 0}, 90});
  EXPECT_NEAR(helix.length(), std::hypot(5 * std::numbers::pi, 12), 1e-12);
  EXPECT_NEAR(helix.position(helix.length() / 2)[2], 6, 1e-12);
}

// G18 is the Z-X plane: counterclockwise seen from +Y runs from +Z to +X. G19 is Y-Z: from +Y to +Z.
TEST(PathSegment, planes_turn_as_iso_6983_says) {
  const PathSegment zx = PathSegment::arc({0, 0, 5}, {5, 0, 0}, {Plane::zx, false, {0, 0, 0}, 90});
  EXPECT_GT(zx.position(zx.length() / 2)[0], 3);
  EXPECT_GT(zx.position(zx.length() / 2)[2], 3);
  const PathSegment yz = PathSegment::arc({0, 5, 0}, {0, 0, 5}, {Plane::yz, false, {0, 0, 0}, 90});
  EXPECT_GT(yz.position(yz.length() / 2)[1], 3);
  EXPECT_GT(yz.position(yz.length() / 2)[2], 3);
  const PathSegment clockwise = PathSegment::arc({10, 0}, {0, 10}, {Plane::xy, true, {0, 0, 0}, 270});
  EXPECT_LT(clockwise.position(clockwise.length() / 2)[0], 0);  // passes the lower left at -135 degrees
}

// A plane given by its normal is the plane: with +Y, G18 itself; and a circle about (1, 0, 1) through (0, 10,
// 0) turns counterclockwise to the point at right angles to both, (-10 / sqrt 2, 0, 10 / sqrt 2).
TEST(PathSegment, tilted_arcs_turn_about_their_normal) {
  Arc zx{Plane::zx, false, {0, 0, 0}, 90};
  const PathSegment plain = PathSegment::arc({0, 0, 5}, {5, 2, 0}, zx);
  zx.normal = {0, 1, 0};
  const PathSegment same = PathSegment::arc({0, 0, 5}, {5, 2, 0}, zx);
  EXPECT_NEAR(same.length(), plain.length(), 1e-12);
  EXPECT_NEAR(same.curvature(), plain.curvature(), 1e-12);
  for (int k = 0; k <= 10; ++k) {
    const double s = plain.length() * k / 10;
    for (std::size_t i = 0; i < canonical::axis_count; ++i) {
      EXPECT_NEAR(same.position(s)[i], plain.position(s)[i], 1e-12);
      EXPECT_NEAR(same.derivative(s)[i], plain.derivative(s)[i], 1e-12);
    }
  }
  const double half = 1 / std::sqrt(2);
  Arc arc{Plane::xy, false, {0, 0, 0}, 90, {half, 0, half}};
  const PathSegment tilted = PathSegment::arc({0, 10, 0}, {-10 * half, 0, 10 * half}, arc);
  EXPECT_NEAR(tilted.length(), 5 * std::numbers::pi, 1e-12);
  const AxisValues middle = tilted.position(tilted.length() / 2);
  EXPECT_NEAR(middle[0], -10 * half * half, 1e-12);
  EXPECT_NEAR(middle[1], 10 * half, 1e-12);
  EXPECT_NEAR(middle[2], 10 * half * half, 1e-12);
}

TEST(PathSegment, several_turns_stay_on_the_radius) {
  const PathSegment arc =
      PathSegment::arc({10, 0, 0}, {0, 10, 3}, {Plane::xy, false, {0, 0, 0}, 360 * 3 + 90});
  for (int k = 0; k <= 100; ++k) {
    const AxisValues p = arc.position(arc.length() * k / 100);
    EXPECT_NEAR(std::hypot(p[0], p[1]), 10, 1e-9);
  }
}

// Start at radius 10, target at radius 10.05: the radius runs between, and the target is met.
TEST(PathSegment, arc_whose_radii_differ_spirals_to_its_target_without_a_jump) {
  const AxisValues target{0, 10.05, 0};
  const PathSegment arc = PathSegment::arc({10, 0, 0}, target, {Plane::xy, false, {0, 0, 0}, 90});
  const AxisValues almost = arc.position(arc.length() * (1 - 1e-12));
  EXPECT_NEAR(almost[0], target[0], 1e-9);
  EXPECT_NEAR(almost[1], target[1], 1e-9);
}

// h = 1e-5 of the length: truncation L h^2 / (6 r^2), below 1e-9; rounding 1e-13 / 1e-5 = 1e-8 for positions
// of 1000.
TEST(PathSegment, derivative_agrees_with_differences_of_positions) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> position(-100, 100), sweep(1, 700);
  for (int i = 0; i < 2000; ++i) {
    AxisValues start{}, target{};
    for (double& v : start) v = position(random);
    for (double& v : target) v = position(random);
    const Arc arc{static_cast<Plane>(i % 3),
                  i % 2 == 0,
                  {position(random), position(random), position(random)},
                  sweep(random)};
    for (const PathSegment& s : {PathSegment::line(start, target), PathSegment::arc(start, target, arc)}) {
      const double h = 1e-5 * s.length();
      const double at = s.length() * 0.37;
      const AxisValues up = s.position(at + h), down = s.position(at - h), d = s.derivative(at);
      for (std::size_t k = 0; k < d.size(); ++k)
        ASSERT_NEAR((up[k] - down[k]) / (2 * h), d[k], 1e-6 * (1 + std::abs(d[k])));
    }
  }
}

TEST(PathSegment, arc_around_its_own_start_falls_back_to_a_line) {
  const PathSegment arc = PathSegment::arc({1, 2}, {4, 6}, {Plane::xy, false, {1, 2, 0}, 90});
  EXPECT_DOUBLE_EQ(arc.length(), 5);
  EXPECT_EQ(arc.curvature(), 0);
}

TEST(RemainingSweep, IsTheAngleToTheTargetWhateverTheFractionSaysButForWholeTurns) {
  canonical::Arc arc;
  arc.sweep = 270 + 720;
  arc.clockwise = true;
  // Clockwise about the origin from 0 deg, two turns and 270 deg to 90 deg. At -45 deg of the second turn 405
  // of 990 deg are done and 585 are left; a fraction that is 3 % off names the same turn.
  const AxisValues target{0, 10}, at{10 * std::sqrt(0.5), -10 * std::sqrt(0.5)};
  for (const double error : {-0.03, 0.0, 0.03})
    EXPECT_NEAR(remaining_sweep(at, target, arc, 405.0 / 990 + error), 585, 1e-9) << error;
  // The same helix on its way, in a plane that is named by its normal.
  arc.normal = {0, 0, 1};
  AxisValues higher = at;
  higher[2] = 7;
  EXPECT_NEAR(remaining_sweep(higher, target, arc, 405.0 / 990), 585, 1e-9);
  arc.normal = {};
  // Past the target by a tenth of a degree.
  const AxisValues past{10 * std::sin(0.1 * std::numbers::pi / 180),
                        10 * std::cos(0.1 * std::numbers::pi / 180)};
  EXPECT_NEAR(remaining_sweep(past, target, arc, 1), -0.1, 1e-9);
}

}  // namespace
}  // namespace trunnion::motion
