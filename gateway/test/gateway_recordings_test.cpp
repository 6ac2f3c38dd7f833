// SPDX-License-Identifier: Apache-2.0
// Recordings over HTTP, with the real recorder.
#include <gmock/gmock.h>

#include "core/compression.hpp"
#include "gateway_fixture.hpp"
#include "gunzip.hpp"
#include "held_connections.hpp"

namespace trunnion::gateway {
namespace {

using testing::HasSubstr;

class GatewayRecordings : public Gateway {
 protected:
  json list() const { return json::parse(get("/api/recordings").body); }
  json entry(const std::string& name) const {
    const auto all = list();
    for (const auto& one : all["recordings"])
      if (one["name"] == name) return one;
    return nullptr;
  }
  Response remove(const std::string& name, const std::string& headers = "") const {
    return http_client::request(port_, "DELETE", "/api/recordings/" + name, "", headers);
  }
  /// Records until there are cycles in the file.
  void record(const std::string& name) {
    const auto started = post("/api/recordings", {{"name", name}});
    ASSERT_EQ(started.status, 200) << started.body;
    EXPECT_EQ(list()["recording"], name);
    EXPECT_EQ(entry(name)["recording"], true);
    const auto cycles = [&] { return cluster([](auto& c) { return c.channel.cycle; }); };
    const auto before = cycles();
    ASSERT_TRUE(eventually([&] { return cycles() > before + 300; }));
    const auto stopped = post("/api/recordings/" + name + "/stop");
    EXPECT_EQ(stopped.status, 200) << stopped.body;
    EXPECT_EQ(list()["recording"], "");
  }
};

/// Of a body in chunks: a size in hexadecimal, a line end, so many bytes, a line end; size 0 is the end.
std::string without_chunks(const std::string& body) {
  std::string text;
  for (std::size_t at = 0; at < body.size();) {
    std::size_t digits = 0;
    const auto size = std::stoull(body.substr(at), &digits, 16);
    at += digits + 2;
    if (size == 0) return text;
    text += body.substr(at, size);
    at += size + 2;
  }
  ADD_FAILURE() << "the body has no end";
  return text;
}

TEST_F(GatewayRecordings, AreStartedStoppedReadAndDeleted) {
  EXPECT_EQ(list()["recordings"], json::array());
  record("first.mcap");
  const auto recorded = entry("first.mcap");
  const auto size = recorded["size"].get<std::size_t>();
  ASSERT_GT(size, 1000u);

  const auto whole = get("/api/recordings/first.mcap");
  ASSERT_EQ(whole.status, 200);
  ASSERT_EQ(whole.body.size(), size);
  EXPECT_EQ(whole.body.substr(1, 4), "MCAP");
  EXPECT_EQ(whole.body.substr(size - 7, 4), "MCAP") << "the file is whole";
  EXPECT_EQ(whole.headers.at("etag"), recorded["etag"]);
  EXPECT_EQ(whole.headers.at("accept-ranges"), "bytes");

  const auto ranged = [&](const std::string& headers) {
    return http_client::request(port_, "GET", "/api/recordings/first.mcap", "", headers);
  };
  const auto part = ranged("Range: bytes=100-299\r\n");
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, whole.body.substr(100, 200));
  EXPECT_EQ(part.headers.at("content-range"), "bytes 100-299/" + std::to_string(size));
  EXPECT_EQ(ranged("Range: bytes=-10\r\n").body, whole.body.substr(size - 10));
  const auto outside = ranged("Range: bytes=" + std::to_string(size) + "-\r\n");
  EXPECT_EQ(outside.status, 416);
  EXPECT_EQ(outside.headers.at("content-range"), "bytes */" + std::to_string(size));
  EXPECT_EQ(ranged("Range: bytes=0-9\r\nIf-Range: \"another\"\r\n").status, 200);
  EXPECT_EQ(ranged("Range: bytes=0-9\r\nIf-Range: " + recorded["etag"].get<std::string>() + "\r\n").status,
            206);

