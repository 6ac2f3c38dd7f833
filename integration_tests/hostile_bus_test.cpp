// SPDX-License-Identifier: Apache-2.0
// A foreign process writes every topic while a program runs in virtual time. TRUNNION_HOSTILE_SEED chooses
// what, TRUNNION_HOSTILE_SECONDS how long; `make hostile_bus` sets both.
#include <cstdlib>

#include "bus/registry.hpp"
#include "cluster_harness.hpp"
#include "hostile_writer.hpp"

namespace trunnion::integration {
namespace {

constexpr double round_seconds = 2;

double setting(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr && *text != 0 ? std::atof(text) : otherwise;
}

// Not ended: a process that the launcher has restarted is another one.
bool runs(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  std::getline(file, line);
  const auto name = line.rfind(") ");
  return name != std::string::npos && line[name + 2] != 'Z';
}

class HostileBus : public testing::Test {
 protected:
  HostileBus() {
    for (const auto& service : cluster.list().services) processes.push_back(service);
    std::string text;
    for (int i = 0; i < 400; ++i)
      text += "G53 G1 X" + std::to_string(i % 2 * 20) + " Y" + std::to_string(i % 7) + " F3000\n";
    cluster.client().upload("long.nc", text + "M30\n");
    cluster.client().upload("short.nc", "G53 G1 X5 F3000\nG53 G1 X0\nM30\n");
  }
  std::string ended() const {
    std::string names;
    for (const auto& process : processes)
      if (!runs(process.pid)) names += process.service + " ";
    return names;
  }
  void attack(std::uint64_t seed, const std::set<std::string>& spared = {}) {
    HostileWriter foreign(cluster.running().network, seed, spared);
    const double end = service::monotonic_seconds() + round_seconds;
    while (service::monotonic_seconds() < end) {
      foreign.write();
      cluster.drain();
      cluster.client().bus().signal().wait(0.001);
    }
    for (const auto& written : foreign.written()) messages[written.topic] += written.messages;
  }
  void tell(const char* what) {
    std::uint64_t all = 0, topics = 0;
    for (const auto& [topic, count] : messages) all += count, topics += count > 0;
    std::printf("seed %llu, %s: %llu messages of %llu topics, %zu topics are written by nobody here\n",
                static_cast<unsigned long long>(seed), what, static_cast<unsigned long long>(all),
                static_cast<unsigned long long>(topics), messages.size() - topics);
    EXPECT_GT(all, 0u);
  }
  // What an operator does: emergency stop released, reset, start.
  bool runs_again() {
    return cluster.until([&] {
      try {
        cluster.client().panel(idl::plc::PanelRequestKind::RELEASE_EMERGENCY_STOP);
        cluster.client().panel(idl::plc::PanelRequestKind::RESET_EMERGENCY_STOP);
        cluster.reset_alarms();
        cluster.client().channel(0, CommandKind::RESET);
        cluster.start("short.nc");
        return cluster.finish(0, 10);
      } catch (const std::exception& e) {
        problem = e.what();
        return false;
      }
    });
  }

  const std::uint64_t seed = static_cast<std::uint64_t>(setting("TRUNNION_HOSTILE_SEED", 1));
  const double end = service::monotonic_seconds() + setting("TRUNNION_HOSTILE_SECONDS", 2);
  Cluster cluster{"ac-table"};
  std::vector<idl::service::ClusterService> processes;
  std::map<std::string, std::uint64_t> messages;
  std::string problem;
};

TEST_F(HostileBus, EndsNoService) {
  for (std::uint64_t round = 0; round == 0 || service::monotonic_seconds() < end; ++round) {
    try {
      cluster.start("long.nc");
    } catch (const std::exception&) {
      // What was forged in the round before may hold the machine.
    }
    attack(seed * 1000 + round);
    ASSERT_EQ(ended(), "") << "ended in round " << round << " of seed " << seed;
  }
  tell("every topic");
  EXPECT_EQ(messages.size(), bus::all_topics().size()) << "hostile_writer.cpp names every topic";
}

// States that are written only when they change stay as they were forged until their owner writes them again.
// The stream, whatever is written in cycles, requests and replies must not leave anything behind.
TEST_F(HostileBus, LeavesNothingInTheStreamThatAResetDoesNotEnd) {
  const std::set<std::string> spared = {topics::alarm.name,         topics::cluster.name,
                                        topics::parameter_set.name, topics::tool_table.name,
                                        topics::work_offsets.name,  topics::program_list.name};
  for (std::uint64_t round = 0; round == 0 || service::monotonic_seconds() < end; ++round) {
    cluster.start("long.nc");
    attack(seed * 1000 + round, spared);
    ASSERT_EQ(ended(), "") << "ended in round " << round << " of seed " << seed;
    ASSERT_TRUE(runs_again()) << "round " << round << " of seed " << seed << ": " << problem << "; "
                              << cluster.told();
    ASSERT_EQ(ended(), "") << "ended after round " << round << " of seed " << seed;
  }
  tell("all but kept states");
}

}  // namespace
}  // namespace trunnion::integration
