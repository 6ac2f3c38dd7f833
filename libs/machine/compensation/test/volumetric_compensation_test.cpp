// SPDX-License-Identifier: Apache-2.0
#include "compensation/volumetric_compensation.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geometry/angle.hpp"

namespace trunnion::volumetric {
namespace {

geometry::ChainParameters ac_table() {
  geometry::ChainParameters p;
  p.table_1 = geometry::RotaryAxis{Vec3(-1, 0, 0), Vec3(0, 0.1, 0), 0};
  p.table_2 = geometry::RotaryAxis{Vec3(0, 0, -1), Vec3(-200, -190, -516), 2};
  return p;
}

VolumetricCompensation make(const geometry::ChainParameters& design, const GeometryErrors& errors,
                            const CompensationSettings& settings) {
  return std::get<VolumetricCompensation>(VolumetricCompensation::make(design, errors, settings));
}

ErrorFunction constant(double value) {
  ErrorFunction f;
  f.terms.polynomials.push_back({0, 1, {value}});
  return f;
}

TEST(VolumetricCompensation, WithoutErrorsNothingIsAdded) {
  const auto compensation = make(ac_table(), {}, {true});
  MachinePose pose;
  pose.positions = {10, 20, 30, 40, 0, 50};
  const auto correction = compensation.correction(pose);
  EXPECT_TRUE(correction.converged);
  for (const double added : correction.added) EXPECT_NEAR(added, 0, 1e-10);
}

// Three axes, EXX = 5 um: the tool is 5 um too far, so 5 um are taken off. C0Y = 100 urad: Y leans to -X by
// y * 1e-4, at y = 200 by 0.02 mm, and is short by 1 - cos(1e-4) of it, 1e-6 mm; X gets 0.02 - 0.005.
TEST(VolumetricCompensation, ConstantErrorAndSquarenessInClosedForm) {
  GeometryErrors errors;
  errors.axes[0].errors.push_back({0, 0, constant(0.005)});
  errors.axes[1].inclination[2] = 1e-4;
  MachinePose pose;
  pose.positions = {50, 200, 10};
  const auto correction = make({}, errors, {}).correction(pose);
  EXPECT_NEAR(correction.added[0], 0.02 * (1 - 1e-8 / 3) / (1 - 0.5e-8) - 0.005, 1e-9) << "y tan(1e-4) - EXX";
  EXPECT_NEAR(correction.added[1], 200 * 0.5e-8, 1e-9);
  EXPECT_NEAR(correction.added[2], 0, 1e-12);
}

// EAZ = 1e-4 turns the tool about the reference point of the Z carriage: with the point at z = 0 above a tip
// 150 mm lower, the tip moves by 150e-4 mm in +Y: -EA x (0, 0, -150) = +0.015.
TEST(VolumetricCompensation, TheToolLengthIsInTheCorrection) {
  GeometryErrors errors;
  errors.axes[2].errors.push_back({3, 2, constant(1e-4)});
  for (const double length : {0.0, 150.0}) {
    MachinePose pose;
    pose.tool_length = length;
    EXPECT_NEAR(make({}, errors, {}).correction(pose).added[1], -1e-4 * length, 1e-8) << length;
  }
}

GeometryErrors random_errors(std::mt19937& engine, double mm, double rad) {
  std::normal_distribution<double> normal;
  GeometryErrors errors;
  for (const std::size_t axis : {0u, 1u, 2u, 3u, 5u}) {
    for (std::size_t c = 0; c < component_count; ++c) {
      ErrorFunction f;
      f.terms.polynomials.push_back(
          {0, 300, {normal(engine) * (c < 3 ? mm : rad), normal(engine) * (c < 3 ? mm : rad)}});
      errors.axes[axis].errors.push_back({c, axis, f});
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (axis > 2) errors.axes[axis].displacement[i] = normal(engine) * mm;
      if (axis > 2) errors.axes[axis].inclination[i] = normal(engine) * rad;
    }
  }
  return errors;
}

// 1000 poses of machines whose errors are ten times those of a worn one: 0.1 mm and 0.5 mrad. The tip is
// exact; the direction, away from the pole A = 0, to (damping^2 / (sin^2 A + damping^2))^3
// of its error.
TEST(VolumetricCompensation, TheCorrectedMachineIsWhereTheIdealOneIs) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> linear(-400, 400), tilt(-100, 100), turn(-180, 180);
  int most = 0;
  for (int machine = 0; machine < 20; ++machine) {
    const auto compensation = make(ac_table(), random_errors(engine, 0.1, 5e-4), {true, 0.04});
    for (int n = 0; n < 50; ++n) {
      MachinePose pose;
      pose.positions = {linear(engine), linear(engine), linear(engine), tilt(engine), 0, turn(engine)};
      pose.tool_length = 120;
      const auto target = compensation.model().ideal_pose(pose);
      const auto correction = compensation.correction(pose);
      ASSERT_TRUE(correction.converged);
      most = std::max(most, correction.iterations);
      auto corrected = pose;
      for (std::size_t i = 0; i < axis_count; ++i) corrected.positions[i] += correction.added[i];
      const auto before = compensation.model().pose(pose), after = compensation.model().pose(corrected);
      EXPECT_LT((after.tip - target.tip).norm(), 1e-9);
      const double s = std::sin(pose.positions[3] * geometry::radians_per_degree);
      const double share = std::pow(16e-4 / (s * s + 16e-4), 3);
      EXPECT_LT((after.axis - target.axis).norm(), (1.1 * share + 0.02) * (before.axis - target.axis).norm())
          << "A" << pose.positions[3];
    }
  }
  EXPECT_LT(most, VolumetricCompensation::most_iterations);
}

// At the pole A = 0 the axis C does not move the tool: its correction stays below error / damping.
TEST(VolumetricCompensation, TheCorrectionOfARotaryAxisIsBoundedAtThePole) {
  GeometryErrors errors;
  errors.spindle.inclination = Vec3(0, 1e-4, 0);
  const auto compensation = make(ac_table(), errors, {true, 0.04});
  for (double a = -5; a <= 5; a += 0.01) {
    MachinePose pose;
    pose.positions[3] = a;
    const auto correction = compensation.correction(pose);
    EXPECT_LE(std::abs(correction.added[5]) * geometry::radians_per_degree, 1.01 * 1e-4 / 0.04) << a;
  }
}

TEST(VolumetricCompensation, AStructureOfAnotherMachineIsRefused) {
  GeometryErrors errors;
  errors.structure = {{0, false}, {1, false}};
  const auto refused = VolumetricCompensation::make({}, errors, {});
  ASSERT_TRUE(std::holds_alternative<std::string>(refused));
  EXPECT_EQ(std::get<std::string>(refused), "axis Z must be there once, it is there 0 times");
}

}  // namespace
}  // namespace trunnion::volumetric
