// SPDX-License-Identifier: Apache-2.0
// Orders while the gateway sends large recordings or takes large programs.
#include <cmath>

#include "bus/codec.hpp"
#include "bus/registry.hpp"
#include "contracts/topics.hpp"
#include "gateway_fixture.hpp"
#include "held_connections.hpp"
#include "hold_times.hpp"
#include "recording/file_stream.hpp"
#include "recording/mcap_writer.hpp"

namespace trunnion::gateway {
namespace {

constexpr std::uint64_t million = 1'000'000;

/// A recording of `million` cycles of five axes on sine curves, 16 in a message.
void write_recording(const std::string& file) {
  constexpr std::uint64_t batch = 16;
  constexpr std::uint16_t axes = 5;
  recording::FileSink sink(file);
  recording::Writer writer(sink, {});
  const auto* entry = bus::find_topic(topics::feedback.name);
  const auto channel = writer.add_channel(entry->description.name, entry->type, entry->schema);
  idl::stream::Feedback feedback{};
  feedback.count = batch, feedback.axis_count = axes;
  feedback.velocity.assign(axes, 12.5), feedback.torque.assign(axes, 0.25);
  feedback.commanded.resize(batch * axes), feedback.actual.resize(batch * axes);
  for (feedback.first = 0; feedback.first < million; feedback.first += batch) {
    for (std::uint64_t i = 0; i < batch * axes; ++i) {
      const std::uint64_t row = i / axes;
      const auto cycle = static_cast<double>(feedback.first + row);
      feedback.commanded[i] = 100 * std::sin(1e-3 * cycle + static_cast<double>(i % axes));
      feedback.actual[i] = feedback.commanded[i] - 0.01;
    }
    bus::Bytes message;
    bus::encode(feedback, message);
    writer.write(channel, feedback.first, feedback.first, message);
  }
  writer.finish();
}

// The times are printed, not judged: a test runs beside others.
TEST_F(Gateway, OrdersAreAnsweredDuringThreeDownloadsOfAMillionCycles) {
  std::filesystem::create_directories(state_ + "/recordings");
  write_recording(state_ + "/recordings/million.mcap");
  const auto begun = std::chrono::steady_clock::now();
  const auto table = get("/api/recordings/million.mcap/table");
  const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - begun;
  EXPECT_EQ(table.status, 200);
  EXPECT_NE(table.body.find("\n" + std::to_string(million - 1) + ","), std::string::npos);
  EXPECT_TRUE(table.body.ends_with("\r\n0\r\n\r\n")) << "the body has its end";

  const auto alone = hold_times(port_, [n = 0]() mutable { return ++n <= 200; });
  std::atomic<int> under_way = 3;
  std::vector<std::thread> downloads;
  for (int i = 0; i < 3; ++i)
    downloads.emplace_back([&] {
      EXPECT_EQ(get("/api/recordings/million.mcap/table").status, 200);
      --under_way;
    });
  const auto busy = hold_times(port_, [&] { return under_way > 0; });
  for (auto& download : downloads) download.join();
  ASSERT_FALSE(alone.empty());
  ASSERT_FALSE(busy.empty());
  std::printf(
      "a million cycles, %zu MB as CSV: %.2f s; p99 of a hold: %.1f ms, with three downloads %.1f ms of "
      "%zu\n",
      table.body.size() >> 20, lasted.count(), p99(alone), p99(busy), busy.size());
}

/// Seconds that the thread `name` of a process has run.
double processor_time(pid_t process, const std::string& name) {
  for (const auto& thread :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::string called;
    std::getline(std::ifstream(thread.path() / "comm"), called);
    double nanoseconds = 0;
    if (called == name && std::ifstream(thread.path() / "schedstat") >> nanoseconds)
      return 1e-9 * nanoseconds;
  }
  return 0;
}

/// A body of 1 MB that is read whole and then refused: numbers are no values of parameters.
std::string large_body() {
  std::string values = R"({"values": [)";
  while (values.size() < 1'000'000) values += "0.12345678901234567,";
  return values + "0]}";
}

/// Seconds of the threads that read connections and that carry out requests.
struct ProcessorTimes {
  double connections = 0, requests = 0;
};

// What the thread that reads connections needs for bytes depends on the load of the computer, so a request is
// compared with one that has the same bytes to move and nothing to work out, in turns. Were the work done by
// that thread, it would take all of the difference.
TEST_F(Gateway, LargeBodiesAndAnswersDoNotOccupyTheThreadThatReadsTheConnections) {
  publish_4000_programs();
  const auto used = [&] {
    return ProcessorTimes{processor_time(process_->pid(), "gateway-http"),
                          processor_time(process_->pid(), "gateway-work")};
  };
  const auto dear_beside_cheap = [&](int rounds, const auto& dear, const auto& cheap) {
    ProcessorTimes more;
    for (int i = 0; i < rounds; ++i) {
      const auto before = used();
      dear();
      const auto between = used();
      cheap();
      const auto after = used();
      more.connections += 2 * between.connections - before.connections - after.connections;
      more.requests += 2 * between.requests - before.requests - after.requests;
    }
    return more;
  };
  const auto put = [&](const std::string& body) {
    EXPECT_EQ(http_client::request(port_, "PUT", "/api/parameters", body).status, 400);
  };
  const auto values = large_body(), no_json = std::string(values.size(), '}');
  const auto by_reading = dear_beside_cheap(
      30, [&] { put(values); }, [&] { put(no_json); });
  EXPECT_LT(by_reading.connections, by_reading.requests);

  const auto programs = [&](const char* header, std::size_t packed) {
    const auto answer = http_client::request(port_, "GET", "/api/programs", "", header);
    EXPECT_EQ(answer.headers.count("content-encoding"), packed);
  };
  const auto by_packing = dear_beside_cheap(
      100, [&] { programs("Accept-Encoding: gzip\r\n", 1); }, [&] { programs("", 0); });
  EXPECT_LT(by_packing.connections, by_packing.requests);
}

double resident_megabytes(pid_t process) {
  double size = 0, resident = 0;
  std::ifstream("/proc/" + std::to_string(process) + "/statm") >> size >> resident;
  return 1e-6 * resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

TEST_F(Gateway, MemoryThatLargeAnswersHeldIsGivenBack) {
  publish_4000_programs();
  const auto values = large_body();
  const auto ask = [&] {
    EXPECT_EQ(get("/api/programs").status, 200);
    EXPECT_EQ(get("/api/parameters?limit=5000").status, 200);
    EXPECT_EQ(http_client::request(port_, "PUT", "/api/parameters", values).status, 400);
  };
  const auto resident = [&] { return resident_megabytes(process_->pid()); };
  ask();
  const double before = resident();
  const std::string host = " HTTP/1.1\r\nHost: 127.0.0.1\r\n";
  for (int round = 0; round < 3; ++round) {
    HeldConnections held(port_);
    for (int i = 0; i < 100; ++i) {
      held.open("GET /api/parameters?limit=5000" + host + "\r\n");
      held.open("GET /api/stream" + host +
                "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
      if (i % 4 == 0) held.open("GET /api/programs" + host + "\r\n");
      if (i % 10 == 0) ask();
    }
    EXPECT_TRUE(eventually([&] { return resident() > 1.2 * before; })) << resident() << " of " << before;
  }
  EXPECT_TRUE(eventually([&] { return resident() < 1.1 * before; })) << resident() << " of " << before;
}

// The program service writes another program to a slow disk meanwhile.
TEST_F(Gateway, AnUploadWaitsLongerThanAnOrderForTheProgramService) {
  const std::string text(40 * million, 'N');
  Response answer;
  std::thread upload([&] {
    auto server = http_client::Server(port_);
    server.timeout = 60;
    answer = http_client::request(server, "PUT", "/api/programs/SLOW.NC", text);
  });
  EXPECT_TRUE(eventually([&] { return cluster([](auto& c) { return c.largest_write; }) > 0; }));
  cluster([](auto&) { std::this_thread::sleep_for(std::chrono::seconds(3)); });  // an order has 2 s
  upload.join();
  EXPECT_EQ(answer.status, 200) << answer.body;
}

// The times are printed, not judged: a test runs beside others.
TEST_F(Gateway, OrdersAreAnsweredDuringFourUploadsOf100Megabytes) {
  std::string text;
  while (text.size() < 100 * million) text += "G1 X" + std::to_string(text.size() % 1000) + " Y10.25 F1800\n";
  const auto alone = hold_times(port_, [n = 0]() mutable { return ++n <= 200; });
  std::atomic<int> under_way = 4;
  std::vector<std::thread> uploads;
  const auto begun = std::chrono::steady_clock::now();
  for (int i = 0; i < 4; ++i)
    uploads.emplace_back([&, i] {
      auto server = http_client::Server(port_);
      server.timeout = 60;  // the other side takes it all before it answers
      EXPECT_EQ(
          http_client::request(server, "PUT", "/api/programs/U" + std::to_string(i) + ".NC", text).status,
          200);
      --under_way;
    });
  // While all four go on: the fake cluster counts the lines of what is complete, and answers nobody
  // meanwhile.
  const auto busy = hold_times(port_, [&] { return under_way == 4; });
  for (auto& upload : uploads) upload.join();
  const std::chrono::duration<double> lasted = std::chrono::steady_clock::now() - begun;
  ASSERT_FALSE(alone.empty());
  ASSERT_FALSE(busy.empty());
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(cluster([&](auto& c) { return c.programs["U" + std::to_string(i) + ".NC"].size(); }),
              text.size());
  std::printf("four uploads of 100 MB: %.1f s; p99 of a hold: %.1f ms, with them %.1f ms of %zu\n",
              lasted.count(), p99(alone), p99(busy), busy.size());
}

}  // namespace
}  // namespace trunnion::gateway
