// SPDX-License-Identifier: Apache-2.0
// DDS Security: who has the right certificate takes part, who has not neither writes nor reads. Every
// participant is a process of its own, as in a cluster.
#include <array>
#include <cstdio>
#include <future>
#include <set>
#include <sstream>

#include "cluster_harness.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;

std::string output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer;
  while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  return pclose(pipe) == 0 ? text : "failed: " + text;
}

/// Certificates of an authority of its own.
class Authority {
 public:
  explicit Authority(const std::string& name)
      : directory_(fs::temp_directory_path() / ("trunnion-" + name + "-" + std::to_string(getpid()))) {
    fs::remove_all(directory_);
    const auto made = output_of(std::string(TRUNNION_SECURITY) + "/make_certificates.sh " + path());
    EXPECT_NE(made.find("24 identities"), std::string::npos) << made;
  }
  ~Authority() { fs::remove_all(directory_); }
  Authority(const Authority&) = delete;
  Authority& operator=(const Authority&) = delete;
  std::string path() const { return directory_.string(); }

 private:
  fs::path directory_;
};

struct Peer {
  std::string vendor, identity, security;  ///< without the last two it has no certificate
};

/// What a peer did: how many others it found, how many samples it got from whom or wrote, or why it was
/// refused.
struct Result {
  int matched = 0;
  std::map<int, int> samples;  // by the writer's mark
  std::string text;
};

std::future<Result> start(const Peer& peer, const std::string& action, std::uint32_t domain, int mark = 0,
                          const std::string& topic = "path_batch", double seconds = 4) {
  const std::string command =
      cluster::binary_directory() + "/security-peer --domain " + std::to_string(domain) + " --vendor " +
      peer.vendor + " --mark " + std::to_string(mark) + " --seconds " + std::to_string(seconds) +
      (peer.security.empty() ? "" : " --security " + peer.security + " --identity " + peer.identity) + " " +
      action + " " + topic;
  return std::async(std::launch::async, [command] {
    Result result;
    result.text = output_of(command);
    const auto at = result.text.rfind("matched ");
    if (at == std::string::npos) return result;
    std::istringstream told(result.text.substr(at + 8));
    told >> result.matched;
    char colon = 0;
    for (int from = 0, count = 0; told >> from >> colon >> count;) result.samples[from] = count;
    return result;
  });
}

std::set<int> heard(const Result& result) {
  std::set<int> marks;
  for (const auto& [mark, count] : result.samples) marks.insert(mark);
  return marks;
}

// All of them take part at once, so that what the rightful ones reach shows that the others could have.
TEST(Security, OnlyTheChannelWritesThePathAndOnlyTheKinematicsReadsItOnBothVendorsAndAcrossThem) {
  const Authority ours("security"), foreign("rogue");
  const auto domain = cluster::free_domain();
  const std::vector<std::string> vendors{"cyclonedds", "fastdds"};
  // Whoever has its certificate from `stolen` is the program service and shows the permissions of the
  // channel.
  const auto stolen = ours.path() + "/stolen";
  fs::create_directories(stolen);
  for (const auto* file : {"ca.pem", "governance.p7s"})
    fs::copy(ours.path() + "/" + file, stolen + "/" + file);
  for (const auto& vendor : vendors) {
    const auto own = fs::path(stolen) / ("program-" + vendor);
    fs::copy(fs::path(ours.path()) / ("program-" + vendor), own);
    fs::copy(fs::path(ours.path()) / ("channel-" + vendor) / "permissions.p7s", own / "permissions.p7s",
             fs::copy_options::overwrite_existing);
  }
  struct {
    std::string name, identity, security;
    std::vector<std::future<Result>> running = {};
  } readers[] = {{"the kinematics", "kinematics", ours.path()},
                 {"one without certificate", "", ""},
                 {"one with another authority's certificate", "kinematics", foreign.path()},
                 {"the program service", "program", ours.path()}},
    writers[] = {{"the channel", "channel", ours.path()},
                 {"one without certificate", "", ""},
                 {"one with another authority's certificate", "channel", foreign.path()},
                 {"the program service", "program", ours.path()},
                 {"the program service with the channel's permissions", "program", stolen}};
  for (auto& reader : readers)
    for (const auto& vendor : vendors)
      reader.running.push_back(start({vendor, reader.identity, reader.security}, "read", domain));
  int mark = 0;  // of the writers: 1 and 2 the channel, 3 and 4 without certificate, ...
  for (auto& writer : writers)
    for (const auto& vendor : vendors)
      writer.running.push_back(start({vendor, writer.identity, writer.security}, "write", domain, ++mark));

  // Strangers do reach each other, and so do those of the other authority: they are there, and they try.
  const std::set<int> may_hear[] = {{1, 2}, {3, 4}, {5, 6}, {}};
  const int matched[] = {2, 2, 2, 0, 0};
  for (std::size_t i = 0; i < std::size(readers); ++i)
    for (std::size_t v = 0; v < vendors.size(); ++v) {
      const auto result = readers[i].running[v].get();
      EXPECT_EQ(heard(result), may_hear[i]) << readers[i].name << " on " << vendors[v] << ": " << result.text;
      for (const auto& [from, count] : result.samples) EXPECT_GT(count, 20) << result.text;
    }
  for (std::size_t i = 0; i < std::size(writers); ++i)
    for (std::size_t v = 0; v < vendors.size(); ++v) {
      const auto result = writers[i].running[v].get();
      EXPECT_EQ(result.matched, matched[i]) << writers[i].name << " on " << vendors[v] << ": " << result.text;
    }
  cluster::RunDirectory{domain}.remove();
}

