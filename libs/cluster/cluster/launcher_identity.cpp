// SPDX-License-Identifier: Apache-2.0
#include "cluster/launcher_identity.hpp"

#include <pwd.h>
#include <unistd.h>

#include <ctime>
#include <nlohmann/json.hpp>
#include <random>

#include "contracts/topics.hpp"
#include "text/instant.hpp"
#include "trunnion/version.hpp"

namespace trunnion::cluster {
namespace {

std::string user_name() {
  const passwd* user = getpwuid(geteuid());
  return (user != nullptr ? std::string(user->pw_name) : std::to_string(geteuid())).substr(0, 31);
}

}  // namespace

Identity make_identity(const std::string& machine, std::uint32_t instance, bool open) {
  std::random_device random;
  char host[64] = {};
  gethostname(host, sizeof host - 1);
  Identity identity;
  identity.identity = (static_cast<std::uint64_t>(random()) << 32) ^ random();
  identity.instance = instance;
  identity.machine = machine.substr(0, 63);
  identity.host = host;
  identity.user = user_name();
  identity.pid = getpid();
  identity.since = static_cast<std::uint64_t>(std::time(nullptr));
  identity.contract = topics::contract_hash;
  identity.version = version;
  identity.open = open;
  return identity;
}

std::string describe(const Identity& identity, std::uint32_t domain) {
  return "launcher " + std::to_string(identity.pid) + " of user " + identity.user + " on host " +
         identity.host + " (machine " + identity.machine + ", domain " + std::to_string(domain) + ", since " +
         text::whole_second(static_cast<std::time_t>(identity.since)) + ")";
}

std::string write_identity(const Identity& identity, std::uint32_t domain) {
  return nlohmann::json{{"identity", identity.identity},
                        {"instance", identity.instance},
                        {"machine", identity.machine},
                        {"host", identity.host},
                        {"user", identity.user},
                        {"pid", identity.pid},
                        {"since", identity.since},
                        {"contract", identity.contract},
                        {"version", identity.version},
                        {"open", identity.open},
                        {"domain", domain}}
             .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
         "\n";
}

Identity read_identity(const std::string& line, std::uint32_t& domain) {
  Identity identity;
  const auto json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object()) return identity;
  try {
    identity.identity = json.value("identity", std::uint64_t{0});
    identity.instance = json.value("instance", std::uint32_t{0});
    identity.machine = json.value("machine", "");
    identity.host = json.value("host", "");
    identity.user = json.value("user", "");
    identity.pid = json.value("pid", 0);
    identity.since = json.value("since", std::uint64_t{0});
    identity.contract = json.value("contract", "");
    identity.version = json.value("version", "");
    identity.open = json.value("open", false);
    domain = json.value("domain", std::uint32_t{0});
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return identity;
}

bool conflict(const Identity& a, const Identity& b) {
  return a.identity != b.identity && (a.machine != b.machine || a.instance == b.instance);
}

}  // namespace trunnion::cluster
