// SPDX-License-Identifier: Apache-2.0
// Writing setpoints into the stream by itself: credit, batches, the end of a motion, what was executed.
#include "stream_writer.hpp"

#include <gtest/gtest.h>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

constexpr std::uint64_t lead = 32;

struct Writer : ::testing::Test {
  Writer() {
    machine.configure(*testing::three_axes(7));
    path.build(machine.limits());
    path.start({});
    writer.link().on_feedback(drive.run(0));
  }
  void become_active() {
    writer.start();
    const auto request = writer.link().take_request();
    ASSERT_TRUE(request);
    drive.request(*request);
    writer.link().on_feedback(drive.run(0));
    ASSERT_EQ(writer.link().state(), LinkState::active);
  }
  /// A batch of `count` cycles, X counting on by `step`.
  idl::stream::PathBatch batch(std::uint32_t count, double step, bool holding = false) {
    idl::stream::PathBatch written;
    writer.open(written);
    for (std::uint32_t i = 0; i < count && !written.ends; ++i) {
      StreamCycle cycle;
      cycle.setpoint[0] = x += step;
      cycle.shown.line = cycle.line = 5;
      cycle.shown.sequence = 9;
      cycle.stopped = step == 0;
      cycle.holding = holding;
      writer.add(written, cycle);
    }
    writer.close(written, path, false, machine.revision(), 0);
    writer.written(written);
    return written;
  }

  channel_setup::ChannelSetup machine{0};
  testing::FakeDrive drive{3};
  ChannelPath path{machine};
  StreamWriter writer{0};
  double x = 0;
};

TEST_F(Writer, BeginsTheEpochAfterTheOneThatTheDriveHas) {
  drive.request({0, 40, idl::stream::StreamRequestKind::NEW_EPOCH, 900, 0});  // of a foreign process
  drive.request({0, 41, idl::stream::StreamRequestKind::LEAVE, 900, 0});
  writer.link().leave();
  writer.link().take_request();
  writer.link().on_feedback(drive.run(0));
  become_active();
  EXPECT_EQ(writer.link().epoch(), 901u);
}

TEST_F(Writer, AsksForAPlaceOnlyWhenTheReplicasAreInStep) {
  writer.set_replicas(false, ~0ull);
  writer.start();
  EXPECT_FALSE(writer.link().take_request());
  EXPECT_TRUE(writer.idle());
  writer.set_replicas(true, ~0ull);
  become_active();
  EXPECT_TRUE(writer.moving());
}

TEST_F(Writer, WritesNoFartherThanTheLeadBeyondTheExecutedCycle) {
  become_active();
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(writer.may_write(8, lead));
    drive.put(batch(8, 0.1));
  }
  EXPECT_FALSE(writer.may_write(8, lead));
  writer.link().on_feedback(drive.run(8));
  EXPECT_TRUE(writer.may_write(8, lead));
  EXPECT_FALSE(writer.may_write(9, lead));
}

TEST_F(Writer, WritesNoFartherThanTwoLeadsBeyondTheSlowestReplica) {
  become_active();
  writer.set_replicas(true, 0);
  std::uint64_t written = 0;
  while (writer.may_write(8, lead)) {
    drive.put(batch(8, 0.1));
    written += 8;
    writer.link().on_feedback(drive.run());
  }
  EXPECT_EQ(written, 2 * lead);
  writer.set_replicas(true, 8);
  EXPECT_TRUE(writer.may_write(8, lead));
}

TEST_F(Writer, WritesNoFartherThanRecordersRead) {
  become_active();
  writer.set_limit(24);
  std::uint64_t written = 0;
  while (writer.may_write(8, lead)) {
    drive.put(batch(8, 0.1));
    written += 8;
    writer.link().on_feedback(drive.run());
  }
  EXPECT_EQ(written, 24u);
  writer.set_limit(32);
  EXPECT_TRUE(writer.may_write(8, lead));
}

