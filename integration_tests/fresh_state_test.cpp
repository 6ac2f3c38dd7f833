// SPDX-License-Identifier: Apache-2.0
// Who has a reply sees no older state.
#include "cluster_harness.hpp"

namespace trunnion::integration {
namespace {

TEST(FreshState, AChannelPublishesWhatFollowsFromARequestBeforeItsReply) {
  Cluster cluster("two-channel");
  for (const std::uint16_t channel : {0, 1}) ASSERT_TRUE(cluster.newer_state(channel));
  for (std::uint32_t i = 1; i <= 200; ++i)
    for (const std::uint16_t channel : {0, 1}) {
      cluster.client().channel({.channel = channel, .command = CommandKind::SET_PARTS, .parts = i});
      cluster.drain();
      ASSERT_EQ(cluster.channels[channel].parts, i) << "channel " << channel << ", request " << i;
    }
}

TEST(FreshState, AStartedProgramIsNotIdleUntilItHasEnded) {
  Cluster cluster("two-channel");
  cluster.client().set_mode(0, Mode::MDI);
  for (int i = 1; i <= 20; ++i) {
    cluster.client().mdi(0, "G0 X" + std::to_string(i % 2 * 10));
    auto states = cluster.client().reader_from_now(topics::channel_state);
    idl::channel::ChannelState state;
    ASSERT_TRUE(cluster.until([&] {
      while (states.take(state))
        if (state.channel == 0 && state.state == RunState::IDLE) return true;
      return false;
    }));
    EXPECT_NEAR(state.workpiece[0], i % 2 * 10, 0.1) << "line " << i;
  }
}

}  // namespace
}  // namespace trunnion::integration
