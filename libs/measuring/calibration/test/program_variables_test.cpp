// SPDX-License-Identifier: Apache-2.0
#include "calibration/program_variables.hpp"

#include <gmock/gmock.h>

#include "geometry/test/machines.hpp"
#include "testing_support/refusal.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

constexpr double length = 150, sphere_radius = 12.5, ball_radius = 3, pre_travel = 0.005;
const Vec3 sphere(120, 60, -330);

// What %001 leaves on a machine whose vectors are `real`: A -25 .. 80 by 15 degrees at C0, C 0 .. 315 by 45
// at A0; the pole and three sides of the equator, the pre-travel deep.
std::map<std::uint32_t, double> variables_of(const ChainParameters& real) {
  std::map<std::uint32_t, double> v{{52000, 1},      {52002, 4},           {52003, 6}, {52008, sphere_radius},
                                    {52009, length}, {52010, ball_radius}, {52999, 16}};
  const auto chain = geometry::make(real);
  for (std::uint32_t n = 0; n < 16; ++n) {
    const std::uint32_t i = n % 8, base = (n < 8 ? 52100 : 52800) + i;
    const Angles angles{n < 8 ? -25 + 15.0 * i : 0, 0, n < 8 ? 0 : 45.0 * i};
    v[base + 30] = angles[0], v[base + 40] = angles[2];
    const Vec3 centre = chain.machine_from_tip(sphere, angles, length);
    const Vec3 directions[]{Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitX()};
    for (std::uint32_t k = 0; k < 4; ++k)
      for (std::uint32_t c = 0; c < 3; ++c)
        v[52150 + 40 * n + 10 * k + c] =
            centre[c] + (sphere_radius + ball_radius - pre_travel) * directions[k][c];
  }
  return v;
}

TEST(ProgramVariables, TheVectorsAreThoseOfTheMachineThatTheProgramHasTouched) {
  auto real = geometry::ac_table();
  real.table_2->offset += Vec3(0.04, -0.025, 0.03);
  real.table_1->offset += Vec3(0, 0.015, 0);
  const TrueMachine machine(real, geometry::ac_table());
  auto [in, touched] = measurement_of(variables_of(real), default_inputs(machine.measured), machine.measured);
  EXPECT_EQ(touched.size(), 16u);
  EXPECT_LT((in.sphere - sphere).norm(), 1e-9) << "with both rotary axes at zero the model is right";
  EXPECT_EQ(in.axes[0].angle, 0u);
  const auto result = evaluate(in, machine.measured, touched);
  EXPECT_NEAR(result.ball_diameter, 2 * (ball_radius - pre_travel), 1e-9);
  for (const auto slot : {metrology::Slot::table_1, metrology::Slot::table_2})
    EXPECT_LT((axis_at(result.after, slot)->offset - axis_at(real, slot)->offset).norm(), 1e-6);
  auto other_order = variables_of(real);
  other_order[52001] = 1;
  EXPECT_EQ(
      measurement_of(other_order, default_inputs(machine.measured), machine.measured).inputs.axes[0].angle,
      2u);
}

TEST(ProgramVariables, WhatTheProgramHasNotMeasuredIsRefusedInOneLine) {
  const TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  const auto all = variables_of(geometry::ac_table());
  const auto refusal = [&](const std::function<void(std::map<std::uint32_t, double>&)>& change,
                           const MeasuredMachine& measured) {
    auto v = all;
    change(v);
    return testing_support::refusal_of([&] { measurement_of(v, default_inputs(measured), measured); });
  };
  EXPECT_EQ(refusal([](auto& v) { v[52999] = 9; }, machine.measured),
            "variable #52999 is 9: %001 has measured so many of its 16 points; run it to its end");
  EXPECT_EQ(refusal(
                [](auto& v) {
                  v.erase(52183);
                  v.erase(52182);
                },
                machine.measured),
            "variable #52182 has no value: run %001 to its end first");
  EXPECT_EQ(refusal([](auto& v) { v[52003] = 7; }, machine.measured),
            "variable #52003 is 7: 4, 5 or 6 is expected: A, B or C");
  EXPECT_THAT(refusal([](auto& v) { v[52142] = 5; }, machine.measured),
              testing::StartsWith("variable #52142 is 5: the other rotary axis must stay"));
  EXPECT_THAT(refusal([](auto& v) { v[52131] = -20; }, machine.measured),
              testing::HasSubstr("#52130 .. #52137 must be evenly spaced"));
  EXPECT_THAT(refusal(
                  [](auto& v) {
                    for (std::uint32_t i = 0; i < 8; ++i) v[52830 + i] = 10;
                  },
                  machine.measured),
              testing::StartsWith("none of the 16 teaching points has both rotary axes at 0"));
  const TrueMachine head(geometry::cb_head(), geometry::cb_head());
  EXPECT_EQ(refusal([](auto&) {}, head.measured),
            "variable #52000 is 1: the calibration type of this machine is 0 (0 dual head, 1 dual table, 2 "
            "hybrid)");
}

}  // namespace
}  // namespace trunnion::calibration
