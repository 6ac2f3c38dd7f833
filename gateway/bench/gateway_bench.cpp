// SPDX-License-Identifier: Apache-2.0
// What a gateway serves: reads of one parameter over connections that stay, and viewers of the stream. The
// process is real, the rest of the cluster a fake one on a thread of this program.
#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <sys/socket.h>

#include <charconv>
#include <ctime>

#include "test/gateway_fixture.hpp"

namespace trunnion::gateway {
namespace {

class Running : public Gateway {
 public:
  Running() { SetUp(); }
  ~Running() override { TearDown(); }
  void TestBody() override {}
  std::uint16_t port() const { return port_; }
  /// As many values as a machine with error tables has.
  void fill() {
    constexpr int parts = 10, of_a_part = 500;
    for (int part = 0; part < parts; ++part) {
      auto values = json::array();
      for (int i = 0; i < of_a_part; ++i)
        values.push_back({{"number", 700000 + part * of_a_part + i}, {"value", 0.001 * (i + 1)}});
      const auto answer =
          http_client::request(port_, "PUT", "/api/parameters", json{{"values", values}}.dump());
      if (answer.status != 200) throw std::runtime_error("the parameters are refused: " + answer.body);
    }
  }
  void start_program() const { post("/api/channels/0/cycle-start"); }
  /// s of a processor that the gateway has used.
  double processor() const {
    clockid_t clock{};
    timespec used{};
    if (clock_getcpuclockid(process_->pid(), &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
  }
};

/// A connection that serves many requests.
class Kept {
 public:
  explicit Kept(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
      throw std::runtime_error("the gateway does not answer");
  }
  ~Kept() { ::close(socket_); }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  /// True when the answer is 200; reads it whole.
  bool get(const std::string& target) {
    const auto request = "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
    ::send(socket_, request.data(), request.size(), MSG_NOSIGNAL);
    std::string answer;
    std::size_t whole = std::string::npos;
    while (answer.size() < whole) {
      std::array<char, 16384> part;
      const auto got = ::recv(socket_, part.data(), part.size(), 0);
      if (got <= 0) return false;
      answer.append(part.data(), static_cast<std::size_t>(got));
      const auto head = answer.find("\r\n\r\n"), length = answer.find("Content-Length: ");
      if (head == std::string::npos || length > head) continue;
      std::size_t body = 0;
      std::from_chars(&answer[length + 16], &answer[head], body);
      whole = head + 4 + body;
    }
    return answer.starts_with("HTTP/1.1 200");
  }

 private:
  int socket_;
};

void parameter_reads(benchmark::State& state) {
  static std::unique_ptr<Running> gateway;
  if (state.thread_index() == 0) {
    gateway = std::make_unique<Running>();
    gateway->fill();
  }
  std::unique_ptr<Kept>
      connection;  // made in the loop, which begins in every thread when the gateway is there
  for (auto _ : state) {
    if (!connection) connection = std::make_unique<Kept>(gateway->port());
    if (!connection->get("/api/parameters/100034")) state.SkipWithError("no answer");
  }
  state.SetItemsProcessed(state.iterations());
  connection.reset();
  if (state.thread_index() == 0) gateway.reset();
}
BENCHMARK(parameter_reads)->Threads(1)->Threads(4)->UseRealTime();

/// `viewers` streams of a machine that moves, for 5 s.
void viewers(benchmark::State& state) {
  Running gateway;
  gateway.start_program();
  std::atomic<bool> over = false;
  std::atomic<std::uint64_t> messages = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < state.range(0); ++i)
    threads.emplace_back([&] {
      http_client::WebSocketClient viewer(gateway.port(), "/api/stream");
      while (!over && viewer.next(1)) ++messages;
    });
  std::this_thread::sleep_for(std::chrono::seconds(1));
  constexpr double seconds = 5;
  double used = 0;
  std::uint64_t seen = 0;
  for (auto _ : state) {
    const auto before = gateway.processor();
    const std::uint64_t first = messages;
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    used = gateway.processor() - before;
    seen = messages - first;
  }
  over = true;
  for (auto& thread : threads) thread.join();
  state.counters["percent_of_a_core"] = 100 * used / seconds;
  if (state.range(0) > 0)
    state.counters["messages_per_s_and_viewer"] =
        static_cast<double>(seen) / seconds / static_cast<double>(state.range(0));
}
BENCHMARK(viewers)->Arg(0)->Arg(1)->Arg(50)->Iterations(1)->UseRealTime();

}  // namespace
}  // namespace trunnion::gateway
