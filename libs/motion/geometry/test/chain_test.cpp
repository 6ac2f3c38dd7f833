// SPDX-License-Identifier: Apache-2.0
#include "geometry/chain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "machines.hpp"

namespace trunnion::geometry {
namespace {

// A turns about -X, so A90 turns about +X by -90: (x, y, z) -> (x, z, -y). With both offsets zero the point
// (1, 2, 3) goes to (1, 3, -2), and the tool of 100 is above it at z = 98.
TEST(Chain, ac_trunnion_at_a90_turns_a_point_of_the_table_by_hand) {
  ChainParameters p;
  p.table_1 = RotaryAxis{Vec3(-1, 0, 0), Vec3::Zero(), 0};
  p.table_2 = RotaryAxis{Vec3(0, 0, -1), Vec3::Zero(), 2};
  EXPECT_EQ(make(p).machine_from_tip(Vec3(1, 2, 3), {90, 0, 0}, 100), Vec3(1, 3, 98));
}

// v1 = (0, 4, 0), v2 = (10, 20, 30), w = (11, 22, 33): w - v2 = (1, 2, 3). C90 about -Z: (x, y) -> (y, -x):
// (2, -1, 3). minus v1: (2, -5, 3). A90: (x, z, -y): (2, 3, 5). plus v1 + v2: (12, 27, 35). plus the tool of
// 50: z = 85.
TEST(Chain, ac_trunnion_with_offsets_at_a90_c90_by_hand) {
  ChainParameters p;
  p.table_1 = RotaryAxis{Vec3(-1, 0, 0), Vec3(0, 4, 0), 0};
  p.table_2 = RotaryAxis{Vec3(0, 0, -1), Vec3(10, 20, 30), 2};
  const Vec3 x = make(p).machine_from_tip(Vec3(11, 22, 33), {90, 0, 90}, 50);
  EXPECT_LT((x - Vec3(12, 27, 85)).norm(), 1e-12);
}

// v1 = (1, 0, 0), v2 = (0, 0, 200), L = 100. B90 about +Y: (0, 0, 300) -> (300, 0, 0); plus v1: (301, 0, 0);
// C90 about +Z: (0, 301, 0). X = w - (v1 + v2) + that = (-1, 301, -200) for w = 0.
TEST(Chain, cb_head_at_b90_c90_by_hand) {
  ChainParameters p;
  p.head_1 = RotaryAxis{Vec3(0, 0, 1), Vec3(1, 0, 0), 2};
  p.head_2 = RotaryAxis{Vec3(0, 1, 0), Vec3(0, 0, 200), 1};
  const Vec3 x = make(p).machine_from_tip(Vec3::Zero(), {0, 90, 90}, 100);
  EXPECT_LT((x - Vec3(-1, 301, -200)).norm(), 1e-12);
}

// Table C180 about -Z around (10, 20): w = (0, 0, 0) -> (20, 40, 0). Head B-90: (0, 0, 180 + 20) -> (-200, 0,
// 0); X = (20, 40, 0) - (0, 0, 180) + (-200, 0, 0).
TEST(Chain, b_head_with_c_table_by_hand) {
  ChainParameters p = b_head_c_table();
  p.head_2->offset = Vec3(0, 0, 180);
  const Vec3 x = make(p).machine_from_tip(Vec3::Zero(), {0, -90, 180}, 20);
  EXPECT_LT((x - Vec3(-180, 40, -180)).norm(), 1e-12);
}

// A turns the table about -X, so for the workpiece the tool turns about +X: at A30 it leans to (0, -sin 30,
// cos 30). A B head at B30 leans to (sin 30, 0, cos 30) whatever the offsets.
TEST(Chain, tool_direction_as_the_workpiece_sees_it) {
  EXPECT_LT((make(a_table()).tool_direction_in_workpiece({30, 0, 0}) - Vec3(0, -0.5, std::sqrt(0.75))).norm(),
            1e-15);
  EXPECT_LT((make(cb_head()).tool_direction_in_workpiece({0, 30, 0}) - Vec3(0.5, 0, std::sqrt(0.75))).norm(),
            1e-15);
}

TEST(Chain, at_zero_angles_the_machine_stands_one_tool_length_above_the_tip) {
  for (const Machine& m : machines()) {
    const ChainParameters& p = m.parameters;
    const Vec3 x = make(p).machine_from_tip(Vec3(7, -8, 9), {}, 123);
    const Vec3 expected = Vec3(7, -8, 9) + 123 * p.tool_direction.normalized() - p.origin;
    EXPECT_LT((p.linear_direction * x - expected).norm(), 1e-12) << m.name;
  }
}

TEST(Chain, a_machine_without_rotary_axes_only_adds_the_tool) {
  const Chain chain = make(ChainParameters{});
  EXPECT_EQ(chain.machine_from_tip(Vec3(1, 2, 3), {10, 20, 30}, 5), Vec3(1, 2, 8));
  EXPECT_FALSE(chain.turns(0));
}

TEST(Chain, inverse_returns_the_tip_within_1e_10_mm_over_random_poses) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> position(-1000, 1000), angle(-720, 720), length(0, 400);
  for (const Machine& m : machines()) {
    const Chain chain = make(m.parameters);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 w(position(random), position(random), position(random));
      const Angles a{angle(random), angle(random), angle(random),
                     angle(random), angle(random), angle(random)};
      const double l = length(random);
      ASSERT_LT((chain.tip_from_machine(chain.machine_from_tip(w, a, l), a, l) - w).norm(), 1e-10) << m.name;
    }
  }
}