  EXPECT_EQ(remove("first.mcap").status, 428) << "a deletion names what it deletes";
  EXPECT_EQ(remove("first.mcap", "If-Match: \"another\"\r\n").status, 412);
  EXPECT_EQ(remove("first.mcap", "If-Match: " + recorded["etag"].get<std::string>() + "\r\n").status, 200);
  EXPECT_EQ(get("/api/recordings/first.mcap").status, 404);
  EXPECT_EQ(list()["recordings"], json::array());
}

TEST_F(GatewayRecordings, AreShownAsATableOfTheExecutedCycles) {
  record("table.mcap");
  const auto table = get("/api/recordings/table.mcap/table");
  ASSERT_EQ(table.status, 200);
  EXPECT_THAT(table.headers.at("content-type"), HasSubstr("text/csv"));
  EXPECT_THAT(without_chunks(table.body).substr(0, 19), "cycle,commanded[0],");
  std::istringstream lines(without_chunks(table.body));
  std::string line;
  std::getline(lines, line);
  std::uint64_t last = 0, count = 0;
  while (std::getline(lines, line)) {
    const auto cycle = std::stoull(line);
    if (count > 0) {
      EXPECT_EQ(cycle, last + 1);
    }
    ++count;
    last = cycle;
  }
  EXPECT_GT(count, 200u);
}

TEST_F(GatewayRecordings, OneRunsAtATimeAndNothingIsOverwritten) {
  ASSERT_EQ(post("/api/recordings", {{"name", "running.mcap"}, {"topics", {"feedback"}}}).status, 200);
  const auto second = post("/api/recordings");
  EXPECT_EQ(second.status, 409);
  EXPECT_THAT(second.body, HasSubstr("running.mcap is being recorded"));
  const auto etag = entry("running.mcap")["etag"].get<std::string>();
  EXPECT_EQ(remove("running.mcap", "If-Match: " + etag + "\r\n").status, 409);
  EXPECT_EQ(post("/api/recordings/running.mcap/stop").status, 200);
  EXPECT_EQ(post("/api/recordings/running.mcap/stop").status, 409);
  const auto again = post("/api/recordings", {{"name", "running.mcap"}});
  EXPECT_EQ(again.status, 409);
  EXPECT_THAT(again.body, HasSubstr("exists already"));
}

TEST_F(GatewayRecordings, RefusesWhatIsNoRecording) {
  for (const char* body : {R"({"name":"../x.mcap"})", R"({"name":"x"})", R"({"name":3})", R"({"duration":0})",
                           R"({"duration":"1"})", R"({"topics":[]})", R"({"topics":["nothing"]})",
                           R"({"topics":"feedback"})", R"({"other":1})", "{"})
    EXPECT_EQ(http_client::request(port_, "POST", "/api/recordings", body).status, 400) << body;
  for (const char* target :
       {"/api/recordings/none.mcap", "/api/recordings/..%2Fstderr.txt", "/api/recordings/none.mcap/table"})
    EXPECT_EQ(get(target).status, 404) << target;
  std::filesystem::create_directories(state_ + "/recordings");
  std::ofstream(state_ + "/recordings/nonsense.mcap") << "nonsense";
  EXPECT_EQ(get("/api/recordings/nonsense.mcap").body, "nonsense");
  const auto table = get("/api/recordings/nonsense.mcap/table");
  EXPECT_EQ(table.status, 409);
  EXPECT_THAT(table.body, HasSubstr("nonsense.mcap"));
}

TEST_F(GatewayRecordings, ALargeOneThatIsReadSlowlyDelaysNoOrder) {
  std::filesystem::create_directories(state_ + "/recordings");
  std::ofstream(state_ + "/recordings/large.mcap") << "";
  std::filesystem::resize_file(state_ + "/recordings/large.mcap", 3ull << 30);  // sparse
  // Eight clients that ask for 3 GiB and read none of it.
  std::vector<std::unique_ptr<http_client::WebSocketClient>> slow;
  for (int i = 0; i < 8; ++i)
    slow.push_back(std::make_unique<http_client::WebSocketClient>(port_, "/api/recordings/large.mcap", 4096));
  for (int i = 0; i < 20; ++i) EXPECT_EQ(post("/api/channels/0/feed-hold").status, 200);
  const auto last =
      http_client::request(port_, "GET", "/api/recordings/large.mcap", "", "Range: bytes=-5\r\n");
  EXPECT_EQ(last.body, std::string(5, '\0'));
}

TEST_F(Gateway, CompressesLongAnswersAndThePageForThoseWhoPermitIt) {
  const auto with = [&](const std::string& target, const std::string& coding) {
    return http_client::request(port_, "GET", target, "", "Accept-Encoding: " + coding + "\r\n");
  };
  const auto plain = get("/api/parameters");
  const auto packed = with("/api/parameters", "gzip");
  EXPECT_FALSE(plain.headers.contains("content-encoding"));
  EXPECT_EQ(packed.headers.at("content-encoding"), "gzip");
  EXPECT_EQ(packed.headers.at("vary"), "Accept-Encoding");
  EXPECT_LT(packed.body.size() * 4, plain.body.size());
  EXPECT_EQ(gunzip(packed.body), plain.body);
  EXPECT_FALSE(with("/api/plc/image", "br").headers.contains("content-encoding"));
  EXPECT_FALSE(with("/api/parameters/100034", "gzip").headers.contains("content-encoding")) << "short";

  std::ofstream(web_ + "/app.js") << "the script";
  EXPECT_EQ(with("/app.js", "gzip").body, "the script") << "no compressed file beside it";
  std::ofstream(web_ + "/app.js.gz") << gzip("the script", 9);
  const auto script = with("/app.js", "gzip");
  EXPECT_EQ(script.headers.at("content-encoding"), "gzip");
  EXPECT_EQ(script.headers.at("content-type"), "text/javascript; charset=utf-8");
  EXPECT_EQ(gunzip(script.body), "the script");
  EXPECT_EQ(get("/app.js").body, "the script");
}

/// The process that `parent` has started, 0 = none.
pid_t child_of(pid_t parent) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    if (std::atoi(entry.path().filename().c_str()) == 0) continue;  // no process
    std::ifstream file(entry.path() / "stat");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    // proc(5): pid (name) state parent; a name may contain anything.
    const auto name_end = text.rfind(')');
    if (name_end == std::string::npos) continue;
    if (std::atoi(text.c_str() + name_end + 4) == parent) return std::atoi(text.c_str());
  }
  return 0;
}