/// The services with `topic` in the part `verb` of their permissions, on both vendors.
std::set<std::string> who_may(const fs::path& directory, const std::string& verb, const std::string& topic) {
  std::map<std::string, int> found;
  for (const auto& entry : fs::directory_iterator(directory)) {
    if (!entry.is_directory()) continue;
    const auto identity = entry.path().filename().string();
    std::ifstream in(entry.path() / "permissions.xml");
    const std::string text(std::istreambuf_iterator<char>(in), {});
    EXPECT_NE(text.find("<default>DENY</default>"), std::string::npos) << identity;
    const auto begin = text.find("<" + verb + ">"), end = text.find("</" + verb + ">");
    if (begin != std::string::npos &&
        text.substr(begin, end - begin).find("<topic>" + topic + "</topic>") != std::string::npos)
      ++found[identity.substr(0, identity.find('-'))];
  }
  std::set<std::string> services;
  for (const auto& [service, vendors] : found)
    if (vendors == 2) services.insert(service);
  EXPECT_EQ(services.size(), found.size()) << topic << ": the same on both vendors";
  return services;
}

TEST(Security, PermissionsAreThoseOfTheTopics) {
  const auto directory = fs::temp_directory_path() / ("trunnion-permissions-" + std::to_string(getpid()));
  fs::create_directories(directory);
  const auto generate = [&](const std::string& table) {
    return output_of(TRUNNION_PYTHON " " TRUNNION_SECURITY "/documents.py " + table + " " +
                     directory.string());
  };
  EXPECT_EQ(generate(TRUNNION_SECURITY "/../../idl/topics.yaml"), "");
  using Names = std::set<std::string>;
  for (const auto& [topic, writer] : {std::pair<std::string, std::string>{"channel/path_batch/1", "channel"},
                                      {"kinematics/axis_batch/1", "kinematics"},
                                      {"compensation/axis_batch/1", "compensation"},
                                      {"gantry/axis_batch/1", "gantry"},
                                      {"drive/feedback/1", "drive"},
                                      {"plc/outputs/1", "plc"},
                                      {"parameters/set/1", "parameters"}})
    EXPECT_EQ(who_may(directory, "publish", "trunnion/" + topic), Names{writer}) << topic;
  EXPECT_EQ(who_may(directory, "subscribe", "trunnion/channel/path_batch/1"),
            (Names{"kinematics", "deploy", "recorder"}));
  EXPECT_EQ(who_may(directory, "publish", "trunnion/service/swap_request/1"), Names{"deploy"})
      << "it carries the path of an executable";
  EXPECT_EQ(who_may(directory, "publish", "trunnion/channel/request/1"),
            (Names{"deploy", "gateway", "measurement", "plc"}))
      << "the operator panel";
  EXPECT_EQ(who_may(directory, "publish", "trunnion/service/alarm_reset/1"),
            (Names{"deploy", "gateway", "plc"}))
      << "G2960.3 of the PLC is an external reset";
  EXPECT_EQ(who_may(directory, "publish", "trunnion/service/state/1").count("recorder"), 0u)
      << "all who take part in the machine, not who looks on";

  // They follow the table of topics and nothing else.
  const auto table_of = [&](const std::string& topics) {
    std::ofstream(directory / "topics.yaml") << "standby_suffix: /standby\ntopics:\n" << topics;
    return (directory / "topics.yaml").string();
  };
  EXPECT_EQ(generate(table_of("  - {name: swarf, qos: state, writers: [plc], readers: [gateway]}\n")), "");
  EXPECT_EQ(who_may(directory, "publish", "swarf"), Names{"plc"});
  EXPECT_EQ(who_may(directory, "subscribe", "swarf"), (Names{"gateway", "deploy", "recorder"}));
  EXPECT_EQ(who_may(directory, "publish", "trunnion/channel/path_batch/1"), Names{});
  EXPECT_NE(generate(table_of("  - {name: swarf, qos: state, writers: [conveyor], readers: []}\n"))
                .find("topic swarf names the unknown service conveyor"),
            std::string::npos);
  fs::remove_all(directory);
}

