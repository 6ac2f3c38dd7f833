// SPDX-License-Identifier: Apache-2.0
// The executable over DDS: values, activation, kill -9 and the start of another cluster.
#include <gtest/gtest.h>

#include "contracts/topics.hpp"
#include "machine/parameters.hpp"
#include "service/request.hpp"
#include "testing_support/running_service.hpp"

namespace trunnion::parameters {
namespace {

using idl::parameters::Operation;
using testing_support::eventually;
using testing_support::RunningService;
constexpr int domain = 61;

class Client {
 public:
  Client()
      : bus_(bus::Vendor::cyclonedds, {domain}),
        set_(bus_.reader(topics::parameter_set)),
        channel_(bus_.writer(topics::channel_state)),
        requests_(bus_, topics::parameter_request, topics::parameter_reply) {}

  idl::parameters::ParameterReply set(std::vector<idl::parameters::Parameter> values) {
    idl::parameters::ParameterRequest request;
    request.role = 2;  // a builder's
    request.operation = Operation::SET;
    request.values = std::move(values);
    return requests_.call(request, 10).value_or(idl::parameters::ParameterReply{});
  }
  /// Waits for the newest set that satisfies `condition`.
  template <class Condition>
  bool wait_for(Condition condition) {
    return eventually([&] {
      while (set_.take(newest)) arrived = true;
      return arrived && condition(newest);
    });
  }
  void reset_count(std::uint32_t count) {
    idl::channel::ChannelState state;
    state.reset_count = count;
    channel_.write(state);
  }
  idl::parameters::ParameterSet newest;
  bool arrived = false;

 private:
  bus::Bus bus_;
  bus::Reader<idl::parameters::ParameterSet> set_;
  bus::Writer<idl::channel::ChannelState> channel_;
  service::RequestClient<idl::parameters::ParameterRequest, idl::parameters::ParameterReply> requests_;
};

double value_of(const idl::parameters::ParameterSet& set, std::uint32_t number) {
  for (const auto& p : set.values)
    if (p.number == number) return p.value;
  return machine::Catalogue::instance().default_of(number);
}

TEST(ParameterServiceOverDds, KeepsTheActiveSetOverAKillAndActivatesAtTheNextStartOfTheCluster) {
  RunningService service(TRUNNION_PARAMETERS, "parameters", domain);
  service.write("machine/parameters.yaml", "\"100000\": X\n");
  service.write("state/cluster.boot", "first\n");
  service.start();
  {
    Client client;
    ASSERT_TRUE(client.wait_for([](const auto& set) { return set.revision == 1; }));
    // 000001 waits for a restart, 100007 for a reset; 100000 is active at once.
    const auto reply = client.set({{1, 2000, ""}, {100007, -250, ""}, {100000, 0, "Y"}});
    ASSERT_TRUE(reply.accepted) << reply.reason;
    EXPECT_EQ(reply.revision, 2u);
    EXPECT_EQ(reply.pending, 2u);
    EXPECT_FALSE(client.set({{1, 7, ""}}).accepted);
    // The first count that arrives says nothing, a later one is a reset.
    std::uint32_t count = 4;
    ASSERT_TRUE(client.wait_for([&](const auto& set) {
      client.reset_count(count++);
      return set.revision == 3;
    }));
    EXPECT_EQ(value_of(client.newest, 100007), -250);
    EXPECT_EQ(value_of(client.newest, 1), 1000);
  }
  const auto before = [&] {
    Client client;
    client.wait_for([](const auto&) { return true; });
    return client.newest;
  }();
  service.kill_hard();
  service.start();
  {
    Client client;
    ASSERT_TRUE(client.wait_for([](const auto&) { return true; }));
    EXPECT_EQ(client.newest, before);
  }
  service.kill_hard();
  service.write("state/cluster.boot", "second\n");
  service.start();
  Client client;
  ASSERT_TRUE(client.wait_for([](const auto& set) { return set.revision == 4; }));
  EXPECT_EQ(value_of(client.newest, 1), 2000);
}

TEST(ParameterServiceOverDds, ABadMachineFileEndsTheStartWithStatusOne) {
  RunningService service(TRUNNION_PARAMETERS, "parameters_bad", domain);
  service.write("machine/parameters.yaml", "\"000001\": 7\n");
  service.start();
  EXPECT_EQ(service.wait(), 1);
}

}  // namespace
}  // namespace trunnion::parameters