TEST_F(Writer, ABatchNamesItsCyclesItsFrameAndTheRevision) {
  become_active();
  const auto first = batch(4, 0.5);
  EXPECT_TRUE(first.starts);
  EXPECT_FALSE(first.ends);
  EXPECT_EQ(first.first, 0u);
  EXPECT_EQ(first.count, 4u);
  EXPECT_EQ(first.revision, 7u);
  EXPECT_EQ(first.transformation, idl::stream::Transformation::NO_TRANSFORMATION);
  ASSERT_EQ(first.setpoints.size(), 4u * 9);
  EXPECT_EQ(first.setpoints[9 * 3], 2.0);
  EXPECT_EQ(first.lines, (std::vector<std::uint32_t>(4, 5)));
  const auto second = batch(4, 0.5);
  EXPECT_FALSE(second.starts);
  EXPECT_EQ(second.first, 4u);
  path.adopt_frame(language::Transformation::rtcp, 50);
  const auto rtcp = batch(1, 0.5);
  EXPECT_EQ(rtcp.transformation, idl::stream::Transformation::RTCP);
  EXPECT_EQ(rtcp.tool_length, 50);
}

TEST_F(Writer, AHoldEndsWhenTheSetpointsHaveBeenEqualForMoreThanThreeCycles) {
  become_active();
  batch(4, 0.1);
  const auto written = batch(16, 0, true);
  EXPECT_TRUE(written.ends);
  // The first equals the last that moved; it and three more are a standstill, not yet more than three.
  EXPECT_EQ(written.count, 4u);
  EXPECT_EQ(writer.link().state(), LinkState::ending);
  EXPECT_FALSE(writer.may_write(8, lead));
}

TEST_F(Writer, ADriveThatCountsCyclesAgainGetsANewEpoch) {
  // Killed after it had published the last cycles and before it stored them: the numbers of requests agree.
  become_active();
  auto written = batch(8, 0.1);
  const auto last = batch(16, 0, true);
  drive.put(written), drive.put(last);
  writer.link().on_feedback(drive.run());
  ASSERT_EQ(writer.link().state(), LinkState::idle);
  const auto epoch = writer.link().epoch();
  drive.next = 5;
  writer.link().on_feedback(drive.run(0));
  EXPECT_EQ(writer.link().executed(), 5u) << "the credit counts from where the drive is";
  EXPECT_TRUE(writer.link().drive_restarted());
  writer.start();
  auto request = writer.link().take_request();
  ASSERT_TRUE(request);
  EXPECT_EQ(request->kind, idl::stream::StreamRequestKind::NEW_EPOCH);
  EXPECT_EQ(request->epoch, epoch + 1);
  // While the request is on its way: what it asked for is void.
  drive.next = 4;
  writer.link().on_feedback(drive.run(0));
  EXPECT_EQ(writer.link().state(), LinkState::lost);
}

TEST_F(Writer, EqualSetpointsWithoutAHoldDoNotEndTheMotion) {
  become_active();
  EXPECT_FALSE(batch(16, 0).ends) << "a dwell";
}

TEST_F(Writer, KnowsWhatItWroteForTheExecutedCycleAndNothingOfAnotherProcess) {
  EXPECT_EQ(writer.executed(), nullptr);
  become_active();
  drive.put(batch(8, 0.1));
  writer.link().on_feedback(drive.run());
  const auto* executed = writer.executed();
  ASSERT_NE(executed, nullptr);
  EXPECT_EQ(executed->cycle, 7u);
  EXPECT_EQ(executed->line, 5u);
  EXPECT_EQ(executed->sequence, 9u);
  writer.forget_blocks();
  EXPECT_EQ(writer.executed()->sequence, 0u);
  EXPECT_EQ(writer.executed()->line, 0u);
  StreamWriter other(0);
  other.link().on_feedback(drive.run(0));
  EXPECT_EQ(other.executed(), nullptr);
}

}  // namespace
}  // namespace trunnion::channel
