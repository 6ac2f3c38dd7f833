// SPDX-License-Identifier: Apache-2.0
// Stops that are repeated, in a time of the test's own.
#include "cluster_side/request_lanes.hpp"

#include <gtest/gtest.h>

#include "contracts/topics.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::gateway {
namespace {

using idl::channel::ChannelReply;
using idl::channel::ChannelRequest;
using idl::channel::CommandKind;
using testing_support::eventually;

ChannelRequest order(CommandKind command) {
  ChannelRequest request{};
  request.command = command;
  return request;
}

class StopLanes : public testing::Test {
 protected:
  void stop(double now) {
    lanes_.submit_stop(
        order(CommandKind::FEED_HOLD),
        [this](const ChannelRequest& asked, const std::optional<ChannelReply>& reply) {
          asked_ = asked;
          answers_.push_back(reply);
        },
        now);
  }
  void pump(double from, double to) {
    for (int i = 0; from + 0.1 * i <= to; ++i) lanes_.pump(from + 0.1 * i);
  }
  void withdraw(const std::optional<ChannelReply>& otherwise = {}) {
    lanes_.withdraw([](const ChannelRequest& one) { return one.command == CommandKind::FEED_HOLD; },
                    otherwise);
  }

  bus::Bus bus_{bus::Vendor::cyclonedds, {51}};
  RequestLanes<ChannelRequest, ChannelReply> lanes_{bus_, topics::channel_request, topics::channel_reply};
  std::vector<std::optional<ChannelReply>> answers_;
  ChannelRequest asked_;
};

TEST_F(StopLanes, WhoStopsIsToldEarlyThatNobodyAnswersAndTheStopIsRepeated) {
  auto reader = bus_.reader(topics::channel_request);
  ChannelRequest heard;
  ASSERT_TRUE(eventually([&] {
    lanes_.submit(
        order(CommandKind::CYCLE_START), [](const auto&, const auto&) {}, 0, 0);
    lanes_.pump(0);
    return reader.take(heard);
  }));
  stop(1);
  pump(1, 1.25);
  EXPECT_TRUE(answers_.empty());
  pump(1.35, 10.9);
  ASSERT_EQ(answers_.size(), 1u);
  EXPECT_FALSE(answers_[0]);
  EXPECT_TRUE(lanes_.period()) << "it is repeated";
  int copies = 0;
  EXPECT_TRUE(eventually([&] {
    while (reader.take(heard)) copies += heard.command == CommandKind::FEED_HOLD ? 1 : 0;
    return copies > 30;
  })) << copies;
  pump(11.1, 11.1);
  EXPECT_FALSE(lanes_.period());
  EXPECT_EQ(answers_.size(), 1u);
}

TEST_F(StopLanes, AReplyEndsTheRepetition) {
  stop(0);
  pump(0, 1);
  ChannelReply reply{};
  reply.client = asked_.client, reply.number = asked_.number;
  EXPECT_TRUE(lanes_.answer(reply));
  lanes_.pump(1.1);
  EXPECT_FALSE(lanes_.period());
  EXPECT_EQ(answers_.size(), 1u) << "who asked has been told";
}

TEST_F(StopLanes, AStartThatFollowsWithdrawsIt) {
  stop(0);
  pump(0, 1);
  stop(1);
  ChannelReply otherwise{};
  otherwise.reason = "not repeated";
  withdraw(otherwise);
  lanes_.pump(1.1);
  EXPECT_EQ(answers_.size(), 1u) << "that of the second one may still come";
  EXPECT_TRUE(lanes_.period());
  lanes_.pump(1.4);
  EXPECT_FALSE(lanes_.period());
  ASSERT_EQ(answers_.size(), 2u);
  ASSERT_TRUE(answers_[1]);
  EXPECT_EQ(answers_[1]->reason, "not repeated");
}

// It would otherwise begin motion behind an accepted stop.
TEST_F(StopLanes, AStartThatNobodyHasAnsweredIsNotSentAgain) {
  auto reader = bus_.reader(topics::channel_request);
  ChannelRequest heard;
  ASSERT_TRUE(eventually([&] {
    lanes_.submit(
        order(CommandKind::RESET), [](const auto&, const auto&) {}, 0, 0);
    lanes_.pump(0);
    return reader.take(heard);
  }));
  std::vector<std::optional<ChannelReply>> starts;
  const auto start = [&](double now) {
    lanes_.submit(
        order(CommandKind::CYCLE_START), [&](const auto&, const auto& reply) { starts.push_back(reply); },
        now);
  };
  start(1);
  ChannelReply otherwise{};
  otherwise.reason = "not repeated";
  lanes_.cease([](const ChannelRequest& one) { return one.command == CommandKind::CYCLE_START; }, otherwise);
  stop(1);
  pump(1, 3.1);
  ASSERT_EQ(starts.size(), 1u);
  ASSERT_TRUE(starts[0]);
  EXPECT_EQ(starts[0]->reason, "not repeated");
  int sent = 0, stops = 0;
  ASSERT_TRUE(eventually([&] {
    while (reader.take(heard)) {
      sent += heard.command == CommandKind::CYCLE_START;
      stops += heard.command == CommandKind::FEED_HOLD;
    }
    return stops >= 7;  // every 0.2 s or, by rounding, 0.3 s
  }));
  EXPECT_EQ(sent, 1);
}

TEST_F(StopLanes, TheSameStopAgainTakesThePlaceOfTheRepetition) {
  for (int i = 0; i < 100; ++i) {
    withdraw();
    stop(i);
    pump(i, i + 0.5);
  }
  EXPECT_EQ(answers_.size(), 100u);
  pump(109.2, 109.2);
  EXPECT_FALSE(lanes_.period());
}

}  // namespace
}  // namespace trunnion::gateway
