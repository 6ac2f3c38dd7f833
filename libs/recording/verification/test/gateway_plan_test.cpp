// SPDX-License-Identifier: Apache-2.0
#include "verification/gateway_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "operator_recording.hpp"

namespace trunnion::verification {
namespace {

using idl::channel::CommandKind;
using Kind = GatewayStep::Kind;

std::string text_of(const GatewayPlan& plan) {
  std::string text;
  for (const auto& step : plan.steps)
    text += step.kind == Kind::feed ? step.message->topic->handle + " "
            : step.kind == Kind::sample
                ? "sample "
                : (step.kind == Kind::ask ? "ask " : "await ") + step.request->line.target + " ";
  return text;
}

// At 20 the gateway orders, at 22 the channel replies, at 23 the line is written.
StoredRecording one_order() {
  auto recording = shown_recording();
  recording.messages.push_back(
      stored(topics::channel_request, channel_request(7, 4, CommandKind::CYCLE_START), 20));
  recording.messages.push_back(stored(topics::channel_state, channel_state(2.5), 21));
  recording.messages.push_back(stored(topics::channel_reply, channel_reply(7, 4), 22));
  recording.messages.push_back(stored(topics::operator_request, operator_line("/a", "", 7, 4, 1), 23));
  return recording;
}

TEST(GatewayPlan, ARequestIsSentWhereTheGatewayActedOnItAndAnsweredAsRecorded) {
  const auto recording = one_order();
  const auto plan = plan_gateway(recording);
  EXPECT_EQ(text_of(plan),
            "cluster parameter_set service_state channel_state sample ask /a channel_state sample ")
      << "the heartbeat of the recorded gateway is not fed";
  EXPECT_EQ(plan.outputs.instance, gateway_instance);
  ASSERT_EQ(plan.requests.size(), 1u);
  ASSERT_EQ(plan.requests[0].replies.size(), 1u);
  ASSERT_TRUE(plan.requests[0].replies[0].has_value());
  // The reply goes to whoever asks now.
  const auto now = stored(topics::channel_request, channel_request(999, 1, CommandKind::CYCLE_START), 0);
  idl::channel::ChannelReply reply;
  ASSERT_TRUE(bus::decode(addressed_to(*plan.requests[0].replies[0], now), reply));
  EXPECT_EQ(reply.client, 999u);
  EXPECT_EQ(reply.number, 1u);
  EXPECT_EQ(reply.cycle, 55u);
  EXPECT_EQ(plan.outputs.expected.size(), 2u) << "the order and the line";
}

TEST(GatewayPlan, AReplyThatCameAfterTheAnswerIsNone) {
  for (const std::uint16_t status : {202, 504}) {
    auto recording = shown_recording();
    recording.messages.push_back(
        stored(topics::channel_request, channel_request(7, 4, CommandKind::FEED_HOLD), 20));
    recording.messages.push_back(
        stored(topics::operator_request, operator_line("/a", "", 7, 4, 1, status), 23));
    recording.messages.push_back(stored(topics::channel_reply, channel_reply(7, 4), 24));
    const auto plan = plan_gateway(recording);
    ASSERT_EQ(plan.requests.size(), 1u);
    EXPECT_FALSE(plan.requests[0].replies.at(0)) << status;
  }
}

TEST(GatewayPlan, TheOrderInWhichTheRecorderHeardThingsDoesNotMatter) {
  auto recording = one_order();
  const auto straight = text_of(plan_gateway(recording));
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(recording.messages.begin(), recording.messages.end(), random);
    EXPECT_EQ(text_of(plan_gateway(recording)), straight);
  }
}

TEST(GatewayPlan, RequestsOfOthersAreNotExpectedOfTheGateway) {
  auto recording = one_order();
  recording.messages.push_back(
      stored(topics::channel_request, channel_request(8, 1, CommandKind::RESET), 30));
  EXPECT_EQ(plan_gateway(recording).outputs.expected.size(), 2u);
}

TEST(GatewayPlan, WhatAnotherProcessDoesTheSameWayIsEqualWhateverItsClients) {
  const auto recording = one_order();
  const auto plan = plan_gateway(recording);
  auto line = operator_line("/a", "", 31337, 1, 1);
  line.line = 1;
  line.address = "127.0.0.1";
  const auto order = stored(topics::channel_request, channel_request(31337, 1, CommandKind::CYCLE_START), 1);
  DiffOptions options;
  options.topics = plan.outputs.topics;
  options.ignored = plan.outputs.ignored;
  const auto compare = [&](const std::vector<StoredMessage>& written) {
    return difference(plan.outputs.expected, by_line(written, {line}, true), options);
  };
  EXPECT_TRUE(compare({order}).equal());
  EXPECT_TRUE(compare({order, order}).equal()) << "a repetition is the same request";
  const auto other = stored(topics::channel_request, channel_request(31337, 1, CommandKind::FEED_HOLD), 1);
  ASSERT_FALSE(compare({other}).equal());
  EXPECT_EQ(compare({other}).first->topic, "channel_request");
  EXPECT_EQ(compare({other}).first->field, "command");
  EXPECT_FALSE(compare({}).equal()) << "an order that is missing";
  const auto stray = stored(topics::channel_request, channel_request(5, 5, CommandKind::CYCLE_START), 2);
  EXPECT_FALSE(compare({order, stray}).equal()) << "an order that nobody asked for";
  line.status = 409;
  ASSERT_FALSE(compare({order}).equal());
  EXPECT_EQ(compare({order}).first->field, "status");
}

TEST(GatewayPlan, TheTextOfAProgramIsPutTogetherFromThePartsThatCarriedIt) {
  auto recording = shown_recording();
  const std::string text(2000, 'G');
  idl::program::ProgramRequest part{};
  part.client = 6;
  part.operation = idl::program::Operation::BEGIN_UPLOAD;
  part.number = 1;
  recording.messages.push_back(stored(topics::program_request, part, 20));
  part.operation = idl::program::Operation::WRITE;
  part.number = 2;
  part.data.assign(text.begin(), text.begin() + 1500);
  recording.messages.push_back(stored(topics::program_request, part, 21));
  part.number = 3;
  part.data.assign(text.begin() + 1500, text.end());
  recording.messages.push_back(stored(topics::program_request, part, 22));
  auto line = operator_line("/api/programs/P", text, 6, 1, 3);
  line.body.clear();
  recording.messages.push_back(stored(topics::operator_request, line, 23));
  const auto plan = plan_gateway(recording);
  ASSERT_EQ(plan.requests.size(), 1u);
  EXPECT_EQ(plan.requests[0].body, text);
  EXPECT_EQ(plan.left_out, 0u);

  auto lossy = recording;
  std::erase_if(lossy.messages, [](const StoredMessage& m) { return m.time == 22; });
  EXPECT_EQ(plan_gateway(lossy).left_out, 1u) << "half a program is not sent";
  EXPECT_TRUE(plan_gateway(lossy).requests.empty());
}

TEST(GatewayPlan, WhatNobodyWaitedForIsNotSentAgain) {
  auto recording = one_order();
  recording.messages.push_back(stored(topics::operator_request, operator_line("/gone", "", 0, 0, 0, 0), 40));
  recording.messages.push_back(
      stored(topics::operator_request, operator_line(std::string(256, 'x'), "", 0, 0, 0, 400), 41));
  const auto plan = plan_gateway(recording);
  EXPECT_EQ(plan.left_out, 2u);
  EXPECT_EQ(plan.requests.size(), 1u);
}

TEST(GatewayPlan, AnUndoFromTheJournalThatIsNotInARecordingIsNotSentAgain) {
  auto recording = one_order();
  recording.messages.push_back(
      stored(topics::operator_request, operator_line("/api/measurement/undo", "{}", 7, 5, 1), 24));
  const auto plan = plan_gateway(recording);
  EXPECT_EQ(plan.requests.size(), 1u);
  EXPECT_EQ(plan.left_out, 1u);
}

TEST(GatewayPlan, ItLooksAroundAlarmsAndEverySoOften) {
  auto recording = shown_recording();
  idl::service::Alarm alarm{};
  alarm.instance = channel_instance;
  alarm.number = 110;
  alarm.active = true;
  alarm.source = "channel";
  recording.messages.push_back(stored(topics::alarm, alarm, 20));
  recording.messages.push_back(stored(topics::channel_state, channel_state(2), 21));
  EXPECT_EQ(text_of(plan_gateway(recording)),
            "cluster parameter_set service_state channel_state sample alarm sample channel_state sample ");
  EXPECT_EQ(
      text_of(plan_gateway(recording, 2)),
      "cluster parameter_set sample service_state channel_state sample alarm sample channel_state sample ");
}

TEST(GatewayPlan, ARecordingWithNothingToShowIsRefused) {
  StoredRecording recording;
  EXPECT_THROW(plan_gateway(recording), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::verification
