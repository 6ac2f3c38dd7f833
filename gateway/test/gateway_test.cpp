// SPDX-License-Identifier: Apache-2.0
// What the gateway does with requests.
#include <gmock/gmock.h>

#include "gateway_fixture.hpp"
#include "storage/crc32.hpp"

namespace trunnion::gateway {
namespace {

using http_client::raw_exchange;
using http_client::send_and_go;
using testing::HasSubstr;

TEST_F(Gateway, ShowsTheCluster) {
  const auto status = json::parse(get("/api/status").body);
  EXPECT_EQ(status["cluster"]["machine"], "Test mill 5X");
  EXPECT_EQ(status["contract"], topics::contract_hash);
  EXPECT_EQ(status["channels"], json::parse("[0]"));
  ASSERT_TRUE(eventually([&] {
    const auto now = json::parse(get("/api/status").body);
    int alive = 0, absent = 0;
    for (const auto& service : now["services"]) {
      if (service["service"] == "channel" && service["alive"] == true && service["contract_match"] == true)
        ++alive;
      if (service["service"] == "gateway" && service["alive"] == true) ++alive;
      if (service["service"] == "compensation" && service["lifecycle"] == "ABSENT") ++absent;
    }
    return alive == 2 && absent == 1;
  })) << get("/api/status").body;
  EXPECT_EQ(json::parse(get("/api/alarms").body)["alarms"][0]["number"], 102);
  const auto channel = json::parse(get("/api/channels/0").body);
  ASSERT_EQ(channel["positions"].size(), 5u);
  EXPECT_EQ(channel["positions"][4]["letter"], "C");
  EXPECT_EQ(channel["positions"][4]["axis"], 6);
  EXPECT_TRUE(channel["positions"][4].contains("following_error"))
      << "column 4 of the feedback is logical axis 6";
  EXPECT_EQ(json::parse(get("/api/plc/image").body)["x"][3], 0x81);
  EXPECT_EQ(json::parse(get("/api/tools").body)["tools"][0]["length"], 112.25);
  EXPECT_EQ(json::parse(get("/api/openapi.json").body)["openapi"], "3.1.0");
}

TEST_F(Gateway, AnOrderReachesTheChannelOnceAndIsAnswered) {
  const auto answer = post("/api/channels/0/cycle-start");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(json::parse(answer.body)["accepted"], true);
  cluster([](auto& c) {
    ASSERT_EQ(c.channel_requests.size(), 1u);
    EXPECT_EQ(c.channel_requests[0].command, idl::channel::CommandKind::CYCLE_START);
    EXPECT_NE(c.channel_requests[0].client, 0u);
  });
  EXPECT_TRUE(eventually([&] { return json::parse(get("/api/channels/0").body)["state"] == "RUNNING"; }));
  EXPECT_EQ(post("/api/channels/0/override", {{"kind", "feed"}, {"value", 0.5}}).status, 200);
  cluster([](auto& c) { EXPECT_EQ(c.channel.feed_override, 0.5); });
}

TEST_F(Gateway, WhoHasAnAnswerIsShownNoOlderState) {
  http_client::WebSocketClient stream(port_, "/api/stream");
  ASSERT_TRUE(stream.open());
  for (int i = 1; i <= 30; ++i) {
    const auto answer = post("/api/channels/0/dry-run", {{"on", i % 2 == 1}});
    EXPECT_EQ(json::parse(get("/api/channels/0").body)["dry_run"], i % 2 == 1) << i;
    const auto shown = std::stoull(answer.headers.at("x-state-sequence"));
    EXPECT_TRUE(eventually([&] {
      return json::parse(stream.next(60).value_or("{}")).value("sequence", 0u) >= shown;
    })) << i;
    http_client::request(port_, "PUT", "/api/parameters/100034", json{{"value", 1000 + i}}.dump());
    EXPECT_EQ(json::parse(get("/api/parameters/100034").body)["value"], 1000 + i);
  }
}

TEST_F(Gateway, ARefusalIsAnsweredWithAlarmAndReason) {
  const auto answer = post("/api/channels/0/mdi", {{"line", "?? X1"}});
  EXPECT_EQ(answer.status, 409);
  const auto body = json::parse(answer.body);
  EXPECT_EQ(body["accepted"], false);
  EXPECT_EQ(body["alarm"], 1001);
  EXPECT_EQ(body["reason"], "unknown word in '?? X1'");
}

TEST_F(Gateway, BadInputNeverReachesTheBus) {
  auto bad = http_client::request(port_, "POST", "/api/channels/0/jog", "{\"axis\":\"Q\",\"speed\":100}");
  EXPECT_EQ(bad.status, 400);
  EXPECT_EQ(json::parse(bad.body)["field"], "axis");
  bad = http_client::request(port_, "POST", "/api/channels/0/mdi", "{not json");
  EXPECT_EQ(bad.status, 400);
  EXPECT_THAT(bad.body, HasSubstr("not JSON"));
  EXPECT_EQ(post("/api/channels/9/reset").status, 404);
  EXPECT_EQ(post("/api/channels/zero/reset").status, 404);
  EXPECT_EQ(post("/api/nothing").status, 404);
  EXPECT_EQ(get("/api/channels/0/reset").status, 405);
  EXPECT_EQ(get("/api/parameters/000999").status, 404);
  EXPECT_EQ(get("/api/programs/NOTHING").status, 404);
  EXPECT_EQ(get("/api/parameters?limit=many").status, 400);
  EXPECT_EQ(get("/api/stream").status, 426);
  EXPECT_EQ(
      http_client::request(port_, "POST", "/api/channels/0/mdi", std::string((1 << 20) + 1, ' ')).status,
      413);
  EXPECT_EQ(
      http_client::request(port_, "PUT", "/api/programs/BIG", "", "Content-Length: 200000000\r\n").status,
      413);
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/programs/..%2fX", "G0").status, 400);
  cluster([](auto& c) { c.largest_program = 1; });
  const auto no_room = http_client::request(port_, "PUT", "/api/programs/NO-ROOM", "G0");
  EXPECT_EQ(no_room.status, 507);
  EXPECT_EQ(json::parse(no_room.body)["alarm"], 150);
  EXPECT_THAT(raw_exchange(port_, "nonsense\r\n\r\n"), HasSubstr("400"));
  cluster([](auto& c) { EXPECT_TRUE(c.channel_requests.empty()); });
}

TEST_F(Gateway, APageOfAnotherSiteMustNotOperateTheMachine) {
  EXPECT_EQ(http_client::request(port_, "POST", "/api/channels/0/cycle-start", "{}",
                                 "Origin: http://elsewhere.example\r\n")
                .status,
            403);
  const auto own = "Origin: http://127.0.0.1:" + std::to_string(port_) + "\r\n";
  EXPECT_EQ(http_client::request(port_, "POST", "/api/channels/0/cycle-start", "{}", own).status, 200);
  cluster([](auto& c) { EXPECT_EQ(c.channel_requests.size(), 1u); });
}

// The swap of a gateway on a machine that has been at rest for longer than the history of the feedback.
TEST_F(Gateway, OneThatStandsByAfterALongRestKnowsWhereTheAxesAreAndMatches) {
  EXPECT_TRUE(
      eventually([&] { return get("/api/channels/0").body.find("\"actual\"") != std::string::npos; }));
  cluster([](auto& c) { c.at_rest = true; });
  const std::size_t history = bus::writer_qos(bus::QosKind::batch, {}).depth;
  EXPECT_TRUE(eventually([&] { return cluster([&](auto& c) { return c.batches_at_rest > history; }); }));
  bus::Bus bus(bus::Vendor::cyclonedds, {domain});
  auto beats = bus.reader(topics::service_state);
  auto arguments = command_line(port_, web_);
  arguments.emplace_back("--standby");
  const Process standby(arguments, web_ + "/standby.txt");
  idl::service::ServiceState state{}, newest{};
  using idl::service::StandbyState;
  EXPECT_TRUE(eventually([&] {
    while (beats.take(state))
      if (state.pid == standby.pid()) newest = state;
    return newest.standby == StandbyState::MATCHING || newest.standby == StandbyState::DIFFERING;
  }));
  EXPECT_EQ(newest.standby, StandbyState::MATCHING) << newest.difference;
}

TEST_F(Gateway, OneThatStartsAfterALongRestShowsTheAxesWhereTheyAre) {
  cluster([](auto& c) { c.at_rest = true; });
  const std::size_t history = bus::writer_qos(bus::QosKind::batch, {}).depth;
  EXPECT_TRUE(eventually([&] { return cluster([&](auto& c) { return c.batches_at_rest > history; }); }));
  process_.reset();
  process_ = std::make_unique<Process>(command_line(port_, web_), web_ + "/stderr.txt");
  json first;
  EXPECT_TRUE(eventually([&] {
    const auto answer = get("/api/channels/0");
    if (answer.status != 200) return false;
    first = json::parse(answer.body)["positions"][0];
    return first.contains("actual");
  })) << first;
  EXPECT_EQ(first["actual"], first["position"]);
  EXPECT_EQ(first["actual"], 50);
}

TEST_F(Gateway, AStopIsAcceptedWhileTheChannelHangsAndTakenWhenItGoesOn) {
  cluster([](auto& c) { c.channel_hangs = true, c.channel.state = idl::channel::RunState::RUNNING; });
  const auto held = post("/api/channels/0/feed-hold");
  EXPECT_EQ(held.status, 202);
  EXPECT_EQ(json::parse(held.body)["accepted"], true);
  EXPECT_THAT(held.body, HasSubstr("feed hold is repeated until channel 0 answers"));
  const auto jog = post("/api/channels/0/jog-stop", {{"axis", "X"}});
  EXPECT_EQ(jog.status, 202);
  EXPECT_THAT(jog.body, HasSubstr("jog stop is repeated until channel 0 answers"));
  EXPECT_EQ(post("/api/channels/0/single-block", {{"on", true}}).status, 504) << "any other order";
  cluster([](auto& c) { c.channel_hangs = false; });
  EXPECT_TRUE(eventually(
      [&] { return cluster([](auto& c) { return c.channel.state == idl::channel::RunState::HELD; }); }));
  EXPECT_EQ(post("/api/channels/0/feed-hold").status, 200);
}

TEST_F(Gateway, ASilentServiceIsAGatewayTimeoutAndOthersGoOnMeanwhile) {
  cluster([](auto& c) { c.channel_is_silent = true; });
  Response slow;
  std::thread waiting([&] { slow = post("/api/channels/0/reset"); });
  EXPECT_TRUE(eventually([&] { return cluster([](auto& c) { return c.channel_requests.size() == 1; }); }));
  EXPECT_EQ(post("/api/panel/emergency-stop").status, 200);
  waiting.join();
  EXPECT_EQ(slow.status, 504);
  cluster([](auto& c) {
    EXPECT_EQ(c.channel_requests.size(), 1u) << "repetitions are the same request";
    ASSERT_EQ(c.panel_requests.size(), 1u);
    EXPECT_EQ(c.panel_requests[0].kind, idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP);
  });
  EXPECT_TRUE(
      eventually([&] { return json::parse(get("/api/status").body)["plc"]["emergency_stop"] == true; }));
}

// What a recorder would hear of the journal.
class JournalReader {
 public:
  JournalReader() : bus_(bus::Vendor::cyclonedds, {domain}), reader_(bus_.reader(topics::operator_request)) {}
  // Lines are not kept for late readers: asks for what there is not until one comes.
  bool found(std::uint16_t port) {
    idl::gateway::OperatorRequest line;
    if (!eventually([&] {
          http_client::request(port, "POST", "/api/channels/31/reset");
          return reader_.take(line);
        }))
      return false;
    http_client::request(port, "POST", "/api/channels/30/reset");
    return eventually([&] { return reader_.take(line) && line.target == "/api/channels/30/reset"; });
  }
  // The line that comes next, empty after some seconds.
  idl::gateway::OperatorRequest next() {
    idl::gateway::OperatorRequest line;
    eventually([&] { return reader_.take(line); });
    return line;
  }

