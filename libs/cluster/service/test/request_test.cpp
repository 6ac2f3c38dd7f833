// SPDX-License-Identifier: Apache-2.0
#include "service/request.hpp"

#include <gtest/gtest.h>

#include "testing_support/eventually.hpp"

namespace trunnion::service {
namespace {

using idl::plc::PanelReply;
using idl::plc::PanelRequest;
using testing_support::eventually;

class Requests : public testing::Test {
 protected:
  Requests() {
    EXPECT_TRUE(eventually([&] { return requests_.matched() == 1 && replies_.matched() == 1; }));
  }
  void send(std::uint64_t client, std::uint64_t number) {
    PanelRequest request;
    request.client = client, request.number = number;
    requests_.write(request);
  }
  /// Takes once what has arrived; true when it is a request that was not seen before.
  bool take(PanelRequest& request) {
    bool taken = false;
    return eventually([&] { return taken = server_.take(request); }) && taken;
  }
  void answer(const PanelRequest& request, bool accepted) {
    PanelReply reply;
    reply.accepted = accepted;
    server_.reply(request, reply);
  }
  /// The next reply; false when none comes.
  bool next(PanelReply& reply) {
    return eventually([&] { return replies_.take(reply); });
  }

  bus::Bus bus_{bus::Vendor::cyclonedds, {66}};
  RequestServer<PanelRequest, PanelReply> server_{bus_, topics::panel_request, topics::panel_reply};
  bus::Writer<PanelRequest> requests_ = bus_.writer(topics::panel_request);
  bus::Reader<PanelReply> replies_ = bus_.reader(topics::panel_reply);
};

TEST_F(Requests, ARequestIsAnsweredToItsClientAndNumber) {
  send(11, 5);
  PanelRequest request;
  ASSERT_TRUE(take(request));
  answer(request, true);
  PanelReply reply;
  ASSERT_TRUE(next(reply));
  EXPECT_EQ(reply.client, 11u);
  EXPECT_EQ(reply.number, 5u);
  EXPECT_TRUE(reply.accepted);
}

TEST_F(Requests, ARepeatedRequestIsAppliedOnceAndAnsweredAgain) {
  send(11, 1);
  PanelRequest request;
  ASSERT_TRUE(take(request));
  answer(request, true);
  PanelReply reply;
  ASSERT_TRUE(next(reply));
  send(11, 1);
  ASSERT_TRUE(eventually([&] {
    PanelRequest again;
    EXPECT_FALSE(server_.take(again)) << "it has been applied";
    return replies_.take(reply);
  }));
  EXPECT_EQ(reply.number, 1u);
  EXPECT_TRUE(reply.accepted);
}

TEST_F(Requests, OneThatIsRepeatedBeforeItsAnswerIsNotTakenTwice) {
  send(11, 1);
  PanelRequest request, other;
  ASSERT_TRUE(take(request));
  send(11, 1);
  send(12, 1);
  ASSERT_TRUE(take(other));
  EXPECT_EQ(other.client, 12u) << "the repetition came before it";
  answer(request, false);
  answer(other, true);
  PanelReply first, second;
  ASSERT_TRUE(next(first) && next(second));
  EXPECT_NE(first.client, second.client) << "one answer for each";
}

TEST_F(Requests, ALateOldRequestIsIgnored) {
  send(11, 8);
  PanelRequest request;
  ASSERT_TRUE(take(request));
  answer(request, true);
  send(11, 7);
  send(11, 9);
  ASSERT_TRUE(take(request));
  EXPECT_EQ(request.number, 9u);
}

TEST_F(Requests, ManyClientsDoNotFillTheMemoryAndTheNewestIsKept) {
  PanelRequest request;
  for (std::uint64_t client = 1; client <= 300; ++client) {
    send(client, 1);
    ASSERT_TRUE(take(request));
    ASSERT_EQ(request.client, client);
    answer(request, true);
  }
  PanelReply reply;
  while (replies_.take(reply)) {
  }
  send(300, 1);
  EXPECT_TRUE(eventually([&] {
    PanelRequest again;
    EXPECT_FALSE(server_.take(again));
    return replies_.take(reply) && reply.client == 300;
  }));
}

TEST_F(Requests, AClientGetsItsOwnAnswerAndRepeatsWhatIsNotAnswered) {
  RequestClient<PanelRequest, PanelReply> client(bus_, topics::panel_request, topics::panel_reply),
      other(bus_, topics::panel_request, topics::panel_reply);
  client.send({});
  EXPECT_TRUE(client.busy());
  PanelRequest first, request;
  ASSERT_TRUE(take(first));
  other.send({});
  ASSERT_TRUE(take(request));
  answer(request, false);  // the other's answer comes first
  ASSERT_TRUE(eventually([&] { return other.poll().has_value(); }));
  EXPECT_FALSE(client.poll().has_value());
  answer(first, true);
  std::optional<PanelReply> reply;
  ASSERT_TRUE(eventually([&] {
    PanelRequest repeated;
    EXPECT_FALSE(server_.take(repeated)) << "what the client sends again is known";
    return (reply = client.poll()).has_value();
  }));
  EXPECT_TRUE(reply->accepted);
  EXPECT_FALSE(client.busy());
}

TEST_F(Requests, AClientSaysWhetherWhoeverIsSilentIsConnected) {
  RequestClient<PanelRequest, PanelReply> heard(bus_, topics::panel_request, topics::panel_reply);
  EXPECT_TRUE(eventually([&] { return heard.connected() == 1; }));
  EXPECT_EQ(silence("the PLC", 15, heard.connected()),
            "the PLC does not answer within 15 s: it is connected");
  using idl::program::ProgramReply;
  using idl::program::ProgramRequest;
  RequestClient<ProgramRequest, ProgramReply> alone(bus_, topics::program_request, topics::program_reply);
  const auto recorder = bus_.reader(topics::program_request);
  EXPECT_EQ(alone.connected(), 0) << "who only reads requests answers none";
  EXPECT_EQ(silence("the program service", 0.5, 0),
            "the program service does not answer within 0.5 s: it is not connected, see `trunnion status`");
  EXPECT_EQ(silence("channel 1", 15, 2),
            "channel 1 does not answer within 15 s: 2 of its kind are connected");
}

}  // namespace
}  // namespace trunnion::service
