// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "kinematics_core.hpp"

namespace trunnion::kinematics {
namespace {

// An AC trunnion: A turns about -X, C about -Z (section 3 of the HNC-8 specification), with offsets that
// matter.
machine::Parameters ac_table() {
  machine::Parameters p;
  for (std::uint32_t i = 0; i < 3; ++i) p.values[40001 + i] = {static_cast<double>(i), ""};
  p.values[40004] = {3, ""};
  p.values[40006] = {4, ""};
  p.values[40425] = {35, ""};
  p.values[40426] = {-1, ""};
  p.values[40431] = {-1, ""};
  p.values[40433] = {0.1, ""};
  p.values[40435] = {-200, ""}, p.values[40436] = {-190, ""}, p.values[40437] = {-516, ""};
  return p;
}

using enum idl::stream::Transformation;

idl::stream::PathBatch batch(std::initializer_list<double> row, idl::stream::Transformation transformation,
                             double length) {
  idl::stream::PathBatch f;
  f.count = 1;
  f.transformation = transformation;
  f.tool_length = length;
  f.setpoints.assign(row);
  return f;
}

TEST(Kinematics, WithoutTransformationTheAxesAreWhatTheChannelSays) {
  KinematicsCore core;
  core.configure(ac_table(), 0);
  idl::stream::AxisBatch out;
  ASSERT_TRUE(core.process(batch({1, 2, 3, 40, 0, 50, 0, 0, 0}, NO_TRANSFORMATION, 100), {}, out));
  EXPECT_EQ(out.axes, (std::vector<std::uint16_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(out.setpoints, (std::vector<double>{1, 2, 3, 40, 50}));
}

TEST(Kinematics, RtcpTurnsTheWorkpiecePointAboutC) {
  KinematicsCore core;
  core.configure(ac_table(), 0);
  idl::stream::AxisBatch out;
  // C axis at (-200, -190), turning about -Z: C90 takes the point 10 to the right of the axis, (-190, -190),
  // to
  // (-200, -200); the spindle face is the tool length above the tip.
  core.process(batch({-190, -190, -500, 0, 0, 90, 0, 0, 0}, RTCP, 100), {}, out);
  EXPECT_NEAR(out.setpoints[0], -200, 1e-9);
  EXPECT_NEAR(out.setpoints[1], -200, 1e-9);
  EXPECT_NEAR(out.setpoints[2], -400, 1e-9);
}

// 040960: the C axis is found 0.25 farther in X than its offset says, so C180 brings a point 0.5 farther.
TEST(Kinematics, ACorrectionOfTheChainIsPartOfARevision) {
  KinematicsCore before, after;
  auto parameters = ac_table();
  before.configure(parameters, 0);
  parameters.values[40960] = {0.25, ""};
  after.configure(parameters, 0);
  idl::stream::AxisBatch out, corrected;
  const auto in = batch({-190, -190, -500, 0, 0, 180, 0, 0, 0}, RTCP, 100);
  ASSERT_TRUE(before.process(in, {}, out));
  ASSERT_TRUE(after.process(in, {}, corrected));
  EXPECT_NEAR(corrected.setpoints[0] - out.setpoints[0], 0.5, 1e-12);
  EXPECT_NEAR(corrected.setpoints[1], out.setpoints[1], 1e-12);
}

TEST(Kinematics, ForwardOfWhatItCommandsIsTheTipWithin1e9) {
  KinematicsCore core;
  const auto parameters = ac_table();
  core.configure(parameters, 0);
  const auto chain = machine::make_chain(parameters, 0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-500, 500), angle(-360, 360);
  idl::stream::AxisBatch out;
  for (int i = 0; i < 20000; ++i) {
    const geometry::Vec3 tip(place(random), place(random), place(random));
    const double a = angle(random), c = angle(random), length = std::abs(place(random));
    core.process(batch({tip.x(), tip.y(), tip.z(), a, 0, c, 0, 0, 0}, RTCP, length), {}, out);
    const auto back =
        chain.tip_from_machine({out.setpoints[0], out.setpoints[1], out.setpoints[2]}, {a, 0, c}, length);
    ASSERT_LT((back - tip).norm(), 1e-9);
  }
}

TEST(Kinematics, CommandsTheBitsOfTheLibrary) {
  KinematicsCore core;
  core.configure(ac_table(), 0);
  const auto chain = machine::make_chain(ac_table(), 0);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(-500, 500), angle(-360, 360);
  idl::stream::AxisBatch out;
  for (int i = 0; i < 20000; ++i) {
    const geometry::Vec3 tip(place(random), place(random), place(random));
    const double a = angle(random), c = angle(random);
    core.process(batch({tip.x(), tip.y(), tip.z(), a, 0, c, 0, 0, 0}, RTCP, 123.4), {}, out);
    const geometry::Vec3 at = chain.machine_from_tip(tip, {a, 0, c}, 123.4);
    ASSERT_EQ(out.setpoints, (std::vector<double>{at.x(), at.y(), at.z(), a, c}));
  }
}

TEST(Kinematics, AZeroDirectionIsRefusedWithTheParametersNamed) {
  auto parameters = ac_table();
  parameters.values[40426] = {0, ""};
  KinematicsCore core;
  try {
    core.configure(parameters, 0);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("040426 .. 040428"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace trunnion::kinematics
