// SPDX-License-Identifier: Apache-2.0
#include "verification/repetitions.hpp"

#include <gtest/gtest.h>

#include "sample_recording.hpp"

namespace trunnion::verification {
namespace {

idl::channel::ChannelRequest request(std::uint64_t client, std::uint64_t number) {
  idl::channel::ChannelRequest made;
  made.client = client, made.number = number;
  return made;
}
idl::channel::ChannelReply reply(std::uint64_t client, std::uint64_t number) {
  idl::channel::ChannelReply made;
  made.client = client, made.number = number, made.accepted = true;
  return made;
}
std::string times(const std::vector<StoredMessage>& messages) {
  std::string text;
  for (const auto& message : messages) text += std::to_string(message.time) + " ";
  return text;
}

TEST(Repetitions, ARequestSentAgainWhileItHadNoReplyCountsOnce) {
  std::vector<StoredMessage> messages = {stored(topics::channel_request, request(70, 1), 10),
                                         stored(topics::channel_request, request(70, 1), 20),
                                         stored(topics::channel_reply, reply(70, 1), 25),
                                         stored(topics::channel_request, request(70, 2), 30),
                                         stored(topics::channel_request, request(71, 1), 31),
                                         stored(topics::channel_reply, reply(71, 1), 32)};
  drop_repetitions(messages);
  EXPECT_EQ(times(messages), "10 25 30 31 32 ");
}

TEST(Repetitions, ARequestSentAgainWhenItsReplyWasOnTheWayHasTwoRepliesThatCountOnce) {
  std::vector<StoredMessage> messages = {
      stored(topics::channel_request, request(70, 1), 10), stored(topics::channel_reply, reply(70, 1), 11),
      stored(topics::channel_request, request(70, 1), 20), stored(topics::channel_reply, reply(70, 1), 21)};
  drop_repetitions(messages);
  EXPECT_EQ(times(messages), "10 11 ");
}

// A channel says so of outputs of the PLC that it has taken, two of one tick included: nobody has asked.
TEST(Repetitions, RepliesThatNobodyAskedForAllCount) {
  std::vector<StoredMessage> messages = {stored(topics::channel_reply, reply(1, 7), 10),
                                         stored(topics::channel_reply, reply(1, 7), 11)};
  drop_repetitions(messages);
  EXPECT_EQ(times(messages), "10 11 ");
}

// The first copy was sent before the PLC read the topic.
TEST(Repetitions, TheCopyOfARequestThatTheServiceSaysItTookIsKept) {
  idl::plc::PanelRequest pressed;
  pressed.client = 70, pressed.number = 1;
  idl::stream::InputLog log;
  log.applied = {{idl::stream::Input::PANEL_REQUEST, 8, 20}};
  std::vector<StoredMessage> messages = {
      stored(topics::panel_request, pressed, 10), stored(topics::panel_request, pressed, 20),
      stored(topics::panel_request, pressed, 30), stored(topics::plc_input_log, log, 31)};
  drop_repetitions(messages);
  EXPECT_EQ(times(messages), "20 31 ");
}

}  // namespace
}  // namespace trunnion::verification
