// SPDX-License-Identifier: Apache-2.0
#include "geometry/chain_elements.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <random>

#include "machines.hpp"

namespace trunnion::geometry {
namespace {

ChainElement offset(const Vec3& v) { return {"OFFSET", ElementKind::offset, v, 0}; }
ChainElement correction(const Vec3& v) { return {"CORR", ElementKind::correction, v, 0}; }
ChainElement rotary(std::size_t axis, const Vec3& v) { return {"ROTARY", ElementKind::rotary, v, axis}; }
ChainElement linear(std::size_t axis) {
  return {"LINEAR", ElementKind::linear, Vec3::Unit(static_cast<Eigen::Index>(axis)), axis};
}

Chain chain_of(const ChainDescription& d) { return make(std::get<ChainParameters>(parameters_of(d))); }

void expect_same(const Chain& x, const Chain& y) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> value(-300, 300);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 w(value(random), value(random), value(random));
    const Angles a{value(random), value(random), value(random)};
    ASSERT_EQ(x.machine_from_tip(w, a, 77), y.machine_from_tip(w, a, 77));
    ASSERT_EQ(x.tool_direction_in_workpiece(a), y.tool_direction_in_workpiece(a));
  }
}

TEST(ChainElements, an_ac_table_as_a_list_gives_the_bits_of_its_parameters) {
  const ChainDescription d{Vec3::UnitZ(),
                           {offset({-200, -190, -516}), correction({-0.3605, -0.1897, -0.0118}),
                            rotary(2, {0, 0, -1}), offset({0, 0.1, 0}), correction({0, 0.0028, 0}),
                            rotary(0, {-1, 0, 0}), linear(1), linear(0), linear(2)},
                           true};
  ChainParameters p = ac_table();
  p.table_1->offset = Vec3(0, 0.1, 0);
  p.table_1->correction = Vec3(0, 0.0028, 0);
  p.table_2->offset = Vec3(-200, -190, -516) + Vec3(-0.3605, -0.1897, -0.0118);
  expect_same(chain_of(d), make(p));
}

// A head's parameters point from the tool to the base, the list from the workpiece to the tool.
TEST(ChainElements, a_cb_head_as_a_list_gives_the_bits_of_its_parameters) {
  const ChainDescription d{Vec3::UnitZ(),
                           {linear(0), linear(1), linear(2), rotary(2, {0, 0, 1}), offset({-1.5, 2.5, 0}),
                            rotary(1, {0, 1, 0}), offset({-0.2, 0, -251.3})},
                           true};
  expect_same(chain_of(d), make(cb_head()));
}

// Table at Z100 under C, spindle face 400 above it: at zero the tip of a tool of 50 is 350 above the table.
TEST(ChainElements, an_open_chain_ends_where_its_vectors_say) {
  ChainDescription d{
      Vec3::UnitZ(), {rotary(2, {0, 0, -1}), linear(2), linear(1), linear(0), offset({0, 0, 400})}, false};
  EXPECT_LT((chain_of(d).tip_from_machine(Vec3(1, 2, 3), {}, 50) - Vec3(1, 2, 353)).norm(), 1e-12);
  d.closed = true;
  EXPECT_LT((chain_of(d).tip_from_machine(Vec3(1, 2, 3), {}, 50) - Vec3(1, 2, -47)).norm(), 1e-12);
}

// The same walk done one element at a time with matrices.
void expect_walk(const ChainDescription& d, std::size_t base) {
  const Chain chain = chain_of(d);
  std::mt19937_64 random(32);
  std::uniform_real_distribution<double> value(-180, 180);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x(value(random), value(random), value(random));
    Angles a;
    for (double& angle : a) angle = value(random);
    Mat3 frame = Mat3::Identity();
    Vec3 place = Vec3::Zero();
    for (std::size_t n = 0; n < d.elements.size(); ++n) {
      const auto& e = d.elements[n];
      if (e.kind == ElementKind::linear)
        place += frame * e.vector * x[static_cast<Eigen::Index>(e.axis)];
      else if (e.kind == ElementKind::rotary)
        frame = frame * Eigen::AngleAxisd((n > base ? 1 : -1) * a[e.axis] * std::numbers::pi / 180,
                                          e.vector.normalized())
                            .toRotationMatrix();
      else
        place += frame * e.vector;
    }
    const Vec3 tool = frame * d.tool_direction.normalized();
    ASSERT_LT((chain.tip_from_machine(x, a, 60) - (place - 60 * tool)).norm(), 1e-10);
    ASSERT_LT((chain.tool_direction_in_workpiece(a) - tool).norm(), 1e-14);
  }
}

