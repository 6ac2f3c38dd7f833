// SPDX-License-Identifier: Apache-2.0
// The history of the alarms over HTTP and over a restart of the gateway.
#include "gateway_fixture.hpp"

namespace trunnion::gateway {
namespace {

class GatewayAlarms : public Gateway {
 protected:
  json history(const std::string& query = "") {
    return json::parse(get("/api/alarms/history" + query).body)["alarms"];
  }
  bool file_contains(const std::string& text) {
    return eventually([&] {
      std::ifstream file(state_ + "/alarms.jsonl");
      const std::string all{std::istreambuf_iterator<char>(file), {}};
      return all.find(text) != std::string::npos;
    });
  }
  void restart() {
    process_.reset();
    auto arguments = command_line(port_, web_);
    process_ = std::make_unique<Process>(arguments, web_ + "/stderr.txt");
    ASSERT_TRUE(eventually([&] { return get("/api/channels/0").status == 200; }));
  }
};

TEST_F(GatewayAlarms, AreInTheHistoryWithTheirTimesAndAfterARestart) {
  // The cluster of the test has alarm 102 until it is reset.
  ASSERT_TRUE(eventually([&] { return !history().empty(); }));
  const auto first = history()[0];
  EXPECT_EQ(first["number"], 102);
  EXPECT_FALSE(first.contains("cleared")) << first;
  EXPECT_EQ(history("?search=10").size(), 1u);
  EXPECT_EQ(history("?search=nothing").size(), 0u);
  EXPECT_EQ(get("/api/alarms/history?limit=x").status, 400);

  ASSERT_TRUE(file_contains("\"number\":102"));
  restart();
  ASSERT_TRUE(eventually([&] { return json::parse(get("/api/alarms").body)["alarms"].size() == 1; }));
  ASSERT_EQ(history().size(), 1u) << "the alarm that is still active is the same one";
  EXPECT_EQ(history()[0]["raised"], first["raised"]);
  EXPECT_EQ(post("/api/alarms/reset").status, 200);
  EXPECT_TRUE(eventually([&] { return history()[0].contains("cleared"); }));
  const auto cleared = history();

  // What a kill in the middle of a line leaves is left out.
  ASSERT_TRUE(file_contains("\"cleared\":\"2"));
  std::ofstream(state_ + "/alarms.jsonl", std::ios::app) << "{\"id\":2,\"num";
  restart();
  EXPECT_EQ(history(), cleared);
}

TEST_F(GatewayAlarms, OfATimeInWhichTheFileCouldNotBeWrittenAreInItAfterwards) {
  const auto file = state_ + "/alarms.jsonl";
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(file); }));
  // A directory in the place of the file stands for a disk that refuses.
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  EXPECT_EQ(post("/api/alarms/reset").status, 200);
  EXPECT_TRUE(eventually([&] { return !history("?search=alarms.jsonl").empty(); })) << "alarm 150 says so";
  EXPECT_TRUE(history("?search=102")[0].contains("cleared"));
  std::filesystem::remove(file);
  EXPECT_TRUE(eventually([&] {
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return text.find("\"number\":102") != std::string::npos &&
           text.find("\"cleared\":\"2") != std::string::npos;
  })) << "what was missed is there without another alarm";
}

}  // namespace
}  // namespace trunnion::gateway
