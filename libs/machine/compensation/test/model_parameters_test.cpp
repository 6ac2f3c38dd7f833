// SPDX-License-Identifier: Apache-2.0
#include "compensation/model_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compensation/structure.hpp"
#include "machine/kinematics.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::volumetric {
namespace {

machine::Parameters three_axes() {
  machine::Parameters p;
  for (std::uint32_t i = 0; i < 3; ++i) p.values[parameter::channel_axis.number(0, i)] = {1.0 * i, ""};
  p.values[parameter::volumetric_type.number(0)] = {1, ""};
  return p;
}

std::string refusal(const machine::Parameters& p) {
  try {
    compensation_of(p, 0);
  } catch (const machine::KinematicsError& e) {
    return e.what();
  }
  return "";
}

TEST(ModelParameters, WhatIsWrittenIsRead) {
  auto p = three_axes();
  GeometryErrors location;
  location.axes[1].inclination[2] = 30e-6;
  location.axes[2].reference_point = Vec3(1, 2, 3);
  AxisTables tables;
  tables.start = -100, tables.interval = 50, tables.points = 3, tables.bidirectional = true;
  for (std::size_t c = 0; c < component_count; ++c) {
    tables.positive[c] = {0, 0.001 * static_cast<double>(c), 0.002};
    tables.negative[c] = {0, 0.003, 0};
  }
  for (const auto& [number, value] : parameters_of(p, 0, location, {{0, tables}}, 700000))
    p.values[number] = value;
  const auto errors = errors_of(p, 0);
  EXPECT_NEAR(errors.axes[1].inclination[2], 30e-6, 1e-18);
  EXPECT_EQ(*errors.axes[2].reference_point, Vec3(1, 2, 3));
  ASSERT_EQ(errors.axes[0].errors.size(), 6u);
  for (std::size_t c = 0; c < component_count; ++c) {
    auto f = errors.axes[0].errors[c].function;
    for (auto* terms : {&f.positive, &f.negative})
      for (auto& table : terms->tables) table.finish();
    EXPECT_NEAR(f.value(-50, 1), 0.001 * static_cast<double>(c), 1e-15);
    EXPECT_NEAR(f.value(-50, -1), 0.003, 1e-15);
  }
  EXPECT_TRUE(compensation_of(p, 0));
}

TEST(ModelParameters, OffIsNothing) {
  auto p = three_axes();
  p.values[parameter::volumetric_type.number(0)] = {0, ""};
  EXPECT_FALSE(compensation_of(p, 0));
}

TEST(ModelParameters, WhatDoesNotFitNamesItsParameter) {
  auto p = three_axes();
  p.values[parameter::volumetric_structure.number(0)] = {0, "[w b X Y t]"};
  EXPECT_EQ(refusal(p),
            "parameter 040951 (volumetric_type): channel 0: axis Z must be there once, it is there 0 times");
  p.values[parameter::volumetric_structure.number(0)] = {0, "w b X Y Z"};
  EXPECT_THAT(refusal(p), testing::StartsWith("parameter 040955 (volumetric_structure): "));
  p = three_axes();
  p.values[parameter::volumetric_points.number(1)] = {100, ""};
  p.values[parameter::volumetric_table.number(1)] = {709401, ""};
  EXPECT_EQ(refusal(p), "parameter 301904 (volumetric_table): 600 values from 709401 end after 709999");
  p = three_axes();
  p.values[parameter::channel_axis.number(0, 2)] = {-1, ""};
  EXPECT_EQ(refusal(p), "parameter 040951 (volumetric_type): channel 0 needs the axes X, Y and Z, it has XY");
}

// A table over C of 12 values at 30 deg is that of every turn when it repeats; without an end of its travel C
// would otherwise keep the last value, or jump.
TEST(ModelParameters, ATableOverAnAxisThatCountsModulo360RepeatsWithItsTurn) {
  const auto with = [](double way, double direction, double points) {
    auto p = three_axes();
    p.values[parameter::channel_axis.number(0, 5)] = {5, ""};
    p.values[parameter::axis_type.number(5)] = {3, ""};
    p.values[parameter::rotary_way.number(5)] = {way, ""};
    p.values[parameter::volumetric_points.number(5)] = {points, ""};
    p.values[parameter::volumetric_interval.number(5)] = {30, ""};
    p.values[parameter::volumetric_direction.number(5)] = {direction, ""};
    return refusal(p);
  };
  EXPECT_EQ(with(0, 1, 13), "");
  EXPECT_EQ(with(1, 3, 12), "");
  EXPECT_EQ(with(1, 4, 6), "");
  EXPECT_EQ(
      with(1, 1, 13),
      "parameter 305903 (volumetric_direction) is 1 and the table 390 deg long; axis 5 counts modulo 360 "
      "(parameter 105949), so the table must repeat (3 or 4) after 360 deg or a whole part of it");
  EXPECT_NE(with(2, 4, 13), "");
}

TEST(Structure, IsReadWithAndWithoutBrackets) {
  const auto parsed = parse_structure("[w C' A' b X Y Z (S) t]");
  const auto& axes = std::get<std::vector<StructureAxis>>(parsed);
  ASSERT_EQ(axes.size(), 5u);
  EXPECT_EQ(axes[0].axis, 5u);
  EXPECT_TRUE(axes[1].workpiece);
  EXPECT_FALSE(axes[4].workpiece);
  EXPECT_EQ(std::get<std::vector<StructureAxis>>(parse_structure("w X' b Z t")).size(), 2u);
}

TEST(Structure, FaultsAreOneLine) {
  for (const char* text :
       {"", "[]", "X", "w t", "w b b t", "w X b Y' t", "w b Q t", "w b X", "w b XX t", "w X t"}) {
    const auto parsed = parse_structure(text);
    ASSERT_TRUE(std::holds_alternative<std::string>(parsed)) << text;
    EXPECT_EQ(std::get<std::string>(parsed).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace trunnion::volumetric
