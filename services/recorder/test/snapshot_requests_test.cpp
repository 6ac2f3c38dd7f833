// SPDX-License-Identifier: Apache-2.0
#include "snapshot_requests.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace trunnion::recorder {
namespace {

using Due = SnapshotRequests::Due;
using News = SnapshotRequests::News;
using Names = std::vector<std::string>;

constexpr std::uint32_t parameters = 3, kinematics = 4;

idl::service::Cluster list_of(const std::vector<std::pair<std::uint32_t, std::string>>& services) {
  idl::service::Cluster cluster;
  for (const auto& [instance, name] : services) {
    idl::service::ClusterService service;
    service.instance = instance;
    service.service = name;
    service.pid = 1000;
    cluster.services.push_back(service);
  }
  return cluster;
}

idl::service::ServiceSnapshot answer(std::uint32_t instance, std::uint64_t time) {
  idl::service::ServiceSnapshot snapshot;
  snapshot.instance = instance;
  snapshot.time = time;
  snapshot.parts = 1;
  return snapshot;
}

// Two services that were asked at second 10 of the recorder, source time 100.
class AskedServices : public testing::Test {
 protected:
  AskedServices() {
    requests.expect(list_of({{parameters, "parameters"}, {kinematics, "kinematics"}}), 9);
    EXPECT_TRUE(requests.owing().empty()) << "nobody was asked";
    requests.ask_at(10);
    EXPECT_EQ(requests.due(9.9, 99), Due::nothing);
    EXPECT_EQ(requests.due(10, 100), Due::request);
  }
  SnapshotRequests requests;
};

TEST_F(AskedServices, OweTheirStateUntilTheyHaveAnswered) {
  EXPECT_EQ(requests.owing(), (Names{"parameters", "kinematics"}));
  requests.take(answer(kinematics, 101));
  EXPECT_FALSE(requests.answered());
  EXPECT_EQ(requests.owing(), Names{"parameters"});
  requests.take(answer(parameters, 102));
  EXPECT_TRUE(requests.answered());
  for (double now = 10; now < 1000; now += 1) EXPECT_EQ(requests.due(now, 1000), Due::nothing);
  EXPECT_TRUE(requests.take_news(1000).empty());
}

TEST_F(AskedServices, AnswerWithAWholeStateThatIsNotOlderThanTheRequest) {
  requests.take(answer(parameters, 99));
  auto part = answer(parameters, 101);
  part.parts = 2;
  requests.take(part);
  EXPECT_EQ(requests.owing(), (Names{"parameters", "kinematics"}));
  part.part = 1;
  requests.take(part);
  EXPECT_EQ(requests.owing(), Names{"kinematics"});
}

// After 0.5, 1, 2, 4 and then every 8 seconds.
TEST_F(AskedServices, AreAskedAgainForAsLongAsOneIsSilent) {
  requests.take(answer(kinematics, 101));
  std::vector<double> asked;
  for (double now = 10; now <= 43; now += 0.25)
    if (requests.due(now, 200) == Due::repetition) asked.push_back(now - 10);
  EXPECT_EQ(asked, (std::vector<double>{0.5, 1.5, 3.5, 7.5, 15.5, 23.5, 31.5}));
  EXPECT_EQ(requests.number(), 1u) << "it is the same request";
}

TEST_F(AskedServices, AreNamedOnceWhenTheyAreLateAndOnceWhenTheyAnswer) {
  requests.take(answer(kinematics, 101));
  EXPECT_TRUE(requests.take_news(24.9).empty());
  EXPECT_EQ(requests.take_news(25), (std::vector<News>{{"parameters", false}}));
  EXPECT_TRUE(requests.take_news(60).empty());
  requests.take(answer(parameters, 200));
  EXPECT_EQ(requests.take_news(61), (std::vector<News>{{"parameters", true}}));
  EXPECT_TRUE(requests.take_news(100).empty());
}

// A flight recorder asks every few seconds.
TEST_F(AskedServices, AreLateFromTheFirstRequestThatTheyHaveNotAnswered) {
  for (double now = 12; now < 25; now += 2) {
    requests.ask_at(now);
    EXPECT_EQ(requests.due(now, 200), Due::request);
    requests.take(answer(kinematics, 201));
  }
  EXPECT_EQ(requests.take_news(25), (std::vector<News>{{"parameters", false}}));
}

TEST_F(AskedServices, AreAllAskedAgainWhenAnotherProcessComes) {
  requests.take(answer(kinematics, 101));
  requests.take(answer(parameters, 101));
  requests.see_process(99, 20);
  EXPECT_EQ(requests.due(25, 250), Due::nothing) << "it was asked";
  requests.see_process(260, 26);
  EXPECT_EQ(requests.due(26.5, 265), Due::nothing) << "it does not read requests yet";
  EXPECT_EQ(requests.due(27, 270), Due::request);
  EXPECT_EQ(requests.owing(), (Names{"parameters", "kinematics"}));
}

TEST_F(AskedServices, OweNothingWhenTheListHasThemNoMore) {
  requests.expect(list_of({{kinematics, "kinematics"}, {7, "plc"}}), 12);
  EXPECT_EQ(requests.owing(), (Names{"kinematics", "plc"}));
  auto ended = list_of({{kinematics, "kinematics"}});
  ended.services[0].pid = 0;
  requests.expect(ended, 13);
  EXPECT_TRUE(requests.answered());
}

TEST(SnapshotRequests, NamesTheInstanceOfServicesWithOneName) {
  SnapshotRequests requests;
  requests.expect(list_of({{1, "channel"}, {2, "channel"}, {3, "drive"}}), 0);
  requests.ask_at(0);
  requests.due(0, 1);
  EXPECT_EQ(requests.owing(), (Names{"channel (instance 1)", "channel (instance 2)", "drive"}));
}

TEST_F(AskedServices, HaveTakenWhatTheSlowestOfThemHas) {
  auto first = answer(kinematics, 101), second = answer(parameters, 101);
  first.taken = {{"path", 50}};
  second.taken = {{"path", 40}};
  requests.take(first);
  EXPECT_TRUE(requests.has_taken("path", 45));
  requests.take(second);
  EXPECT_FALSE(requests.has_taken("path", 45));
  EXPECT_TRUE(requests.has_taken("path", 40));
  EXPECT_TRUE(requests.has_taken("another", 1000)) << "nobody reads it";
}

}  // namespace
}  // namespace trunnion::recorder
