// SPDX-License-Identifier: Apache-2.0
#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {
using testing::Channel;
using testing::CommandKind;

using idl::stream::DriveMode;
using idl::stream::StreamRequestKind;

struct HomedAxis : Channel {
  void SetUp() override {
    parameters->values[101920] = {1, ""};  // Y has a home switch in positive direction
    begin();
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::REF);
  }
  Answer reference(std::uint8_t axis) { return ask(CommandKind::REFERENCE_AXIS, "", 0, 0, Mode::REF, axis); }
};

TEST_F(HomedAxis, AReferenceReturnOfAnAxisWithAHomeSwitchIsADemandOfTheDrive) {
  ASSERT_TRUE(reference(1).accepted);
  const auto request = core->take_stream_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->kind, StreamRequestKind::HOME);
  EXPECT_EQ(request->axis, 1u) << "the logical number of the axis";
  drive.request(*request);
  drive.mode = DriveMode::HOMING;
  core->on_feedback(drive.run(0));
  const auto answer = reference(0);
  EXPECT_FALSE(answer.accepted);
  EXPECT_NE(answer.reason.find("searches its reference"), std::string::npos) << answer.reason;
  drive.mode = DriveMode::FOLLOWING;
  core->on_feedback(drive.run(0));
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", 600, 1, Mode::JOG, 0).accepted);
  core->advance();
  const auto start = core->take_stream_request();
  ASSERT_TRUE(start);
  EXPECT_EQ(start->kind, StreamRequestKind::NEW_EPOCH)
      << "the stream begins where the drive has found the axes";
}

TEST_F(HomedAxis, AnAxisWithoutASwitchIsMovedToItsReferencePosition) {
  EXPECT_TRUE(reference(0).accepted);
  core->advance();
  EXPECT_FALSE(core->take_stream_request()) << "it is there already";
}

}  // namespace
}  // namespace trunnion::channel