// Two tips on the same pose keep their distance, and lengthening the tool moves the machine along the tool
// direction turned with the table: properties that hold for any rigid chain, independent of the formulae.
TEST(Chain, moves_are_rigid_and_the_tool_acts_along_its_direction) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> position(-500, 500), angle(-180, 180);
  for (const Machine& m : machines()) {
    const Chain chain = make(m.parameters);
    for (int i = 0; i < 5000; ++i) {
      const Vec3 w1(position(random), position(random), position(random));
      const Vec3 w2(position(random), position(random), position(random));
      const Angles a{angle(random), angle(random), angle(random),
                     angle(random), angle(random), angle(random)};
      const Vec3 x1 = chain.machine_from_tip(w1, a, 100);
      const Vec3 x2 = chain.machine_from_tip(w2, a, 100);
      ASSERT_NEAR((m.parameters.linear_direction * (x1 - x2)).norm(), (w1 - w2).norm(), 1e-9) << m.name;
      const Vec3 along = chain.tip_from_machine(x1, a, 90);
      ASSERT_LT((along - (w1 + 10 * chain.tool_direction_in_workpiece(a))).norm(), 1e-9) << m.name;
    }
  }
}

// Central differences with a step h = 1e-3 (degrees or mm): the truncation is below R h^2 (pi/180)^3 / 6 ~
// 1e-9 mm/deg and rounding about 1e-13 / 1e-3 = 1e-10, both below the tolerance.
TEST(Chain, jacobian_agrees_with_central_differences) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> position(-500, 500), angle(-180, 180);
  const double h = 1e-3;
  for (const Machine& m : machines()) {
    const Chain chain = make(m.parameters);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 w(position(random), position(random), position(random));
      const Angles a{angle(random), angle(random), angle(random),
                     angle(random), angle(random), angle(random)};
      const Jacobian j = chain.jacobian(w, a, 150);
      for (int k = 0; k < 6; ++k) {
        Angles up = a, down = a;
        up[static_cast<std::size_t>(k)] += h;
        down[static_cast<std::size_t>(k)] -= h;
        const Vec3 by_angle =
            (chain.machine_from_tip(w, up, 150) - chain.machine_from_tip(w, down, 150)) / (2 * h);
        const Vec3 column = k < 3 ? j.angle.col(k) : j.further_angle.col(k - 3);
        ASSERT_LT((by_angle - column).norm(), 1e-8) << m.name << " angle " << k;
        if (k > 2) continue;
        const Vec3 step = h * Vec3::Unit(k);
        const Vec3 by_tip =
            (chain.machine_from_tip(w + step, a, 150) - chain.machine_from_tip(w - step, a, 150)) / (2 * h);
        ASSERT_LT((by_tip - j.tip.col(k)).norm(), 1e-8) << m.name << " tip " << k;
      }
    }
  }
}

// v2 = (0.3, 0, 180), L = 20: B60 turns (0.3, 0, 200) into (0.3 c + 200 s, 0, -0.3 s + 200 c), s = sin 60, c
// = cos 60. The rest of the way from w to the spindle, w - v2 + that, is made by X along (1, 0, 0), Y and Z
// along (s, 0, c): the third component gives Z, the first X.
TEST(Chain, a_quill_in_a_b_head_by_hand) {
  const Chain chain = make(quill_in_a_b_head());
  const double s = std::sqrt(0.75), c = 0.5;
  const double z = (3 - 180 - 0.3 * s + 200 * c) / c;
  const double x = 1 - 0.3 + 0.3 * c + 200 * s - z * s;
  EXPECT_LT((chain.machine_from_tip(Vec3(1, 2, 3), {0, 60, 0}, 20) - Vec3(x, 2, z)).norm(), 1e-11);
}

