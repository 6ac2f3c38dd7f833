// SPDX-License-Identifier: Apache-2.0
// A gateway at which one station operates, without users: browsers and the command line.
#include <gmock/gmock.h>

#include "cluster/cluster_files.hpp"
#include "cluster/operating_station.hpp"
#include "gateway_fixture.hpp"
#include "held_connections.hpp"

namespace trunnion::gateway {
namespace {

using testing::HasSubstr;

class GatewayOperating : public Gateway {
 protected:
  void SetUp() override {
    run_.make();
    machine_ = testing::TempDir() + "/gateway_operating_" + std::to_string(getpid());
    std::filesystem::create_directories(machine_);
    std::filesystem::copy(MACHINE, machine_);
    std::ofstream(machine_ + "/machine.yaml", std::ios::app) << "operating_right: one\n";
    machine_directory_ = machine_;
    Gateway::SetUp();
  }
  void TearDown() override {
    Gateway::TearDown();
    std::filesystem::remove_all(machine_);
    run_.remove();
  }
  /// The header by which a new browser is known from now on.
  std::string browser() const {
    const auto answer = get("/api/operating-right");
    EXPECT_EQ(answer.status, 200) << answer.body;
    const auto cookie = answer.headers.at("set-cookie");
    EXPECT_THAT(cookie, HasSubstr("; HttpOnly"));
    return "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n";
  }
  Response ask(const std::string& target, const std::string& browser,
               const json& body = json::object()) const {
    return http_client::request(port_, "POST", target, body.dump(), browser);
  }
  json right(const std::string& browser) const {
    return json::parse(http_client::request(port_, "GET", "/api/operating-right", {}, browser).body);
  }
  json change(const std::string& action, const std::string& browser) const {
    return json::parse(ask("/api/operating-right", browser, {{"action", action}}).body);
  }

  const cluster::RunDirectory run_{domain};
  std::string machine_;
};

TEST_F(GatewayOperating, TheFirstOrderTakesTheRightAndStopsStayEverybodys) {
  const auto one = browser(), other = browser();
  EXPECT_FALSE(right(one)["mine"]);
  EXPECT_EQ(ask("/api/channels/0/single-block", one, {{"on", true}}).status, 200);
  EXPECT_TRUE(right(one)["mine"]);
  EXPECT_EQ(right(other)["holder"], right(one)["holder"]);
  const auto refused = ask("/api/channels/0/single-block", other, {{"on", true}});
  EXPECT_EQ(refused.status, 409);
  EXPECT_EQ(json::parse(refused.body)["accepted"], false);
  EXPECT_THAT(refused.body,
              HasSubstr(right(one)["holder"]["name"].get<std::string>() + " operates this machine"));
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/tools/3", "{}", other).status, 409);
  EXPECT_EQ(post("/api/panel/release").status, 409) << "a program without a cookie is a station of its own";
  for (const char* stop :
       {"/api/panel/emergency-stop", "/api/channels/0/feed-hold", "/api/channels/0/jog-stop"}) {
    EXPECT_EQ(
        ask(stop, other, stop == std::string("/api/channels/0/jog-stop") ? json{{"axis", 0}} : json::object())
            .status,
        200)
        << stop;
    EXPECT_TRUE(right(one)["mine"]) << "who stops does not take the right";
  }
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/programs/FROM_CAM.NC", "M30\n", other).status, 200)
      << "files come from elsewhere";
}

TEST_F(GatewayOperating, ARefusedOrderDoesNotTakeTheRight) {
  const auto one = browser(), other = browser();
  EXPECT_EQ(ask("/api/channels/0/mdi", one, {{"line", "?"}}).status, 409) << "refused by the channel";
  EXPECT_EQ(ask("/api/channels/0/mdi", one, {{"word", "G0"}}).status, 400);
  EXPECT_EQ(ask("/api/channels/7/cycle-start", one).status, 404);
  EXPECT_EQ(right(one)["holder"], nullptr);
  EXPECT_EQ(ask("/api/alarms/reset", other).status, 200);
  EXPECT_TRUE(right(other)["mine"]);
}

TEST_F(GatewayOperating, AnOrderHasTheRightUntilItsAnswer) {
  const auto one = browser(), other = browser();
  cluster([](auto& c) { c.channel_is_silent = true; });
  Response unanswered;
  std::thread waiting([&] { unanswered = ask("/api/channels/0/reset", one); });
  EXPECT_TRUE(eventually([&] { return cluster([](auto& c) { return !c.channel_requests.empty(); }); }));
  const auto refused = ask("/api/alarms/reset", other);
  waiting.join();
  EXPECT_EQ(unanswered.status, 504);
  EXPECT_EQ(refused.status, 409) << "while the order of the other one was being answered";
  EXPECT_EQ(right(one)["holder"], nullptr);
  EXPECT_EQ(ask("/api/alarms/reset", other).status, 200);
}

TEST_F(GatewayOperating, AnOrderThatNeverEndsDoesNotHoldTheRight) {
  const auto one = browser(), other = browser();
  HeldConnections held(port_);
  held.open("POST /api/panel/reset HTTP/1.1\r\nHost: 127.0.0.1\r\n" + one + "Content-Length: 2\r\n\r\n{");
  EXPECT_EQ(get("/api/status").status, 200) << "asked after it";
  EXPECT_EQ(ask("/api/alarms/reset", other).status, 200);
}

TEST_F(GatewayOperating, TheRightIsShownAndGivenBack) {
  const auto one = browser(), other = browser();
  http_client::WebSocketClient stream(port_, "/api/stream");
  EXPECT_EQ(json::parse(stream.next().value_or("{}"))["state"]["operating"], json::object());
  change("take", one);
  const auto number = right(one)["number"];
  EXPECT_TRUE(eventually([&] {
    const auto changes = json::parse(stream.next().value_or("{}")).value("changes", json::object());
    return changes.contains("operating") && changes["operating"]["holder"]["number"] == number;
  }));
  // Without users everybody may take over; the other one is told by the stream.
  EXPECT_TRUE(change("take", other)["mine"]);
  EXPECT_EQ(ask("/api/alarms/reset", one).status, 409);
  change("release", other);
  EXPECT_EQ(right(one)["holder"], nullptr);
  EXPECT_EQ(ask("/api/alarms/reset", one).status, 200);
  EXPECT_EQ(ask("/api/operating-right", one, {{"action", "dance"}}).status, 400);
  const auto alone = ask("/api/operating-right", one, {{"action", "hand_over"}});
  EXPECT_EQ(alone.status, 409);
  EXPECT_EQ(alone.headers.at("content-type"), "application/problem+json");
}

TEST_F(GatewayOperating, TheCommandLineIsAStationAsLongAsItRuns) {
  const auto one = browser();
  {
    const cluster::OperatingStation command(domain, false);
    const auto refused = ask("/api/alarms/reset", one);
    EXPECT_EQ(refused.status, 409);
    EXPECT_THAT(refused.body, HasSubstr("command line of "));
  }
  EXPECT_TRUE(eventually([&] { return ask("/api/alarms/reset", one).status == 200; })) << "it has ended";
  try {
    const cluster::OperatingStation command(domain, false);
    ADD_FAILURE() << "the browser operates";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("operates this machine; --take-right takes the right to operate over"));
  }
  const cluster::OperatingStation command(domain, true);
  EXPECT_EQ(ask("/api/alarms/reset", one).status, 409);
}

TEST(OperatingStation, DoesNothingWithoutAGatewayThatLetsOneStationOperate) {
  EXPECT_NO_THROW(cluster::OperatingStation(domain, false));
}

}  // namespace
}  // namespace trunnion::gateway
