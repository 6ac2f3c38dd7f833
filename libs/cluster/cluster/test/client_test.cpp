// SPDX-License-Identifier: Apache-2.0
// What a client reads of a cluster is not older than what it was answered.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <future>

#include "cluster/client.hpp"
#include "cluster/cluster_files.hpp"
#include "cluster/cluster_locks.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::cluster {
namespace {

using idl::channel::ChannelState;
using testing_support::eventually;
constexpr std::uint32_t client_domain = 65;

bool is_ready(const std::future<std::uint64_t>& answer) {
  return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

TEST(Client, GivesOfATopicWithHistoryWhatIsWrittenFromNowOn) {
  bus::Bus drive(bus::Vendor::cyclonedds, {client_domain});
  auto writer = drive.writer(topics::feedback);
  idl::stream::Feedback batch;
  for (batch.tick = 1; batch.tick <= 20; ++batch.tick) writer.write(batch);
  Client client(bus::NetworkSettings{client_domain});
  auto read = std::async(std::launch::async, [&] { return client.newest(topics::feedback).tick; });
  ASSERT_TRUE(eventually([&] { return writer.matched() == 1 || is_ready(read); }));
  ASSERT_TRUE(eventually([&] {
    writer.write(batch);
    ++batch.tick;
    return is_ready(read);
  }));
  EXPECT_GT(read.get(), 20u);
}

TEST(Client, GivesTheStateOfTheChannelThatIsAskedFor) {
  bus::Bus channels(bus::Vendor::cyclonedds, {client_domain});
  std::vector<bus::Writer<ChannelState>> writers;
  for (std::uint16_t channel = 0; channel < 2; ++channel) {
    writers.push_back(channels.writer(topics::channel_state));
    ChannelState state;
    state.channel = channel;
    writers.back().write(state);
  }
  Client client(bus::NetworkSettings{client_domain});
  for (int i = 0; i < 20; ++i)
    for (const std::uint16_t channel : {1, 0})
      EXPECT_EQ(client.newest(topics::channel_state, channel).channel, channel);
}

// The writer's one sample of a state is that of the newest reply, whatever other readers have not yet taken.
TEST(Client, GivesAStateThatIsNotOlderThanTheReply) {
  bus::Bus channel(bus::Vendor::cyclonedds, {client_domain});
  auto writer = channel.writer(topics::channel_state);
  service::RequestServer<ChannelRequest, ChannelReply> server(channel, topics::channel_request,
                                                              topics::channel_reply);
  std::atomic<bool> over = false;
  std::thread answering([&] {
    for (ChannelRequest request; !over; channel.signal().wait(0.01))
      while (server.take(request)) {
        ChannelState state;
        state.parts = request.parts;
        writer.write(state);
        server.reply(request, {0, 0, true, 0, "", 0});
      }
  });
  Client client(bus::NetworkSettings{client_domain});
  auto untaken = client.bus().reader(topics::channel_state);
  for (std::uint32_t parts = 1; parts <= 50; ++parts) {
    client.channel({.command = CommandKind::SET_PARTS, .parts = parts});
    EXPECT_EQ(client.newest(topics::channel_state, 0).parts, parts);
  }
  over = true;
  answering.join();
}

// A recording with the reply to a request that it does not have cannot be verified.
TEST(Client, WaitsForTheRecorderBeforeItsFirstRequest) {
  const RunDirectory run{client_domain};
  run.make();
  const pid_t recorder = fork();
  if (recorder == 0) {
    hold_recording(client_domain);
    for (;;) pause();
  }
  EXPECT_TRUE(eventually([] { return is_recorded(client_domain); }));

  bus::Bus channel(bus::Vendor::cyclonedds, {client_domain});
  auto clusters = channel.writer(topics::cluster);
  idl::service::Cluster cluster;
  cluster.services = {{1, "channel", 0, "", 1, 0, true}};
  clusters.write(cluster);
  service::RequestServer<ChannelRequest, ChannelReply> server(channel, topics::channel_request,
                                                              topics::channel_reply);
  Client client(bus::NetworkSettings{client_domain});
  auto answered = std::async(std::launch::async, [&] { client.channel(0, CommandKind::RESET); });
  // It reads which services there are, so it waits.
  EXPECT_TRUE(eventually([&] { return clusters.matched() == 1; }));
  ChannelRequest request, copy;
  EXPECT_FALSE(server.take(request));
  bus::Bus late(bus::Vendor::cyclonedds, {client_domain});
  auto recorded = late.reader(topics::channel_request);
  EXPECT_TRUE(eventually([&] { return server.take(request); }));
  EXPECT_TRUE(eventually([&] { return recorded.take(copy); }));
  EXPECT_EQ(copy.number, request.number);
  server.reply(request, {0, 0, true, 0, "", 0});
  answered.get();

  kill(recorder, SIGKILL);
  waitpid(recorder, nullptr, 0);
  EXPECT_FALSE(is_recorded(client_domain));
  run.remove();
}

}  // namespace
}  // namespace trunnion::cluster