TEST_F(GatewayRecordings, OneWhoseRecorderHasEndedIsNotAnsweredAsWhole) {
  ASSERT_EQ(post("/api/recordings", {{"name", "cut.mcap"}}).status, 200);
  EXPECT_EQ(list()["problem"], "");
  kill(child_of(process_->pid()), SIGKILL);
  ASSERT_TRUE(eventually([&] { return list()["recording"].get<std::string>().empty(); }));
  EXPECT_THAT(list()["problem"].get<std::string>(), testing::ContainsRegex("^cut.mcap: .*ended by signal 9"));
  const auto stopped = post("/api/recordings/cut.mcap/stop");
  EXPECT_EQ(stopped.status, 409);
  EXPECT_THAT(stopped.body, HasSubstr("cut.mcap has ended before it was stopped: "));
  record("next.mcap");
  EXPECT_EQ(list()["problem"], "") << "of the newest one only";
}

class GatewayWithoutSpace : public GatewayRecordings {
 protected:
  void SetUp() override {
    machine_directory_ = testing::TempDir() + "/gateway_machine_" + std::to_string(getpid());
    std::filesystem::copy(MACHINE, machine_directory_);
    std::ofstream(machine_directory_ + "/machine.yaml", std::ios::app) << "recording_free_space: 1e9\n";
    GatewayRecordings::SetUp();
  }
  void TearDown() override {
    GatewayRecordings::TearDown();
    std::filesystem::remove_all(machine_directory_);
  }
};

TEST_F(GatewayWithoutSpace, ARecordingIsRefusedWithBothSizes) {
  const auto refused = post("/api/recordings", {{"name", "day.mcap"}});
  EXPECT_EQ(refused.status, 409);
  EXPECT_THAT(json::parse(refused.body)["reason"].get<std::string>(),
              testing::ContainsRegex("/recordings/day.mcap: .* are free on its disk, a recording needs "
                                     "1000000.0 GB: delete files"));
  EXPECT_EQ(list()["recordings"], json::array());
}

TEST_F(GatewayRecordings, ThatWaitForTheDiskDoNotShutOutAStopAndDoNotQueueWithoutEnd) {
  ASSERT_EQ(post("/api/recordings", {{"name", "slow.mcap"}}).status, 200);
  const auto recorder = child_of(process_->pid());
  ASSERT_GT(recorder, 0);
  kill(recorder, SIGSTOP);  // it does not end its file: the thread of the files waits for it
  std::thread waiting([&] {
    auto server = http_client::Server(port_);
    server.timeout = 30;
    EXPECT_EQ(http_client::request(server, "POST", "/api/recordings/slow.mcap/stop", "{}").status, 200);
  });
  // From the moment on in which the thread waits, nothing of the files is answered any more.
  ASSERT_TRUE(eventually([&] {
    auto server = http_client::Server(port_);
    server.timeout = 0.2;
    return http_client::request(server, "GET", "/api/recordings").status == 0;
  }));
  HeldConnections held(port_);
  for (int i = 0; i < 300; ++i) held.open("GET /api/recordings HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  EXPECT_EQ(post("/api/panel/emergency-stop").status, 200);
  // 256 requests wait, whether or not their connections are still there.
  const auto refused = get("/api/recordings");
  EXPECT_EQ(refused.status, 503) << refused.body;
  EXPECT_THAT(refused.body, HasSubstr("256 requests wait"));
  kill(recorder, SIGCONT);
  waiting.join();
  EXPECT_TRUE(eventually([&] { return get("/api/recordings").status == 200; }));
}

}  // namespace
}  // namespace trunnion::gateway