TEST(Chain, where_x_y_and_z_lie_in_one_plane_the_position_is_beyond_every_travel) {
  const Chain chain = make(quill_in_a_b_head());
  const Vec3 nowhere = Vec3::Constant(Chain::no_position);
  for (const double b : {90.0, 90.0 + 1e-13, 89.5, -90.0, 450.0})
    EXPECT_EQ(chain.machine_from_tip(Vec3(1, 2, 3), {0, b, 10}, 20), nowhere) << b;
  TipMotion motion;
  motion.angles[0][1] = 90;
  motion.angles[1][1] = 10;
  EXPECT_EQ(chain.machine_derivatives(motion, 20)[0], nowhere);
  EXPECT_EQ(chain.machine_derivatives(motion, 20)[1], Vec3::Zero());
  EXPECT_LT(chain.machine_from_tip(Vec3(1, 2, 3), {0, 89, 10}, 20).norm(), 1e5);
}

// X goes with 1 / cos B. Its third derivative at B60 is about 700 mm * 2 / cos^2 B (3 / cos^2 B - 2) = 56
// m/rad^3; h^2 (pi/180)^3 / 6 of it, 5e-8 mm/deg, is what central differences miss, and a few times that
// where the other axes lean, too.
TEST(Chain, carried_linear_axes_come_back_and_have_the_derivatives_of_central_differences) {
  ChainParameters p = cb_head();
  p.table_2 = RotaryAxis{Vec3(-1, 0, 0.1), Vec3(0, 5, -300), 0};
  p.linear_direction << 1, 0.1, 0, 0, 1, 0, 0.2, 0, 1;
  p.linear_carriers = {1, -1, 2};
  const Chain chain = make(p);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> position(-500, 500), angle(-60, 60), turn(-25, 25);
  const double h = 1e-3;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 w(position(random), position(random), position(random));
    const Angles a{turn(random), angle(random), turn(random)};
    const Vec3 x = chain.machine_from_tip(w, a, 150);
    ASSERT_LT((chain.tip_from_machine(x, a, 150) - w).norm(), 1e-10);
    const Jacobian j = chain.jacobian(w, a, 150);
    for (int k = 0; k < 3; ++k) {
      Angles up = a, down = a;
      up[static_cast<std::size_t>(k)] += h;
      down[static_cast<std::size_t>(k)] -= h;
      const Vec3 by_angle =
          (chain.machine_from_tip(w, up, 150) - chain.machine_from_tip(w, down, 150)) / (2 * h);
      ASSERT_LT((by_angle - j.angle.col(k)).norm(), 1e-6) << k;
      const Vec3 step = h * Vec3::Unit(k);
      const Vec3 by_tip =
          (chain.machine_from_tip(w + step, a, 150) - chain.machine_from_tip(w - step, a, 150)) / (2 * h);
      ASSERT_LT((by_tip - j.tip.col(k)).norm(), 1e-8) << k;
    }
  }
}

TEST(Chain, quarter_turns_are_exact_even_after_many_revolutions) {
  ChainParameters p;
  p.table_2 = RotaryAxis{Vec3(0, 0, 1), Vec3::Zero(), 2};
  EXPECT_EQ(make(p).machine_from_tip(Vec3(1, 2, 3), {0, 0, 360.0 * 1000 + 90}, 0), Vec3(-2, 1, 3));
}

TEST(Chain, direction_vectors_are_normalized) {
  ChainParameters p = ac_table();
  p.table_2->direction = Vec3(0, 0, -1.000007);
  p.tool_direction = Vec3(0, 0, 2);
  const Angles a{20, 0, 70};
  EXPECT_LT(
      (make(p).machine_from_tip(Vec3(1, 2, 3), a, 9) - make(ac_table()).machine_from_tip(Vec3(1, 2, 3), a, 9))
          .norm(),
      1e-12);
}

