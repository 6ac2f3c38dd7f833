// SPDX-License-Identifier: Apache-2.0
// A gateway whose users log in.
#include <gmock/gmock.h>

#include "access/secrets.hpp"
#include "access/user_file.hpp"
#include "core/rights.hpp"
#include "gateway_fixture.hpp"

namespace trunnion::gateway {
namespace {

using access::Role;
using testing::HasSubstr;

class GatewayAccess : public testing::Test {
 protected:
  void SetUp() override {
    scratch_ = testing::TempDir() + "/gateway_access_" + std::to_string(getpid());
    std::filesystem::create_directories(scratch_ + "/machine");
    std::filesystem::create_directories(scratch_ + "/web_state");
    std::filesystem::copy(MACHINE, scratch_ + "/machine");
    std::ofstream(scratch_ + "/machine/machine.yaml", std::ios::app) << "auth: on\n";
  }
  void TearDown() override {
    stop_ = true;
    if (stepper_.joinable()) stepper_.join();
    process_.reset();
    std::filesystem::remove_all(scratch_);
  }
  void add(const std::string& name, Role role) {
    auto users = access::load_users(state()).value_or(access::Users{});
    users.users.push_back({name, role, access::hash_password("password of " + name)});
    access::save_users(state(), users);
  }
  void set(const std::string& line) const {
    std::ofstream(scratch_ + "/machine/machine.yaml", std::ios::app) << line << "\n";
  }
  void start() {
    auto arguments = command_line(port_, scratch_ + "/web");
    arguments[2] = scratch_ + "/machine";
    process_ = std::make_unique<Process>(arguments, scratch_ + "/stderr.txt");
    stepper_ = std::thread([this] {
      while (!stop_) {
        {
          const std::lock_guard lock(mutex_);
          cluster_.step();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    });
    // Channel 0 is known when a hold, which needs no login, is accepted.
    ASSERT_TRUE(eventually([&] { return ask("POST", "/api/channels/0/feed-hold").status == 200; }));
  }
  std::string state() const { return scratch_ + "/web_state"; }
  Response ask(const std::string& method, const std::string& target, const json& body = json::object(),
               const std::string& headers = "") const {
    return http_client::request(port_, method, target, method == "GET" ? "" : body.dump(), headers);
  }
  Response login(const std::string& name, const std::string& password) const {
    return ask("POST", "/api/session", {{"name", name}, {"password", password}});
  }
  /// The header Cookie of a session.
  std::string session(const std::string& name) const {
    const auto answer = login(name, "password of " + name);
    EXPECT_EQ(answer.status, 200) << answer.body;
    const auto cookie = answer.headers.at("set-cookie");
    EXPECT_THAT(cookie, HasSubstr("; HttpOnly"));
    EXPECT_THAT(cookie, HasSubstr("; SameSite=Strict"));
    return "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n";
  }
  std::string journal() const {
    std::ifstream in(state() + "/access.jsonl");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const std::uint16_t port_ = free_port();
  std::string scratch_;
  std::mutex mutex_;
  FakeCluster cluster_{{domain}};
  std::atomic<bool> stop_ = false;
  std::thread stepper_;
  std::unique_ptr<Process> process_;
};

TEST_F(GatewayAccess, WithoutALoginTheMachineCanBeStoppedAndNothingElse) {
  add("ann", Role::machine_operator);
  start();
  EXPECT_EQ(ask("POST", "/api/panel/emergency-stop").status, 200);
  for (const char* target :
       {"/api/status", "/api/stream", "/api/programs", "/api/recordings", "/api/parameters"})
    EXPECT_EQ(ask("GET", target).status, 401) << target;
  EXPECT_EQ(ask("POST", "/api/channels/0/cycle-start").status, 401);
  EXPECT_EQ(ask("PUT", "/api/programs/X.NC").status, 401);
  EXPECT_EQ(ask("GET", "/api/status", {}, "Cookie: trunnion_session=1234\r\n").status, 401);
  EXPECT_EQ(ask("GET", "/api/status", {}, "Authorization: Bearer 1234\r\n").status, 401);
  EXPECT_EQ(json::parse(ask("GET", "/api/session").body), json({{"auth", true}, {"name", ""}, {"role", ""}}));
}

TEST_F(GatewayAccess, ASessionMayDoWhatItsRoleSaysUntilItsEnd) {
  add("ann", Role::machine_operator);
  add("sam", Role::setter);
  add("bo", Role::builder);
  set("operating_right: any");
  start();
  const auto ann = session("ann"), sam = session("sam"), bo = session("bo");
  EXPECT_EQ(ask("POST", "/api/channels/0/cycle-start", json::object(), ann).status, 200);
  EXPECT_EQ(json::parse(ask("GET", "/api/session", {}, ann).body)["role"], "operator");
  const json tool = {{"length", 1}, {"length_wear", 0}, {"radius", 1}, {"radius_wear", 0}, {"name", "x"}};
  const auto refused = ask("PUT", "/api/tools/3", tool, ann);
  EXPECT_EQ(refused.status, 403);
  EXPECT_THAT(refused.body, HasSubstr("needs the role setter, and ann is operator"));
  EXPECT_EQ(ask("PUT", "/api/tools/3", tool, sam).status, 200);
  // 000010 has access builder, 000011 access user.
  EXPECT_EQ(ask("PUT", "/api/parameters/11", {{"value", 0.2}}, ann).status, 403);
  EXPECT_EQ(ask("PUT", "/api/parameters/11", {{"value", 0.2}}, sam).status, 200);
  EXPECT_EQ(ask("PUT", "/api/parameters/10", {{"value", 0.01}}, sam).status, 403);
  const json both = {{"values", {{{"number", 11}, {"value", 0.2}}, {{"number", 10}, {"value", 0.01}}}}};
  EXPECT_EQ(ask("PUT", "/api/parameters", both, sam).status, 403) << "all or none";
  EXPECT_EQ(ask("PUT", "/api/parameters/10", {{"value", 0.01}, {"who", "another"}}, bo).status, 200);
  {
    const std::lock_guard lock(mutex_);
    EXPECT_EQ(cluster_.parameter_requests.size(), 3u);
    EXPECT_EQ(cluster_.parameter_requests.back().who, "bo") << "who is logged in";
  }
  EXPECT_EQ(ask("DELETE", "/api/session", json::object(), ann).status, 200);
  EXPECT_EQ(ask("GET", "/api/status", {}, ann).status, 401);
  EXPECT_TRUE(eventually([&] {
    return journal().find("POST /api/channels/0/cycle-start: 200\",\"who\":\"ann\"") != std::string::npos &&
           journal().find("\"what\":\"logout\",\"who\":\"ann\"") != std::string::npos;
  })) << journal();
  EXPECT_EQ(journal().find("password of"), std::string::npos);
}

// Every route with every role: it is refused exactly when the role does not suffice. GET is tried with all,
// and what changes something only where it must be refused, or the machine would do it.
TEST_F(GatewayAccess, NoRouteIsOpenToARoleThatDoesNotSuffice) {
  add("ann", Role::machine_operator), add("sam", Role::setter), add("bo", Role::builder);
  set("operating_right: any");
  start();
  const std::vector<std::pair<std::optional<Role>, std::string>> visitors{
      {{}, ""},
      {Role::machine_operator, session("ann")},
      {Role::setter, session("sam")},
      {Role::builder, session("bo")}};
  int refused = 0;
  for (const auto& route : routes()) {
    Match match;
    match.operation = route.operation, match.command = route.command;
    const auto needed = needed_role(match);
    auto target = route.pattern;
    for (auto at = target.find('{'); at != std::string::npos; at = target.find('{'))
      target.replace(at, target.find('}', at) + 1 - at, "0");
    for (const auto& [role, cookie] : visitors) {
      const bool permitted = !needed || (role && *role >= *needed);
      if (permitted && route.method != "GET") continue;
      const int status = ask(std::string(route.method), target, json::object(), cookie).status;
      const auto shown =
          std::string(route.method) + " " + target + " as " + (role ? access::name_of(*role) : "nobody");
      if (permitted)
        EXPECT_THAT(status, testing::AllOf(testing::Ne(401), testing::Ne(403))) << shown;
      else
        EXPECT_EQ(status, role ? 403 : 401) << shown;
      refused += permitted ? 0 : 1;
    }
  }
  // 69 operations and more, of which eight are everybody's: nobody is refused at all the others.
  EXPECT_GT(refused, 100);
}

// What a line of MDI and a program may change is decided where it is changed: by the role they carry.
TEST_F(GatewayAccess, RequestsToTheMachineCarryTheRoleOfWhoAsks) {
  add("ann", Role::machine_operator), add("sam", Role::setter), add("bo", Role::administrator);
  set("operating_right: any");
  start();
  const std::vector<std::pair<std::string, int>> users{{"ann", 0}, {"sam", 1}, {"bo", 2}};
  for (const auto& [name, role] : users) {
    const auto cookie = session(name);
    EXPECT_EQ(ask("POST", "/api/channels/0/mdi", {{"line", "G10 L2 P1 X1"}}, cookie).status, 200);
    if (role > 0) {
      EXPECT_EQ(ask("PUT", "/api/parameters/11", {{"value", 0.2}}, cookie).status, 200);
      EXPECT_LT(http_client::request(port_, "PUT", "/api/programs/P.NC", "M30\n", cookie).status, 300);
    }
    const std::lock_guard lock(mutex_);
    EXPECT_EQ(cluster_.channel_requests.back().who, name);
    EXPECT_EQ(cluster_.channel_requests.back().role, role);
    if (role == 0) continue;
    EXPECT_EQ(cluster_.parameter_requests.back().role, role);
    EXPECT_EQ(cluster_.stored_by["P.NC"], role);
  }
}

TEST_F(GatewayAccess, TheOperatorJournalSaysWhoWasLoggedInByBothWays) {
  add("ann", Role::machine_operator);
  start();
  bus::Bus bus(bus::Vendor::cyclonedds, {domain});
  auto reader = bus.reader(topics::operator_request);
  const auto ann = session("ann");
  std::map<std::string, std::string> users;  // of the lines by target
  const auto told = [&](const std::string& target, const std::function<void()>& order) {
    users.clear();
    order();
    return eventually([&] {
      idl::gateway::OperatorRequest line;
      while (reader.take(line)) users[line.target] = line.user;
      return users.contains(target);
    });
  };
  const auto start_cycle = [&] {
    EXPECT_EQ(ask("POST", "/api/channels/0/cycle-start", json::object(), ann).status, 200);
  };
  // The reader is new: until it is known, lines pass it by.
  EXPECT_TRUE(eventually([&] {
    start_cycle();
    idl::gateway::OperatorRequest line;
    return reader.take(line);
  }));
  EXPECT_TRUE(told("/api/channels/0/cycle-start", start_cycle));
  EXPECT_EQ(users["/api/channels/0/cycle-start"], "ann");
  http_client::WebSocketClient stream(port_, "/api/stream", 0, ann);
  ASSERT_TRUE(stream.open());
  EXPECT_TRUE(told("/api/channels/0/feed-hold",
                   [&] { stream.send(R"({"order": 1, "path": "/api/channels/0/feed-hold"})"); }));
  EXPECT_EQ(users["/api/channels/0/feed-hold"], "ann");
  EXPECT_TRUE(told("/api/panel/emergency-stop",
                   [&] { EXPECT_EQ(ask("POST", "/api/panel/emergency-stop").status, 200); }));
  EXPECT_EQ(users["/api/panel/emergency-stop"], "") << "everybody may";
}

TEST_F(GatewayAccess, OneStationOperatesAndHandsOverWithConsentOrToASetter) {
  add("ann", Role::machine_operator);
  add("bob", Role::machine_operator);
  add("sam", Role::setter);
  start();
  const auto ann = session("ann"), bob = session("bob"), sam = session("sam");
  const auto change = [&](const char* action, const std::string& who) {
    return json::parse(ask("POST", "/api/operating-right", {{"action", action}}, who).body);
  };
  EXPECT_EQ(ask("POST", "/api/channels/0/cycle-start", json::object(), ann).status, 200);
  const auto refused = ask("POST", "/api/channels/0/reset", json::object(), bob);
  EXPECT_EQ(refused.status, 409);
  EXPECT_THAT(refused.body, HasSubstr("ann (127.0.0.1) operates this machine"));
  EXPECT_EQ(ask("POST", "/api/channels/0/feed-hold", json::object(), bob).status, 200);
  const auto asked = change("take", bob);
  EXPECT_FALSE(asked["mine"]);
  EXPECT_EQ(asked["asking"]["name"], "bob (127.0.0.1)");
  EXPECT_TRUE(change("hand_over", ann)["holder"]["name"] == "bob (127.0.0.1)");
  EXPECT_EQ(ask("POST", "/api/channels/0/reset", json::object(), ann).status, 409);
  EXPECT_TRUE(change("take", sam)["mine"]) << "a setter needs no consent";
  EXPECT_EQ(ask("DELETE", "/api/session", json::object(), sam).status, 200);
  EXPECT_EQ(ask("POST", "/api/channels/0/reset", json::object(), ann).status, 200)
      << "a logout gives it back";
  EXPECT_EQ(ask("GET", "/api/operating-right").status, 401);
  EXPECT_TRUE(eventually([&] {
    return journal().find("\"what\":\"hands the right to operate to bob (127.0.0.1)\"") != std::string::npos;
  })) << journal();
}

TEST_F(GatewayAccess, ASessionEndsWithItsStreamAlthoughThePageGoesOnAsking) {
  add("ann", Role::machine_operator);
  set("session_idle_minutes: 0.05");  // 3 s
  start();
  const auto ann = session("ann");
  EXPECT_EQ(ask("GET", "/api/status", {}, ann).status, 200);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(6);
  int status = 200;
  while (status == 200 && std::chrono::steady_clock::now() < until) {
    status = ask("GET", "/api/plc/image", {}, ann).status;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(status, 401);
  EXPECT_EQ(ask("GET", "/api/status", {}, ann).status, 401);
}

TEST_F(GatewayAccess, AUserWhoIsRemovedIsOutWithinSeconds) {
  add("ann", Role::machine_operator);
  add("sam", Role::setter);
  start();
  const auto ann = session("ann"), sam = session("sam");
  auto users = *access::load_users(state());
  std::erase_if(users.users, [](const auto& one) { return one.name == "ann"; });
  access::save_users(state(), users);
  EXPECT_TRUE(eventually([&] { return ask("GET", "/api/status", {}, ann).status == 401; }));
  EXPECT_EQ(ask("GET", "/api/status", {}, sam).status, 200);
}

TEST_F(GatewayAccess, WrongPasswordsAreThrottled) {
  add("ann", Role::machine_operator);
  start();
  const auto wrong = login("ann", "wrong");
  EXPECT_EQ(wrong.status, 401);
  EXPECT_EQ(wrong.body, login("nobody", "wrong").body) << "it does not say which names exist";
  Response answer;
  for (int i = 0; i < 8 && answer.status != 429; ++i) answer = login("ann", "wrong");
  EXPECT_EQ(answer.status, 429);
  EXPECT_EQ(answer.headers.at("retry-after"), "1");
  EXPECT_EQ(ask("POST", "/api/panel/emergency-stop").status, 200);
  for (const char* body : {"{}", "[]", R"({"name":"ann"})", R"({"name":1,"password":"x"})",
                           R"({"name":"ann","password":"x","role":"administrator"})"})
    EXPECT_EQ(http_client::request(port_, "POST", "/api/session", body).status, 400) << body;
}

TEST_F(GatewayAccess, ATokenIsForPrograms) {
  access::Users users;
  users.tokens.push_back({"mes", Role::machine_operator, access::digest("secret")});
  access::save_users(state(), users);
  start();
  EXPECT_EQ(ask("GET", "/api/status", {}, "Authorization: Bearer secret\r\n").status, 200);
  EXPECT_EQ(ask("PUT", "/api/parameters/11", {{"value", 0.2}}, "Authorization: Bearer secret\r\n").status,
            403);
}

TEST_F(GatewayAccess, TheFirstStartMakesAnAdministratorAndSaysSo) {
  start();
  std::ifstream in(state() + "/initial-password");
  std::string password;
  std::getline(in, password);
  EXPECT_EQ(password.size(), 16u);
  EXPECT_EQ(login("admin", password).status, 200);
  std::ifstream log(scratch_ + "/stderr.txt");
  const std::string text{std::istreambuf_iterator<char>(log), {}};
  EXPECT_THAT(text, HasSubstr("the administrator 'admin' was created"));
  EXPECT_EQ(text.find(password), std::string::npos);
}

TEST_F(GatewayAccess, AnAddressOfANetworkNeedsUsers) {
  auto arguments = command_line(port_, scratch_ + "/web");
  arguments.insert(arguments.end(), {"--address", "0.0.0.0"});
  Process process(arguments, scratch_ + "/stderr.txt");
  EXPECT_EQ(process.wait(), 1);
  std::ifstream log(scratch_ + "/stderr.txt");
  const std::string text{std::istreambuf_iterator<char>(log), {}};
  EXPECT_THAT(text, HasSubstr("set 'auth: on' in machine.yaml"));
}

}  // namespace
}  // namespace trunnion::gateway
