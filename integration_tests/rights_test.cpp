// SPDX-License-Identifier: Apache-2.0
// idl/topics.yaml says who writes and who reads a topic, and in a secured cluster these are rights. Here the
// table is compared with what the processes of a whole cluster open, as DDS discovery tells it.
#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>

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

/// Collects what every participant of a domain opens, by the identity in the participant's user data.
class Discovery {
 public:
  explicit Discovery(std::uint32_t domain)
      : participant_(dds_create_participant(domain, nullptr, nullptr)),
        participants_(dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr)),
        writers_(dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr)),
        readers_(dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr, nullptr)) {
    EXPECT_GT(readers_, 0);
    thread_ = std::thread([this] {
      while (!stop_) {
        take();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    });
  }
  ~Discovery() {
    stop_ = true;
    thread_.join();
    dds_delete(participant_);
  }

  std::map<std::string, Endpoints> by_identity() {
    const std::lock_guard lock(mutex_);
    std::map<std::string, Endpoints> result;
    for (const auto& [key, found] : found_)
      if (const auto identity = identities_.find(key); identity != identities_.end()) {
        auto& endpoints = result[identity->second];
        endpoints.written.insert(found.written.begin(), found.written.end());
        endpoints.read.insert(found.read.begin(), found.read.end());
      }
    return result;
  }

 private:
  template <class Sample, class Use>
  static void take_all(dds_entity_t reader, Use use) {
    constexpr int most = 32;
    void* samples[most] = {};
    dds_sample_info_t infos[most];
    for (int count; (count = dds_take(reader, samples, infos, most, most)) > 0;) {
      for (int i = 0; i < count; ++i)
        if (infos[i].valid_data) use(*static_cast<const Sample*>(samples[i]));
      dds_return_loan(reader, samples, count);
    }
  }
  static std::string text_of(const dds_guid_t& key) {
    return {reinterpret_cast<const char*>(key.v), sizeof key.v};
  }
  /// A stage that is to replace another writes beside it; the right to the topic includes that.
  static std::string handle_of(std::string topic) {
    const std::string beside = topics::standby_suffix;
    if (topic.ends_with(beside)) topic.resize(topic.size() - beside.size());
    const auto* entry = bus::find_topic(topic);
    return entry != nullptr ? entry->handle : topic;
  }
  void take() {
    const std::lock_guard lock(mutex_);
    take_all<dds_builtintopic_participant_t>(participants_, [&](const auto& sample) {
      void* data = nullptr;
      std::size_t size = 0;
      if (sample.qos != nullptr && dds_qget_userdata(sample.qos, &data, &size) && size > 0)
        identities_[text_of(sample.key)] = std::string(static_cast<const char*>(data), size);
      dds_free(data);
    });
    take_all<dds_builtintopic_endpoint_t>(writers_, [&](const auto& sample) {
      found_[text_of(sample.participant_key)].written.insert(handle_of(sample.topic_name));
    });
    take_all<dds_builtintopic_endpoint_t>(readers_, [&](const auto& sample) {
      found_[text_of(sample.participant_key)].read.insert(handle_of(sample.topic_name));
    });
  }

  dds_entity_t participant_, participants_, writers_, readers_;
  std::mutex mutex_;
  std::map<std::string, std::string> identities_;
  std::map<std::string, Endpoints> found_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
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
  const RedundantMachine machine;
  Cluster cluster(machine.path(), Time::virtual_, "mixed", true);
  const auto domain = cluster.running().run.domain;
  Discovery discovery(domain);
  const auto here = cluster::binary_directory();
  const auto more = " --domain " + std::to_string(domain);
  const auto recording = machine.path() + "/day.mcap";
  EXPECT_EQ(failure(here + "/trunnion record " + recording + " --duration 1" + more), "");
  // A process that is to replace another opens what it needs to be compared with it.
  for (const auto& service : machine::service::all)
    EXPECT_EQ(failure(here + "/trunnion swap " + service.name + more), "") << service.name;
  ASSERT_TRUE(cluster.until([&] { return cluster.ready(); })) << cluster.told();
  // What a command or a process on standby opens exists for less than a second, so the discovery may miss it;
  // a stage that was swapped may still be about to open the feedback. What was seen is kept, so such a
  // command is given again, and such a service swapped again.
  const auto commands_are_seen = [&] {
    const auto opened = discovery.by_identity();
    const auto found = opened.find("deploy");
    return found != opened.end() &&
           found->second.written == granted("deploy", false, &bus::TopicEntry::writers);
  };
  for (int round = 0; round == 0 || (round < 5 && !cluster.until(commands_are_seen, 1)); ++round)
    for (const std::string command : {"servo test current --axis X", "plc variables", "calibrate discard"})
      EXPECT_EQ(failure(here + "/trunnion " + command + more), "") << command;
  const auto is_seen = [&](const machine::ServiceDefinition& service) {
    const auto opened = discovery.by_identity();
    const auto found = opened.find(service.name);
    return found != opened.end() &&
           found->second.written == granted(service.name, true, &bus::TopicEntry::writers) &&
           found->second.read == granted(service.name, true, &bus::TopicEntry::readers);
  };
  for (const auto& service : machine::service::all)
    for (int round = 0; round < 5 && !cluster.until([&] { return is_seen(service); }, 1); ++round)
      failure(here + "/trunnion swap " + service.name + more);
  const auto opened = discovery.by_identity();
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