TEST(Chain, refuses_parameters_that_describe_no_machine) {
  const auto error = [](const ChainParameters& p) { return std::get<ChainError>(Chain::make(p)); };
  ChainParameters p = ac_table();
  p.table_1->direction = Vec3::Zero();
  EXPECT_EQ(error(p), ChainError::zero_direction);
  p = ac_table();
  p.tool_direction = Vec3::Zero();
  EXPECT_EQ(error(p), ChainError::zero_direction);
  p = ac_table();
  p.table_2->offset.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error(p), ChainError::not_finite);
  p = cb_head();
  p.head_1->direction.x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error(p), ChainError::not_finite);
  p = cb_head();
  p.head_1->angle = 6;
  EXPECT_EQ(error(p), ChainError::bad_angle);
  p = cb_head();
  p.head_1->angle = p.head_2->angle;
  EXPECT_EQ(error(p), ChainError::shared_angle);
  p = cb_head();
  p.head_1->direction = Vec3(0, -1, 0.009);
  EXPECT_EQ(error(p), ChainError::parallel_axes);
  p = cb_head();
  p.linear_direction.col(2) = Vec3(1, 1, 0);
  EXPECT_EQ(error(p), ChainError::dependent_linear);
  p = cb_head();
  p.linear_direction.col(1).setZero();
  EXPECT_EQ(error(p), ChainError::zero_direction);
  p = cb_head();
  p.origin.x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error(p), ChainError::not_finite);
  p = cb_head();
  p.linear_carriers = {0, 3, 0};
  EXPECT_EQ(error(p), ChainError::bad_carrier);
  p.linear_carriers = {0, -1, 0};
  EXPECT_EQ(error(p), ChainError::bad_carrier);
}

TEST(Chain, a_redundant_axis_may_be_parallel_to_another) {
  ChainParameters p = b_head_c_table();
  p.head_1 = RotaryAxis{Vec3(0, 0, 1), Vec3::Zero(), 3};
  EXPECT_EQ(make(p).rotary_count(), 3u);
}

// Central differences of the next lower derivative along a path with known derivatives: tip and angles are
// cubic in t, so their derivatives are exact. Step h = 1e-4: truncation h^2/6 times the third derivative of
// the differenced one, below 2e-9 * 1e4, and rounding 1e-12 / 1e-4, relative to values up to 1e4.
TEST(Chain, path_derivatives_of_order_one_to_three_agree_with_central_differences) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> position(-300, 300), angle(-180, 180), rate(-60, 60);
  for (const Machine& m : machines()) {
    const Chain chain = make(m.parameters);
    for (int i = 0; i < 500; ++i) {
      TipMotion at_zero;
      for (auto& v : at_zero.tip) v = Vec3(position(random), position(random), position(random));
      for (std::size_t k = 0; k < angle_count; ++k) {
        at_zero.angles[0][k] = angle(random);
        for (std::size_t n = 1; n < 4; ++n) at_zero.angles[n][k] = rate(random);
      }
      const auto at = [&](double t) {
        TipMotion motion;
        const auto cubic = [&](const auto& d, auto& out) {
          out[0] = d[0] + t * (d[1] + t / 2 * (d[2] + t / 3 * d[3]));
          out[1] = d[1] + t * (d[2] + t / 2 * d[3]);
          out[2] = d[2] + t * d[3];
          out[3] = d[3];
        };
        cubic(at_zero.tip, motion.tip);
        for (std::size_t k = 0; k < angle_count; ++k) {
          std::array<double, 4> d, out;
          for (std::size_t n = 0; n < 4; ++n) d[n] = at_zero.angles[n][k];
          cubic(d, out);
          for (std::size_t n = 0; n < 4; ++n) motion.angles[n][k] = out[n];
        }
        return chain.machine_derivatives(motion, 120);
      };
      const double h = 1e-4;
      const auto low = at(-h), here = at(0), high = at(h);
      ASSERT_LT((here[0] - chain.machine_from_tip(at_zero.tip[0], at_zero.angles[0], 120)).norm(), 1e-11);
      for (std::size_t n = 1; n < 4; ++n) {
        const Vec3 difference = (high[n - 1] - low[n - 1]) / (2 * h);
        ASSERT_LT((difference - here[n]).norm(), 1e-6 * (1 + here[n].norm())) << m.name << " order " << n;
      }
    }
  }
}

// The first derivative is what the Jacobian says.
TEST(Chain, path_derivative_of_order_one_is_the_jacobian_times_the_rates) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> value(-150, 150);
  for (const Machine& m : machines()) {
    const Chain chain = make(m.parameters);
    for (int i = 0; i < 500; ++i) {
      TipMotion motion;
      for (std::size_t n = 0; n < 2; ++n) {
        motion.tip[n] = Vec3(value(random), value(random), value(random));
        for (double& a : motion.angles[n]) a = value(random);
      }
      const Jacobian j = chain.jacobian(motion.tip[0], motion.angles[0], 90);
      const auto& a = motion.angles[1];
      const Vec3 rate =
          j.tip * motion.tip[1] + j.angle * Vec3(a[0], a[1], a[2]) + j.further_angle * Vec3(a[3], a[4], a[5]);
      ASSERT_LT((chain.machine_derivatives(motion, 90)[1] - rate).norm(), 1e-9) << m.name;
    }
  }
}

}  // namespace
}  // namespace trunnion::geometry
