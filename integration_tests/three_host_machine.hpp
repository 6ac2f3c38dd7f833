// SPDX-License-Identifier: Apache-2.0
// A machine on three network namespaces, for tests that run as root.
#pragma once

#include "cluster_harness.hpp"
#include "namespaces.hpp"

namespace trunnion::integration {

/// The AC trunnion machine with another lead, once with three hosts and once without.
class Machines {
 public:
  explicit Machines(int lead, const std::string& extra = "", bool secured = false)
      : directory_(std::filesystem::temp_directory_path() / ("trunnion-hosts-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(directory_);
    for (const auto& name : {"one", "three"}) {
      std::filesystem::create_directories(directory_);
      std::filesystem::copy(cluster::find_machine("ac-table"), directory_ / name,
                            std::filesystem::copy_options::recursive);
      std::ofstream(directory_ / name / "parameters.yaml", std::ios::app) << "\"000900\": " << lead << "\n";
    }
    const auto file = directory_ / "three" / "machine.yaml";
    std::ifstream in(file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    in.close();
    for (const auto& [service, host] : {std::pair<std::string, std::string>{"drive", "drives"},
                                        {"gantry", "motion"},
                                        {"compensation", "motion"},
                                        {"kinematics", "motion"}}) {
      const auto line = "{service: " + service + "}";
      EXPECT_NE(text.find(line), std::string::npos);
      text.replace(text.find(line), line.size(), "{service: " + service + ", host: " + host + "}");
    }
    if (secured) {
      const Shell made(TRUNNION_SECURITY "/make_certificates.sh " + certificates());
      EXPECT_EQ(made.status, 0) << made.text;
    }
    std::ofstream(file) << text << extra << (secured ? "security: " + certificates() : "open: true")
                        << "\nhosts:\n  - {name: control, address: 10.77.0.1}\n"
                           "  - {name: motion, address: 10.77.0.2}\n  - {name: drives, address: 10.77.0.3}\n";
  }
  ~Machines() { std::filesystem::remove_all(directory_); }
  std::string one() const { return (directory_ / "one").string(); }
  std::string three() const { return (directory_ / "three").string(); }
  std::string certificates() const { return (directory_ / "certificates").string(); }

 private:
  std::filesystem::path directory_;
};

/// `trunnion up` on every host at once, so that nobody finds what it waits for.
inline void start(const ThreeHosts& hosts, std::uint32_t domain, const std::string& machine,
                  const std::string& options) {
  auto ups = hosts.exec_on_all([&](const std::string& host) {
    return cluster::binary_directory() + "/trunnion up " + machine + " --port 18477 --domain " +
           std::to_string(domain) + " --state " + machine + "/state-" + host + " " + options;
  });
  for (auto& [host, running] : ups) {
    const auto up = running.get();
    ASSERT_EQ(up.status, 0) << host << ": " << up.text;
    EXPECT_NE(up.text.find("runs what host " + host + " has"), std::string::npos) << up.text;
  }
}

inline bus::NetworkSettings on_control(std::uint32_t domain) {
  bus::NetworkSettings network;
  network.domain = domain;
  network.interface_address = "10.77.0.1";
  network.peers = "10.77.0.1,10.77.0.2,10.77.0.3";
  return network;
}

class Hosts : public testing::Test {
 protected:
  void SetUp() override {
    const auto why = no_namespaces();
    if (!why.empty()) GTEST_SKIP() << why;
  }
  /// Cuts host motion off for 3 s, and returns when the machine is ready again. The alarm of motion itself
  /// comes when the cut is over.
  static void cut_off_motion(const ThreeHosts& hosts, Cluster& cluster) {
    hosts.expect("cut", " motion 3");
    for (const auto* side : {"Host motion is silent, and with it ", "Host motion hears no other host"})
      ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(100, side); })) << cluster.told();
    ASSERT_TRUE(cluster.until([&] { return cluster.ready(); })) << cluster.told();
  }
  /// One for each test: a domain keeps the sockets of the namespace in which this process opened it.
  const std::uint32_t domain = 11 + count_++;

 private:
  static inline std::uint32_t count_ = 0;
};

}  // namespace trunnion::integration
