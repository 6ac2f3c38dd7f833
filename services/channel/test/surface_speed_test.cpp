// SPDX-License-Identifier: Apache-2.0
// Constant surface speed (G96): what the PLC is asked for, and the radius in every setpoint.
#include <cmath>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::AuxiliaryKind;
using idl::channel::CommandKind;
using testing::Channel;

struct Turning : Channel {
  void SetUp() override {
    parameters->values[105000] = {0, "S"}, parameters->values[105001] = {10, ""};
    parameters->values[105948] = {2500, ""};
    begin();
  }
  void turn(const std::string& program) {
    load(program);
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
    ASSERT_EQ(core->run_state(), RunState::IDLE);
  }
  std::vector<idl::channel::AuxiliaryRequest> speeds() const {
    std::vector<idl::channel::AuxiliaryRequest> found;
    for (const auto& a : auxiliaries)
      if (a.kind == AuxiliaryKind::S) found.push_back(a);
    return found;
  }
};

// The limit is 2500 1/min of 10a948, not 3000 of G92. Behind G96 the spindle has 200000 / 40 pi = 1591.5
// 1/min.
TEST_F(Turning, ASurfaceSpeedIsAskedForWithItsLimitAndTheRadiusAtStandstill) {
  turn("G92 S3000\nG90 G0 X-40\nG96 S200 M3\nG1 X-20 F600\nG97\nG1 X10\nM30\n");
  const auto asked = speeds();
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_TRUE(asked[0].surface);
  EXPECT_EQ(asked[0].value, 200);
  EXPECT_EQ(asked[0].limit, 2500);
  EXPECT_NEAR(asked[0].radius, 40, 1e-9);
  EXPECT_FALSE(asked[1].surface);
  EXPECT_EQ(asked[1].value, 1591);
}

TEST_F(Turning, EverySetpointWithASurfaceSpeedHasItsRadius) {
  turn("G90 G0 X-40\nG96 S200 M3\nG1 X20 F600\nG97\nG1 X10\nM30\n");
  std::size_t turned = 0;
  for (std::size_t i = 0; i < drive.rows.size(); ++i) {
    if (drive.lines[i] != 3) continue;
    ++turned;
    ASSERT_TRUE(drive.radius[i].has_value()) << "row " << i;
    ASSERT_NEAR(*drive.radius[i], std::abs(drive.rows[i][0]), 1e-12);
  }
  EXPECT_GT(turned, 5000u) << "60 mm at 10 mm/s";
  EXPECT_FALSE(drive.radius.front().has_value());
  EXPECT_FALSE(drive.radius.back().has_value());
}

TEST_F(Turning, AxesThatAreMovedByHandHaveNone) {
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG).accepted);
  ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", 600, 5).accepted);
  run();
  ASSERT_FALSE(drive.rows.empty());
  for (const auto& radius : drive.radius) EXPECT_FALSE(radius.has_value());
}

}  // namespace
}  // namespace trunnion::channel
