// SPDX-License-Identifier: Apache-2.0
// A gateway that is reached by TLS only.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>

#include "access/certificate.hpp"
#include "access/secrets.hpp"
#include "access/user_file.hpp"
#include "gateway_fixture.hpp"
#include "held_connections.hpp"
#include "hold_times.hpp"

namespace trunnion::gateway {
namespace {

using http_client::Server;
using http_client::WebSocketClient;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class GatewayTls : public testing::Test {
 protected:
  void SetUp() override {
    scratch_ = testing::TempDir() + "/gateway_tls_" + std::to_string(getpid());
    std::filesystem::create_directories(scratch_ + "/machine");
    std::filesystem::create_directories(scratch_ + "/web_state");
    std::filesystem::create_directories(scratch_ + "/web");
    std::ofstream(scratch_ + "/web/index.html") << "<p>the page</p>";
    std::filesystem::copy(MACHINE, scratch_ + "/machine");
    set("tls: on");
    server_.authority = scratch_ + "/web_state/" + access::certificate_file;
  }
  void TearDown() override {
    stop_ = true;
    if (stepper_.joinable()) stepper_.join();
    process_.reset();
    std::filesystem::remove_all(scratch_);
  }
  void set(const std::string& line) const {
    std::ofstream(scratch_ + "/machine/machine.yaml", std::ios::app) << line << "\n";
  }
  access::CertificatePair make(int days = 100) const {
    return access::make_certificate({"127.0.0.1", "localhost"}, days, std::time(nullptr));
  }
  void place(const access::CertificatePair& pair) const {
    access::write_private(scratch_ + "/web_state/" + access::certificate_key_file, pair.key);
    access::write_private(scratch_ + "/web_state/" + access::certificate_file, pair.certificate);
  }
  std::vector<std::string> arguments() const {
    auto made = command_line(port_, scratch_ + "/web");
    made[2] = scratch_ + "/machine";
    return made;
  }
  void start() {
    process_ = std::make_unique<Process>(arguments(), scratch_ + "/stderr.txt");
    stepper_ = std::thread([this] {
      while (!stop_) {
        {
          const std::lock_guard lock(mutex_);
          cluster_.step();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    });
    ASSERT_TRUE(eventually([&] { return ask("POST", "/api/channels/0/feed-hold").status == 200; }));
  }
  /// The line with which the gateway ends instead of starting.
  std::string failure() const {
    Process process(arguments(), scratch_ + "/stderr.txt");
    EXPECT_EQ(process.wait(), 1);
    std::ifstream in(scratch_ + "/stderr.txt");
    return {std::istreambuf_iterator<char>(in), {}};
  }
  Response ask(const std::string& method, const std::string& target, const json& body = json::object(),
               const std::string& headers = "") const {
    return http_client::request(server_, method, target, method == "GET" ? "" : body.dump(), headers);
  }
  /// Output of a program, with what it says on its standard error.
  static std::string output(const std::string& command) {
    std::string told;
    FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
    for (int c; (c = std::fgetc(pipe)) != EOF;) told += static_cast<char>(c);
    pclose(pipe);
    return told;
  }

  const std::uint16_t port_ = free_port();
  Server server_{port_, true};
  std::string scratch_;
  std::mutex mutex_;
  FakeCluster cluster_{{domain}};
  std::atomic<bool> stop_ = false;
  std::thread stepper_;
  std::unique_ptr<Process> process_;
};

// RFC 8446, 5.1 and 4.1.2: a record of a handshake of 512 bytes of which the first are those of a
// ClientHello.
const std::string begun_handshake{"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11};

TEST_F(GatewayTls, PageOrdersStreamAndStopsGoByTls) {
  place(make());
  start();
  EXPECT_EQ(ask("GET", "/").body, "<p>the page</p>");
  EXPECT_EQ(ask("POST", "/api/channels/0/cycle-start").status, 200);
  WebSocketClient client(server_, "/api/stream");
  ASSERT_TRUE(client.open());
  ASSERT_TRUE(json::parse(client.next().value()).contains("state"));
  client.send(R"({"order": 1, "path": "/api/panel/emergency-stop"})");
  json message;
  for (int i = 0; i < 100 && !message.contains("answer"); ++i) message = json::parse(client.next().value());
  EXPECT_EQ(message["status"], 200);
  // Larger than a record of TLS (16 KiB), there and back.
  std::string text;
  for (int i = 0; i < 60000; ++i) text += "G1 X" + std::to_string(i % 100) + "\n";
  const auto stored = http_client::request(server_, "PUT", "/api/programs/LONG.NC", text);
  EXPECT_EQ(stored.status, 200) << stored.body;
  EXPECT_EQ(ask("GET", "/api/programs/LONG.NC").body, text);
}

TEST_F(GatewayTls, AClientWithoutTlsIsToldWhereTheGatewayIsAndGetsNothingElse) {
  place(make());
  start();
  const auto page = http_client::request(port_, "GET", "/api/status?x=1");
  EXPECT_EQ(page.status, 308);
  EXPECT_EQ(page.headers.at("location"), "https://127.0.0.1:" + std::to_string(port_) + "/api/status?x=1");
  EXPECT_THAT(page.body, HasSubstr("https:// only"));
  const auto order = http_client::request(port_, "POST", "/api/panel/emergency-stop", "{}");
  EXPECT_EQ(order.status, 426);
  EXPECT_THAT(order.body, HasSubstr("https:// only"));
  EXPECT_FALSE(order.headers.contains("location"));
  EXPECT_FALSE(WebSocketClient(port_, "/api/stream").open());
  // Nobody is led to a name that is not the machine's.
  EXPECT_THAT(http_client::raw_exchange(port_, "GET / HTTP/1.1\r\nHost: elsewhere.example\r\n\r\n"),
              StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(http_client::raw_exchange(port_, "\x05hello\r\n\r\n"), StartsWith("HTTP/1.1 400"));
}

TEST_F(GatewayTls, CurlTrustsTheCertificateAndRefusesAnother) {
  place(make());
  start();
  const auto url = "https://localhost:" + std::to_string(port_) + "/api/status";
  EXPECT_THAT(output("curl -sS --cacert " + server_.authority + " " + url), HasSubstr("\"contract\""));
  EXPECT_THAT(output("curl -sS " + url), HasSubstr("SSL certificate problem"));
  const auto other = scratch_ + "/other.pem";
  std::ofstream(other) << make().certificate;
  EXPECT_THAT(output("curl -sS --cacert " + other + " " + url), HasSubstr("SSL certificate problem"));
  const auto known = "curl -sS -o /dev/null -w '%{http_code}' --cacert " + server_.authority + " ";
  EXPECT_EQ(output(known + "--tls-max 1.2 " + url), "200");
  EXPECT_THAT(output("curl -sS --ciphers DEFAULT@SECLEVEL=0 --tlsv1.0 --tls-max 1.1 --cacert " +
                     server_.authority + " " + url),
              AnyOf(HasSubstr("alert protocol version"), HasSubstr("unsupported protocol")));
}

TEST_F(GatewayTls, TheCookieOfASessionGoesByTlsOnly) {
  set("auth: on");
  place(make());
  access::Users users;
  users.users.push_back({"anna", access::Role::administrator, access::hash_password("password of anna")});
  access::save_users(scratch_ + "/web_state", users);
  start();
  const auto answer = ask("POST", "/api/session", {{"name", "anna"}, {"password", "password of anna"}});
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_THAT(answer.headers.at("set-cookie"), HasSubstr("; Secure"));
  const auto here = "127.0.0.1:" + std::to_string(port_);
  const auto cookie = answer.headers.at("set-cookie").substr(0, answer.headers.at("set-cookie").find(';'));
  const auto from = [&](const std::string& scheme) {
    return ask("POST", "/api/alarms/reset", json::object(),
               "Cookie: " + cookie + "\r\nOrigin: " + scheme + here + "\r\n")
        .status;
  };
  EXPECT_EQ(from("https://"), 200);
  EXPECT_EQ(from("http://"), 403) << "a page that came in clear text may be anybody's";
}

// The delay is printed, not judged: a test runs beside others.
TEST_F(GatewayTls, AThousandHeldConnectionsDoNotBlockAStop) {
  place(make());
  start();
  const std::string text(8 << 20, ' ');  // more than the kernel takes for one that does not read
  ASSERT_EQ(http_client::request(server_, "PUT", "/api/programs/LARGE.NC", text).status, 200);
  HeldConnections held(port_);
  std::vector<std::unique_ptr<WebSocketClient>> slow;
  double longest = 0;
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 10; ++i) {
      held.open("");
      held.open("\x16");
      held.open(begun_handshake);
      held.open("GET /api/status HTTP/1.1\r\nHo");
      // No stream is there: it reads the head of the answer and never its body.
      slow.push_back(std::make_unique<WebSocketClient>(server_, "/api/programs/LARGE.NC", 4096));
    }
    longest = std::max(
        longest, milliseconds_of([&] { EXPECT_EQ(ask("POST", "/api/panel/emergency-stop").status, 200); }));
  }
  EXPECT_EQ(ask("POST", "/api/channels/0/feed-hold").status, 200);
  std::printf("largest delay of a stop by a new connection with TLS among 1,000 held ones: %.1f ms\n",
              longest);
}

TEST_F(GatewayTls, AConnectionThatDoesNotFinishItsHandshakeEndsAfterFiveSeconds) {
  place(make());
  start();
  HeldConnections held(port_);
  const int slow = held.open(begun_handshake);
  std::array<char, 64> part{};
  const auto lasted = milliseconds_of([&] { EXPECT_EQ(::recv(slow, part.data(), part.size(), 0), 0); });
  EXPECT_GT(lasted, 4500);
}

TEST_F(GatewayTls, ARenewedCertificateIsUsedWithoutARestartAndOneThatCannotBeUsedIsAnAlarm) {
  place(make(20));
  start();
  const auto alarm = [&](unsigned number) {
    const auto answer = json::parse(ask("GET", "/api/alarms").body, nullptr, false);
    std::string text;
    if (answer.contains("alarms"))
      for (const auto& one : answer["alarms"])
        if (one["number"] == number) text = one["text"];
    return text;
  };
  EXPECT_TRUE(eventually([&] { return alarm(156).find(" ends on ") != std::string::npos; }))
      << "20 days are less than 30";
  WebSocketClient before(server_, "/api/stream");
  ASSERT_TRUE(before.open());
  const auto renewed = make(100);
  place({renewed.certificate, make().key});
  server_.authority.clear();
  EXPECT_TRUE(eventually([&] { return alarm(157).find("another certificate") != std::string::npos; }));
  place(renewed);
  EXPECT_TRUE(eventually([&] { return alarm(156).empty() && alarm(157).empty(); }));
  server_.authority = scratch_ + "/web_state/" + access::certificate_file;
  EXPECT_EQ(ask("GET", "/api/status").status, 200) << "by the renewed certificate, which alone is trusted";
  EXPECT_TRUE(before.next().has_value()) << "connections from before stay";
}

TEST_F(GatewayTls, APairThatCannotBeUsedEndsTheStartInOneLine) {
  const auto key = scratch_ + "/web_state/" + access::certificate_key_file;
  EXPECT_THAT(failure(),
              HasSubstr("certificate.pem: there is no such file: make it with 'trunnion certificate"));
  const auto good = make();
  place({good.certificate, make().key});
  EXPECT_THAT(failure(), HasSubstr("the key is that of another certificate"));
  place(access::make_certificate({"mill"}, 1, std::time(nullptr) - 3 * 86400));
  EXPECT_THAT(failure(), HasSubstr("the certificate has ended on "));
  place({"-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n", good.key});
  EXPECT_THAT(failure(), HasSubstr("there is no certificate in PEM form"));
  place(good);
  std::filesystem::permissions(key, std::filesystem::perms(0644));
  const auto line = failure();
  EXPECT_THAT(line, HasSubstr(key + ": others can read or change this key: set its mode to 0600"));
  EXPECT_EQ(std::ranges::count(line, '\n'), 1) << line;
}

/// ms of 99 % of 300 holds, while 50 others view.
double hold_with_viewers(const Server& server) {
  std::atomic<bool> over = false;
  std::vector<std::thread> viewers;
  for (int i = 0; i < 50; ++i)
    viewers.emplace_back([&] {
      WebSocketClient viewer(server, "/api/stream");
      EXPECT_TRUE(viewer.open());
      while (!over && viewer.next(1)) continue;
    });
  const auto times = hold_times(server, [n = 0]() mutable { return ++n <= 300; });
  over = true;
  for (auto& viewer : viewers) viewer.join();
  EXPECT_EQ(times.size(), 300u);
  return times.empty() ? 0 : p99(times);
}

TEST_F(GatewayTls, HoldsAreAnsweredByTlsWhile50View) {
  place(make());
  start();
  const double by_tls = hold_with_viewers(server_);
  process_.reset();
  std::filesystem::remove(scratch_ + "/machine/machine.yaml");
  std::filesystem::copy(std::string(MACHINE) + "/machine.yaml", scratch_ + "/machine");
  process_ = std::make_unique<Process>(arguments(), scratch_ + "/stderr.txt");
  ASSERT_TRUE(eventually(
      [&] { return http_client::request(port_, "POST", "/api/channels/0/feed-hold", "{}").status == 200; }));
  const double plain = hold_with_viewers(port_);
  std::printf("p99 of a hold with 50 viewers: %.1f ms by TLS, %.1f ms in clear text\n", by_tls, plain);
}

}  // namespace
}  // namespace trunnion::gateway
