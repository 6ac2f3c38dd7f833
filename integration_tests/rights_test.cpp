// SPDX-License-Identifier: Apache-2.0
// idl/topics.yaml says who writes and who reads a topic, and in a secured cluster these are rights. Here the
// table is compared with what the processes of a whole cluster open.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "bus/registry.hpp"
#include "cluster/cluster_files.hpp"
#include "cluster_harness.hpp"
#include "machine/services.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;
using Handles = std::set<std::string>;

struct Endpoints {
  Handles written, read;
};

/// What the processes of a cluster open, by their identities, as they log it themselves: discovery would miss
/// what exists for a moment only, as the feedback reader of a stage until it is in step.
class OpenedEndpoints {
 public:
  OpenedEndpoints() : file_(fs::temp_directory_path() / ("trunnion-endpoints-" + std::to_string(getpid()))) {
    fs::remove(file_);
    setenv("TRUNNION_ENDPOINTS", file_.c_str(), 1);
  }
  ~OpenedEndpoints() {
    unsetenv("TRUNNION_ENDPOINTS");
    fs::remove(file_);
  }
  OpenedEndpoints(const OpenedEndpoints&) = delete;
  OpenedEndpoints& operator=(const OpenedEndpoints&) = delete;

  std::map<std::string, Endpoints> by_identity() const {
    std::map<std::string, Endpoints> result;
    std::ifstream log(file_);
    for (std::string identity, verb, topic; log >> identity >> verb >> topic;)
      (verb == "writes" ? result[identity].written : result[identity].read).insert(handle_of(topic));
    return result;
  }

 private:
  /// A stage that is to replace another writes beside it; the right to the topic includes that.
  static std::string handle_of(std::string topic) {
    const std::string beside = topics::standby_suffix;
    if (topic.ends_with(beside)) topic.resize(topic.size() - beside.size());
    const auto* entry = bus::find_topic(topic);
    return entry != nullptr ? entry->handle : topic;
  }
  fs::path file_;
};

/// The machine with a gantry, a second replica of its kinematics, and every optional service.
class RedundantMachine {
 public:
  RedundantMachine()
      : directory_(fs::temp_directory_path() / ("trunnion-rights-" + std::to_string(getpid()))) {
    fs::copy(std::string(TRUNNION_MACHINES) + "/gantry-cb-head", directory_, fs::copy_options::recursive);
    std::ifstream in(directory_ / "machine.yaml");
    std::string text(std::istreambuf_iterator<char>(in), {});
    const std::string one = "{service: kinematics";
    const auto at = text.find(one);
    EXPECT_NE(at, std::string::npos);
    text.insert(at + one.size(), ", replicas: 2");
    text.insert(at, "{service: measurement}\n  - ");
    std::ofstream(directory_ / "machine.yaml") << text;
  }
  ~RedundantMachine() { fs::remove_all(directory_); }
  RedundantMachine(const RedundantMachine&) = delete;
  RedundantMachine& operator=(const RedundantMachine&) = delete;
  std::string path() const { return directory_.string(); }

 private:
  fs::path directory_;
};

Handles granted(const std::string& identity, bool is_service,
                const std::vector<std::string> bus::TopicEntry::*side) {
  Handles handles;
  for (const auto& topic : bus::all_topics()) {
    const auto& names = topic.*side;
    const auto has = [&](const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (has(identity) || (is_service && has("all"))) handles.insert(topic.handle);
  }
  return handles;
}

/// What the command printed when it failed, else empty.
std::string failure(const std::string& command) {
  std::string printed;
  FILE* const output = popen((command + " 2>&1").c_str(), "r");
  if (output == nullptr) return "cannot be started";
  std::array<char, 512> part{};
  while (std::fgets(part.data(), part.size(), output) != nullptr) printed += part.data();
  const int status = pclose(output);
  return status == 0 ? "" : "exit " + std::to_string(WEXITSTATUS(status)) + ": " + printed;
}

TEST(Rights, EveryRightIsUsedAndNothingIsOpenedWithoutOne) {
  const OpenedEndpoints endpoints_of;
  const RedundantMachine machine;
  Cluster cluster(machine.path(), Time::virtual_, "mixed", true);
  const auto domain = cluster.running().run.domain;
  const auto here = cluster::binary_directory();
  const auto more = " --domain " + std::to_string(domain);
  const auto recording = machine.path() + "/day.mcap";
  EXPECT_EQ(failure(here + "/trunnion record " + recording + " --duration 1" + more), "");
  // A process that is to replace another opens what it needs to be compared with it.
  for (const auto& service : machine::service::all)
    EXPECT_EQ(failure(here + "/trunnion swap " + service.name + more), "") << service.name;
  ASSERT_TRUE(cluster.until([&] { return cluster.ready(); })) << cluster.told();
  for (const std::string command : {"servo test current --axis X", "plc variables", "calibrate discard"})
    EXPECT_EQ(failure(here + "/trunnion " + command + more), "") << command;
  const auto opened = endpoints_of.by_identity();
  for (const auto& service : machine::service::all) {
    ASSERT_TRUE(opened.contains(service.name)) << service.name;
    const auto& endpoints = opened.at(service.name);
    EXPECT_EQ(endpoints.written, granted(service.name, true, &bus::TopicEntry::writers)) << service.name;
    EXPECT_EQ(endpoints.read, granted(service.name, true, &bus::TopicEntry::readers)) << service.name;
  }
  for (const std::string observer : {"deploy", "recorder"}) {  // both may read everything
    ASSERT_TRUE(opened.contains(observer)) << observer;
    EXPECT_EQ(opened.at(observer).written, granted(observer, false, &bus::TopicEntry::writers)) << observer;
  }
}

}  // namespace
}  // namespace trunnion::integration
