// SPDX-License-Identifier: Apache-2.0
// The stream of the gateway, and connections that others hold.
#include <set>

#include "gateway_fixture.hpp"
#include "held_connections.hpp"

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

/// What the gateway answers to an order by a stream.
json answer_by(WebSocketClient& client, const json& order) {
  client.send(order.dump());
  for (int i = 0; i < 100; ++i) {
    const auto text = client.next();
    if (!text) break;
    const auto message = json::parse(*text);
    if (message.contains("answer")) return message;
  }
  return {{"answer", nullptr}, {"status", 0}};
}

// The delays are printed, not judged: a test runs beside others.
TEST_F(Gateway, AThousandHeldConnectionsDoNotBlockAStop) {
  const std::string host = " HTTP/1.1\r\nHost: 127.0.0.1\r\n";
  const std::string text(8 << 20, ' ');  // more than the kernel takes for one that does not read
  ASSERT_EQ(http_client::request(port_, "PUT", "/api/programs/LARGE.NC", text).status, 200);
  WebSocketClient stream(port_, "/api/stream");
  ASSERT_TRUE(stream.open());
  cluster([](auto& c) { c.channel_is_silent = true; });
  HeldConnections held(port_);
  double by_request = 0, by_stream = 0;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 10; ++i) {
      held.open("");
      held.open("POST /api/panel/emergency-stop HTTP/1.1\r\nHo");
      held.open("PUT /api/programs/A" + std::to_string(10 * round + i) + ".NC" + host +
                "Content-Length: 100000\r\n\r\nG0");
      held.open("GET /api/programs/LARGE.NC" + host + "\r\n");
      held.open("POST /api/channels/0/cycle-start" + host + "Content-Length: 2\r\n\r\n{}");
    }
    by_request = std::max(by_request,
                          milliseconds_of([&] { EXPECT_EQ(post("/api/panel/emergency-stop").status, 200); }));
    by_stream = std::max(
        by_stream, milliseconds_of([&] {
          const auto answer = answer_by(stream, {{"order", round}, {"path", "/api/panel/emergency-stop"}});
          EXPECT_EQ(answer["status"], 200);
        }));
  }
  std::printf(
      "largest delay of a stop among 1,000 held connections: %.1f ms by a new one, %.1f ms by a stream\n",
      by_request, by_stream);
}

TEST_F(Gateway, OrdersThatAreBeingAnsweredDoNotShutOutAStopAndAreActedOn) {
  constexpr std::size_t orders = 300;  // more than may be at work, and than connections there are
  cluster([](auto& c) { c.channel_is_silent = true; });
  HeldConnections held(port_);
  for (std::size_t i = 0; i < orders; ++i)
    held.open("POST /api/channels/0/cycle-start HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 2\r\n\r\n{}");
  EXPECT_EQ(post("/api/panel/emergency-stop").status, 200);
  const auto arrived = [&] {
    return cluster([](auto& c) {
      std::set<std::pair<std::uint64_t, std::uint64_t>> different;  // they are sent again while none answers
      for (const auto& request : c.channel_requests) different.emplace(request.client, request.number);
      return different.size();
    });
  };
  EXPECT_TRUE(eventually([&] { return arrived() == orders; })) << arrived();
}

/// Whether a stream ends: it has a message four times a second until then.
bool ends(WebSocketClient& stream) {
  return eventually([&] { return !stream.next(); });
}

TEST_F(Gateway, TheOldestStreamOfThePeerWithMostGivesWayToANewOne) {
  http_client::Server from_elsewhere(port_);
  from_elsewhere.source = "127.0.0.2";
  WebSocketClient page(from_elsewhere, "/api/stream");
  std::vector<std::unique_ptr<WebSocketClient>> streams;
  for (int i = 0; i < 128; ++i) {  // with that of the page one more than there may be
    streams.push_back(std::make_unique<WebSocketClient>(port_, "/api/stream"));
    EXPECT_TRUE(streams.back()->open());
  }
  EXPECT_TRUE(ends(*streams.front()));
  EXPECT_EQ(answer_by(*streams.back(), {{"order", 1}, {"path", "/api/panel/emergency-stop"}})["status"], 200);
  EXPECT_EQ(answer_by(page, {{"order", 2}, {"path", "/api/panel/emergency-stop"}})["status"], 200);
}

/// The process may open `more` files than it has. One that it was given by whoever started it may have a high
/// number, so the free ones are counted.
void limit_files(pid_t process, rlim_t more) {
  std::set<rlim_t> used;
  for (const auto& file : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/fd"))
    used.insert(std::stoul(file.path().filename()));
  rlim_t limit = 0;
  for (; more > 0; ++limit)
    if (!used.contains(limit)) --more;
  const rlimit files{limit, limit};
  ASSERT_EQ(prlimit(process, RLIMIT_NOFILE, &files, nullptr), 0);
}

TEST_F(Gateway, ConnectionsThatHoldTheFileDescriptorsGiveWayToAStop) {
  limit_files(process_->pid(), 24);
  HeldConnections held(port_);
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 20; ++i) {
      held.open("");
      held.open("POST /api/panel/emergency-stop HTTP/1.1\r\nHo");
      held.open(
          "GET /api/stream HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
          "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    }
    EXPECT_EQ(post("/api/panel/emergency-stop").status, 200);
    EXPECT_EQ(get("/").status, 200) << "a file of the page is opened, too";
  }
}

// A download holds its file beside its connection, so the reserve shrinks by one with each.
TEST_F(Gateway, DownloadsThatHoldTheFileDescriptorsGiveWayToThePage) {
  std::filesystem::create_directories(state_ + "/recordings");
  std::ofstream(state_ + "/recordings/large.mcap") << std::string(8 << 20, ' ');  // the kernel takes less
  limit_files(process_->pid(), 24);
  HeldConnections held(port_);
  for (int i = 0; i < 24; ++i) held.open("");
  for (int i = 0; i < 24; ++i) {
    held.open("GET /api/recordings/large.mcap HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    EXPECT_EQ(get("/").status, 200) << "beside " << i << " downloads";
  }
  EXPECT_EQ(post("/api/panel/emergency-stop").status, 200);
}

TEST_F(Gateway, AStopComesByTheStreamWithoutANewConnection) {
  WebSocketClient client(port_, "/api/stream");
  ASSERT_TRUE(client.open());
  const auto answer_to = [&](const json& order) { return answer_by(client, order); };
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
