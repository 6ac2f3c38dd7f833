// SPDX-License-Identifier: Apache-2.0
// The stream of the gateway, and connections that others hold.
#include <arpa/inet.h>
#include <sys/socket.h>

#include "gateway_fixture.hpp"

namespace trunnion::gateway {
namespace {

using http_client::WebSocketClient;

TEST_F(Gateway, TheStreamIsTheStateAndThenItsChanges) {
  WebSocketClient client(port_, "/api/stream");
  ASSERT_TRUE(client.open());
  auto first = json::parse(client.next().value());
  ASSERT_TRUE(first.contains("state"));
  auto state = first["state"];
  EXPECT_EQ(state["channels"]["0"]["program"], "CIRCLE.NC");
  std::uint64_t sequence = first["sequence"];
  EXPECT_EQ(post("/api/channels/0/cycle-start").status, 200);
  bool running = false;
  for (int i = 0; i < 60 && !running; ++i) {
    const auto message = json::parse(client.next().value());
    ASSERT_EQ(message["since"], sequence);
    sequence = message["sequence"];
    EXPECT_FALSE(message["changes"].contains("cluster")) << "only what changed is sent";
    state.merge_patch(message["changes"]);
    running = state["channels"]["0"]["state"] == "RUNNING";
  }
  EXPECT_TRUE(running);
}

TEST_F(Gateway, AClientThatDoesNotReadGetsNewerStatesAndNotAQueue) {
  EXPECT_EQ(post("/api/channels/0/cycle-start").status, 200);
  WebSocketClient client(port_, "/api/stream", 4096);
  ASSERT_TRUE(client.open());
  auto first = json::parse(client.next().value());
  auto state = first["state"];
  std::uint64_t sequence = first["sequence"], widest = 0;
  // While it does not read, the gateway goes on answering others.
  for (int i = 0; i < 80; ++i) {
    EXPECT_EQ(get("/api/status").status, 200);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  for (int i = 0; i < 400 && widest < 20; ++i) {
    const auto message = json::parse(client.next().value());
    ASSERT_EQ(message["since"], sequence) << "the chain of changes stays whole";
    widest = std::max(widest, message["sequence"].get<std::uint64_t>() - sequence);
    sequence = message["sequence"];
    state.merge_patch(message["changes"]);
  }
  EXPECT_GE(widest, 20u) << "one message brings the client over all it missed";
  const auto now = cluster([](auto& c) { return c.channel.cycle; });
  EXPECT_NEAR(state["channels"]["0"]["cycle"].get<double>(), static_cast<double>(now), 2000)
      << "and it is new";
}

/// A connection on which nothing, or the beginning of a request, is sent.
int half_open(std::uint16_t port, const std::string& begin) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  EXPECT_EQ(::send(fd, begin.data(), begin.size(), MSG_NOSIGNAL), static_cast<ssize_t>(begin.size()));
  return fd;
}

TEST_F(Gateway, OpenConnectionsDoNotBlockAStop) {
  std::vector<int> held;
  // More than the gateway keeps: silent ones, halves of headers, and uploads that never go on.
  for (int i = 0; i < 150; ++i) held.push_back(half_open(port_, ""));
  for (int i = 0; i < 150; ++i)
    held.push_back(half_open(port_, "POST /api/panel/emergency-stop HTTP/1.1\r\nHo"));
  for (int i = 0; i < 150; ++i)
    held.push_back(
        half_open(port_, "PUT /api/programs/A" + std::to_string(i) +
                             ".NC HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 100000\r\n\r\nG0"));
  EXPECT_EQ(post("/api/panel/emergency-stop").status, 200);
  EXPECT_EQ(post("/api/channels/0/feed-hold").status, 200);
  for (const int fd : held) ::close(fd);
}

TEST_F(Gateway, AStopComesByTheStreamWithoutANewConnection) {
  WebSocketClient client(port_, "/api/stream");
  ASSERT_TRUE(client.open());
  const auto answer_to = [&](const json& order) {
    client.send(order.dump());
    for (int i = 0; i < 100; ++i) {
      const auto message = json::parse(client.next().value());
      if (message.contains("answer")) return message;
    }
    return json();
  };
  auto answer = answer_to({{"order", 7}, {"path", "/api/panel/emergency-stop"}});
  EXPECT_EQ(answer["answer"], 7);
  EXPECT_EQ(answer["status"], 200);
  EXPECT_EQ(answer["body"]["accepted"], true);
  answer = answer_to({{"order", 8}, {"path", "/api/channels/0/feed-hold"}, {"body", json::object()}});
  EXPECT_EQ(answer["status"], 200);
  EXPECT_EQ(answer_to({{"order", 9}, {"path", "/api/channels/0/feed-hold"}, {"body", 3}})["status"], 400);
  EXPECT_EQ(answer_to({{"order", 10}, {"path", "/api/channels/0/cycle-start"}})["status"], 404);
  EXPECT_EQ(answer_to({{"order", 11}, {"path", 5}})["status"], 404);
  // What is no order is passed over.
  for (const char* text : {"", "{", "[]", "null", "{\"path\":1}"}) client.send(text);
  EXPECT_EQ(answer_to({{"order", 12}, {"path", "/api/panel/emergency-stop"}})["answer"], 12);
}

}  // namespace
}  // namespace trunnion::gateway