TEST(ChainElements, three_rotary_axes_on_each_side_agree_with_a_walk_along_the_elements) {
  const ChainDescription d{
      Vec3(0.1, 0, 1),
      {offset({1, 2, 3}), rotary(3, {0, 0, -1}), offset({4, 5, 6}), rotary(4, {-1, 0.2, 0}),
       offset({7, -8, 9}), rotary(5, {0, 1, 0}), offset({0, 0, -20}), linear(2), linear(0),
       offset({30, 0, 0}), linear(1), offset({0, 40, 0}), rotary(2, {0, 0, 1}), offset({0, 3, -1}),
       rotary(1, {0, 1, 1}), offset({2, 0, -9}), rotary(0, {1, 0, 0}), offset({0, 0, -150})},
      false};
  expect_walk(d, 7);
}

const ChainElement base{"BASE", ElementKind::base, Vec3::Zero(), 0};

// Every order of X, Y and Z, with a rotary axis of the table and of the head at every pair of places among
// them.
TEST(ChainElements, linear_axes_in_any_order_and_anywhere_agree_with_a_walk_along_the_elements) {
  std::array<std::size_t, 3> order{0, 1, 2};
  int chains = 0;
  do
    for (std::size_t table = 0; table <= 3; ++table)
      for (std::size_t head = table; head <= 3; ++head)
        for (std::size_t still = table; still <= head; ++still) {
          ChainDescription d{Vec3(0.1, 0, 1), {offset({1, 2, 3})}, false};
          std::size_t base_at = 0;
          for (std::size_t n = 0; n <= 3; ++n) {
            if (n == table) {
              d.elements.push_back(rotary(2, {0.1, 0, -1}));
              d.elements.push_back(offset({4, -5, 6}));
            }
            if (n == still) {
              base_at = d.elements.size();
              d.elements.push_back(base);
            }
            if (n == head) {
              d.elements.push_back(rotary(1, {0, 1, 0.2}));
              d.elements.push_back(offset({7, 0, -150}));
            }
            if (n < 3) d.elements.push_back(linear(order[n]));
          }
          expect_walk(d, base_at);
          ++chains;
        }
  while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(chains, 6 * 20);
}

// Without a base the rotary axes before the first linear one are the table's.
TEST(ChainElements, a_head_may_carry_a_linear_axis) {
  const ChainDescription d{Vec3::UnitZ(),
                           {rotary(2, {0, 0, -1}), linear(1), linear(0), offset({0, 40, 0}),
                            rotary(1, {0, 1, 0}), linear(2), offset({0, 3, -100})},
                           false};
  EXPECT_EQ(std::get<ChainParameters>(parameters_of(d)).linear_carriers, (std::array<int, 3>{0, 0, 1}));
  expect_walk(d, 1);
}

TEST(ChainElements, refuses_an_order_it_cannot_build) {
  const auto error = [](std::vector<ChainElement> elements) {
    return std::get<ChainError>(parameters_of({Vec3::UnitZ(), std::move(elements), true}));
  };
  const auto c = rotary(2, {0, 0, 1}), b = rotary(1, {0, 1, 0});
  EXPECT_EQ(error({linear(0), linear(1)}), ChainError::linear_missing);
  EXPECT_EQ(error({linear(0), linear(1), linear(1), linear(2)}), ChainError::linear_missing);
  EXPECT_EQ(error({base, linear(0), linear(1), base, linear(2)}), ChainError::two_bases);
  const auto corr = correction({1, 0, 0});
  EXPECT_EQ(error({corr, corr, c, linear(0), linear(1), linear(2)}), ChainError::two_corrections);
  EXPECT_EQ(error({c, corr, linear(0), linear(1), linear(2)}), ChainError::idle_correction);
  EXPECT_EQ(error({c, b, c, b, linear(0), linear(1), linear(2)}), ChainError::too_many_rotary);
}

}  // namespace
}  // namespace trunnion::geometry