class SecureCluster : public testing::TestWithParam<const char*> {
 protected:
  // Not for the suite: what fails there makes GoogleTest skip the test, and CTest would count that as passed.
  void SetUp() override {
    if (!authority_) authority_ = std::make_unique<Authority>("cluster");
  }
  static void TearDownTestSuite() { authority_.reset(); }
  static inline std::unique_ptr<Authority> authority_;
};

TEST_P(SecureCluster, RunsAProgramAndTakesARestartedServiceBackWhileARogueNeitherReadsNorWritesSetpoints) {
  const auto directory = authority_->path() + "/machine-" + GetParam();
  fs::copy(cluster::find_machine("ac-table"), directory, fs::copy_options::recursive);
  std::ofstream(directory + "/machine.yaml", std::ios::app) << "security: " << authority_->path() << "\n";
  Cluster cluster(directory, Time::virtual_, GetParam());
  const auto domain = cluster.running().run.domain;
  const std::string vendor = GetParam(), rogue_vendor = vendor == "mixed" ? "cyclonedds" : vendor;
  auto spy = start({rogue_vendor, "", ""}, "read", domain, 0, "gantry_batch");
  // Not the same topic: the two would talk to each other.
  auto rogue = start({rogue_vendor, "", ""}, "write", domain, 7, "path_batch");
  std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  for (int i = 0; i < 4; ++i) text += "X60 Y30 A20 C40 F6000\nX-60 Y-30 A-10 C-20\n";
  text += "X0 Y0 A0 C0\nG49\nM30\n";
  cluster.start_text(text);
  ASSERT_TRUE(cluster.finish()) << cluster.told();
  EXPECT_EQ(cluster.active_alarms(), "");

  const auto pid = cluster.service("kinematics")->pid;
  ASSERT_EQ(kill(pid, SIGKILL), 0);
  ASSERT_TRUE(cluster.until([&] { return cluster.service("kinematics")->pid != pid && cluster.ready(); }))
      << cluster.told();
  cluster.reset_alarms();
  ASSERT_TRUE(cluster.until([&] { return cluster.active_alarms().empty(); })) << cluster.told();
  cluster.start_text(text);
  ASSERT_TRUE(cluster.finish()) << cluster.told();

  const auto read = spy.get(), written = rogue.get();
  EXPECT_EQ(heard(read), std::set<int>{}) << read.text;
  EXPECT_GT(written.samples.at(7), 20) << written.text;
  EXPECT_EQ(written.matched, 0) << "nobody listened";
  EXPECT_FALSE(cluster.has_alarm(103)) << "a foreign batch would differ from ours";
  EXPECT_EQ(cluster.active_alarms(), "");
}

const auto name_of = [](const auto& vendor) { return std::string(vendor.param); };
INSTANTIATE_TEST_SUITE_P(Vendors, SecureCluster, testing::Values("mixed"), name_of);
// Nothing that the mixed one does not have, and 25 s: with --gtest_also_run_disabled_tests.
INSTANTIATE_TEST_SUITE_P(DISABLED_Vendors, SecureCluster, testing::Values("cyclonedds", "fastdds"), name_of);

}  // namespace
}  // namespace trunnion::integration