 private:
  bus::Bus bus_;
  bus::Reader<idl::gateway::OperatorRequest> reader_;
};

TEST_F(Gateway, EveryOrderIsALineOfTheJournalWithItsAnswerAndItsRequestOnTheBus) {
  JournalReader journal;
  ASSERT_TRUE(journal.found(port_));
  const auto own = "Origin: http://127.0.0.1:" + std::to_string(port_) + "\r\nCookie: secret\r\n";
  const auto answer = http_client::request(port_, "POST", "/api/channels/0/override",
                                           "{\"kind\":\"feed\",\"value\":0.5}", own);
  auto line = journal.next();
  const auto first = line.line;
  EXPECT_EQ(line.sender, idl::gateway::Sender::PAGE);
  EXPECT_EQ(line.address, "127.0.0.1");
  EXPECT_EQ(line.method + " " + line.target, "POST /api/channels/0/override");
  EXPECT_EQ(line.body, "{\"kind\":\"feed\",\"value\":0.5}");
  EXPECT_EQ(line.status, 200);
  EXPECT_EQ(line.answer, answer.body);
  cluster([&](auto& c) {
    ASSERT_EQ(c.channel_requests.size(), 1u);
    EXPECT_EQ(line.client, c.channel_requests[0].client);
    EXPECT_EQ(line.number, c.channel_requests[0].number);
    EXPECT_EQ(line.requests, 1u);
  });
  // Refused by the service, by the gateway, and because of where it comes from; reading in between is no
  // line.
  get("/api/status");
  post("/api/channels/0/mdi", {{"line", "?? X1"}});
  line = journal.next();
  EXPECT_EQ(line.line, first + 1) << "reading is no line";
  EXPECT_EQ(line.sender, idl::gateway::Sender::TOOL);
  EXPECT_EQ(line.status, 409);
  post("/api/channels/0/mdi", {{"line", 7}});
  line = journal.next();
  EXPECT_EQ(line.status, 400);
  EXPECT_EQ(line.requests, 0u);
  http_client::request(port_, "POST", "/api/channels/0/cycle-start", "{}",
                       "Origin: http://elsewhere.example\r\n");
  line = journal.next();
  EXPECT_EQ(line.sender, idl::gateway::Sender::FOREIGN_PAGE);
  EXPECT_EQ(line.status, 403);
  post("/api/alarms/reset");
  line = journal.next();
  ASSERT_TRUE(eventually([&] { return cluster([](auto& c) { return !c.alarm_resets.empty(); }); }));
  cluster([&](auto& c) {
    EXPECT_EQ(line.client, c.alarm_resets.at(0).client);
    EXPECT_EQ(line.number, c.alarm_resets.at(0).number);
  });
}

TEST_F(Gateway, AProgramIsInTheJournalBySizeAndSumAndByTheRequestsThatCarriedIt) {
  JournalReader journal;
  ASSERT_TRUE(journal.found(port_));
  const std::string text(130000, ';');
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/programs/P", text).status, 200);
  auto line = journal.next();
  EXPECT_EQ(line.body, "");
  EXPECT_EQ(line.body_size, text.size());
  EXPECT_EQ(line.body_crc32, storage::crc32(text));
  EXPECT_EQ(line.number, 1u);
  EXPECT_EQ(line.requests, 5u) << "begin, 60000 + 60000 + 10000 bytes, commit";
  EXPECT_EQ(get("/api/programs/P").body, text);
  line = journal.next();
  EXPECT_EQ(line.method, "GET");
  EXPECT_EQ(line.answer_size, text.size());
  EXPECT_EQ(line.answer_crc32, storage::crc32(text));
  EXPECT_EQ(line.requests, 3u);
  // A client that goes away in the middle of its program has no answer.
  send_and_go(port_, "PUT /api/programs/Q HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 100\r\n\r\nhalf");
  line = journal.next();
  EXPECT_EQ(line.target, "/api/programs/Q");
  EXPECT_EQ(line.status, 0);
}

// A page under a name of its own that leads to this address has the same Origin and Host, and must not
// operate either.
TEST_F(Gateway, ARequestUnderAnotherNameIsRefusedBeforeItIsRead) {
  const auto answer = http_client::raw_exchange(
      port_,
      "POST /api/panel/emergency-stop HTTP/1.1\r\nHost: evil.example\r\nOrigin: http://evil.example\r\n"
      "Content-Length: 2\r\nConnection: close\r\n\r\n{}");
  EXPECT_NE(answer.find("HTTP/1.1 421"), std::string::npos) << answer;
  EXPECT_NE(answer.find("host_names"), std::string::npos) << answer;
}

TEST_F(Gateway, AJogItsRenewalsAndItsStopReachTheChannelWithTheirPress) {
  using idl::channel::CommandKind;
  EXPECT_EQ(post("/api/channels/0/jog", {{"axis", "Y"}, {"speed", -300}, {"press", 4000000000u}}).status,
            200);
  EXPECT_EQ(post("/api/channels/0/jog-renew", {{"press", 4000000000u}}).status, 200);
  EXPECT_EQ(post("/api/channels/0/jog-renew", {{"press", 0}}).status, 400);
  EXPECT_EQ(post("/api/channels/0/jog-stop", {{"axis", "Y"}}).status, 200);
  cluster([](auto& c) {
    ASSERT_EQ(c.channel_requests.size(), 3u);
    EXPECT_EQ(c.channel_requests[0].command, CommandKind::JOG_AXIS);
    EXPECT_EQ(c.channel_requests[0].press, 4000000000u);
    EXPECT_EQ(c.channel_requests[1].command, CommandKind::JOG_RENEW);
    EXPECT_EQ(c.channel_requests[1].press, 4000000000u);
    EXPECT_EQ(c.channel_requests[2].command, CommandKind::JOG_STOP);
  });
}

TEST_F(Gateway, ProgramsTravelInChunksAndComeBackAsTheyWere) {
  std::string text;
  while (text.size() < 400000)
    text += "G1 X" + std::to_string(text.size() * 7919 % 100000) + " Y1.5 \xC3\xA4\n";
  const auto stored = http_client::request(port_, "PUT", "/api/programs/LARGE%201.NC", text);
  EXPECT_EQ(stored.status, 200) << stored.body;
  EXPECT_EQ(json::parse(stored.body)["program"]["size"], text.size());
  cluster([&](auto& c) {
    EXPECT_EQ(std::string(c.programs["LARGE 1.NC"].begin(), c.programs["LARGE 1.NC"].end()), text);
    EXPECT_EQ(c.largest_write, 60000u);
  });
  const auto read = get("/api/programs/LARGE%201.NC");
  EXPECT_EQ(read.status, 200);
  EXPECT_EQ(read.headers.at("content-length"), std::to_string(text.size()));
  EXPECT_EQ(read.body, text);
  EXPECT_EQ(http_client::request(port_, "PUT", "/api/programs/EMPTY", "").status, 200);
  EXPECT_EQ(get("/api/programs/EMPTY").status, 200);
  EXPECT_EQ(get("/api/programs/EMPTY").body, "");
  EXPECT_TRUE(eventually([&] { return get("/api/programs").body.find("LARGE 1.NC") != std::string::npos; }));
  EXPECT_EQ(http_client::request(port_, "DELETE", "/api/programs/LARGE%201.NC").status, 200);
  EXPECT_EQ(http_client::request(port_, "DELETE", "/api/programs/LARGE%201.NC").status, 409);
  EXPECT_TRUE(eventually([&] { return get("/api/programs/LARGE%201.NC").status == 404; }));
}

TEST_F(Gateway, ParametersAreReadChangedAndRefusedWithTheReason) {
  EXPECT_EQ(json::parse(get("/api/parameters/100034").body)["value"], 24000);
  EXPECT_EQ(
      http_client::request(port_, "PUT", "/api/parameters/100034", "{\"value\":12000.5,\"who\":\"test\"}")
          .status,
      200);
  EXPECT_TRUE(
      eventually([&] { return json::parse(get("/api/parameters/100034").body)["value"] == 12000.5; }));
  cluster([](auto& c) { EXPECT_EQ(c.parameter_requests.at(0).who, "test"); });
  const auto refused = http_client::request(port_, "PUT", "/api/parameters/100034", "{\"value\":5e9}");
  EXPECT_EQ(refused.status, 409);
  EXPECT_THAT(refused.body, HasSubstr("must be from 1 to 1000000"));
  const auto found = json::parse(get("/api/parameters?class=axis&search=rapid_feed").body);
  EXPECT_EQ(found["total"], 5) << "one for each of X Y Z A C";
  const auto offset = http_client::request(port_, "PUT", "/api/work-offsets",
                                           "{\"channel\":0,\"index\":1,\"values\":[1,2,3,4,5,6,7,8,9]}");
  EXPECT_EQ(offset.status, 200);
  EXPECT_TRUE(
      eventually([&] { return json::parse(get("/api/work-offsets").body)["offsets"][0]["index"] == 1; }));
}

TEST_F(Gateway, AnAlarmResetIsPublished) {
  EXPECT_EQ(post("/api/alarms/reset").status, 200);
  EXPECT_TRUE(eventually([&] { return json::parse(get("/api/alarms").body)["alarms"].empty(); }));
  cluster([](auto& c) { EXPECT_EQ(c.alarm_resets.at(0).channel, 65535); });
}

TEST_F(Gateway, ServesThePageAndNothingElse) {
  const auto page = get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, "<p>the page</p>");
  EXPECT_EQ(page.headers.at("content-type"), "text/html; charset=utf-8");
  EXPECT_EQ(get("/../stderr.txt").status, 404);
  EXPECT_EQ(get("/%2e%2e/" + web_.substr(web_.rfind('/') + 1) + "/index.html").status, 404);
  EXPECT_EQ(post("/index.html").status, 405);
}

TEST_F(Gateway, APortInUseIsOneClearLine) {
  const auto errors = web_ + "/second.txt";
  Process second(command_line(port_, web_), errors);
  EXPECT_EQ(second.wait(), 1);
  std::ifstream file(errors);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, "trunnion-gateway: error: cannot listen on 127.0.0.1:" + std::to_string(port_) +
                      ": Address already in use\n");
}

}  // namespace
}  // namespace trunnion::gateway
