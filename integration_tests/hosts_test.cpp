// The cone over three hosts: network namespaces with cables between them that are long, lossy, and cut.
#include <nlohmann/json.hpp>

#include "cluster_harness.hpp"
#include "namespaces.hpp"

namespace trunnion::integration {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<std::vector<double>>;

/// The AC trunnion machine with another lead, once with three hosts and once without.
class Machines {
 public:
  explicit Machines(int lead, const std::string& extra = "")
      : directory_(fs::temp_directory_path() / ("trunnion-hosts-" + std::to_string(getpid()))) {
    fs::remove_all(directory_);
    for (const auto& name : {"one", "three"}) {
      fs::create_directories(directory_);
      fs::copy(deploy::find_machine("ac-table"), directory_ / name, fs::copy_options::recursive);
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
    std::ofstream(file) << text << extra
                        << "hosts:\n  - {name: control, address: 10.77.0.1}\n"
                           "  - {name: motion, address: 10.77.0.2}\n  - {name: drives, address: 10.77.0.3}\n";
  }
  ~Machines() { fs::remove_all(directory_); }
  std::string one() const { return (directory_ / "one").string(); }
  std::string three() const { return (directory_ / "three").string(); }

 private:
  fs::path directory_;
};

/// `trunnion up` on every host, in an order in which nobody finds what it waits for.
void start(const ThreeHosts& hosts, const std::string& machine, const std::string& options) {
  for (const auto* host : {"motion", "drives", "control"}) {
    const auto up =
        hosts.exec(host, deploy::binary_directory() + "/trunnion up " + machine + " --port 18477 --state " +
                             machine + "/state-" + host + " " + options);
    ASSERT_EQ(up.status, 0) << host << ": " << up.text;
    EXPECT_NE(up.text.find(std::string("runs what host ") + host + " has"), std::string::npos) << up.text;
  }
}

/// Empty when every bit is the same.
std::string first_difference(const Rows& rows, const Rows& expected) {
  const auto sizes = std::to_string(rows.size()) + " cycles and " + std::to_string(expected.size());
  for (std::size_t i = 0; i < std::min(rows.size(), expected.size()); ++i)
    for (std::size_t axis = 0; axis < expected[i].size(); ++axis)
      if (rows[i][axis] != expected[i][axis])
        return sizes + ", the first difference at cycle " + std::to_string(i) + ", axis " +
               std::to_string(axis) + ": " + std::to_string(rows[i][axis]) + " and " +
               std::to_string(expected[i][axis]);
  return rows.size() == expected.size() ? "" : sizes;
}

bus::NetworkSettings on_control() {
  bus::NetworkSettings network;
  network.domain = 11;  // machine.yaml's
  network.interface_address = "10.77.0.1";
  network.peers = "10.77.0.1,10.77.0.2,10.77.0.3";
  return network;
}

// Two rounds at 100 mm/s (F6000) with both rotary axes: about 12 s of motion.
const std::string sweep = [] {
  std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  for (int i = 0; i < 4; ++i) text += "X60 Y30 A20 C40 F6000\nX-60 Y-30 A-10 C-20\n";
  return text + "X0 Y0 A0 C0\nG49\nM30\n";
}();

/// Every commanded position of a program on one host, in virtual time.
Rows on_one_host(const Machines& machines, const std::string& program) {
  Cluster cluster(machines.one());
  cluster.keep_rows = true;
  if (program == sweep)
    cluster.start_text(program);
  else
    cluster.start(program);
  EXPECT_TRUE(cluster.finish()) << cluster.told();
  EXPECT_EQ(cluster.lost_frames, 0u);
  return cluster.rows;
}

Rows cone_over_three_hosts(const Machines& machines, ThreeHosts& hosts, const std::string& options = "") {
  start(hosts, machines.three(), "--time virtual " + options);
  hosts.enter("control");
  Rows rows;
  {
    Cluster cluster(on_control());
    cluster.keep_rows = true;
    cluster.start("nas979_cone.nc");
    EXPECT_TRUE(cluster.finish(0, 90)) << cluster.told();
    EXPECT_EQ(cluster.lost_frames, 0u);
    rows = cluster.rows;
  }
  hosts.leave();
  return rows;
}

/// The time for one packet to a host and its answer: nobody listens at TCP port 9 there.
double seconds_to_be_refused(const char* address) {
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(9);
  inet_pton(AF_INET, address, &there.sin_addr);
  const int s = socket(AF_INET, SOCK_STREAM, 0);
  const double began = node::monotonic_seconds();
  EXPECT_NE(connect(s, reinterpret_cast<const sockaddr*>(&there), sizeof there), 0);
  EXPECT_EQ(errno, ECONNREFUSED);
  close(s);
  return node::monotonic_seconds() - began;
}

class Hosts : public testing::Test {
 protected:
  void SetUp() override {
    const auto why = no_namespaces();
    if (!why.empty()) GTEST_SKIP() << why;
  }
};

TEST_F(Hosts, TheConeOverThreeHostsIsTheOneOfOneHostAndStatusShowsAllProcesses) {
  const Machines machines(32);
  const auto expected = on_one_host(machines, "nas979_cone.nc");
  ThreeHosts hosts;
  const auto rows = cone_over_three_hosts(machines, hosts);
  EXPECT_GT(rows.size(), 10000u);
  EXPECT_EQ(first_difference(rows, expected), "");
  for (const auto* host : {"control", "motion", "drives"}) {
    const auto status = hosts.exec(host, deploy::binary_directory() + "/trunnion status --json");
    EXPECT_EQ(status.status, 0) << status.text;
    const auto json = nlohmann::json::parse(status.text, nullptr, false);
    ASSERT_TRUE(json.is_object()) << status.text;
    std::map<std::string, std::string> where;
    for (const auto& row : json["services"]) {
      EXPECT_EQ(row["state"], "ACTIVE") << row.dump();
      where[row["service"]] = row["host"];
    }
    EXPECT_EQ(where["kinematics"], "motion");
    EXPECT_EQ(where["drive"], "drives");
    EXPECT_EQ(where["channel"], "control");
    EXPECT_EQ(where.size(), 9u) << "every service of machine.yaml, the gateway too";
  }
}

TEST_F(Hosts, MulticastFindsTheOthersOnBothVendorsAndTheConeIsTheSame) {
  const Machines machines(32, "network: multicast\n");
  const auto expected = on_one_host(machines, "nas979_cone.nc");
  ThreeHosts hosts;
  EXPECT_EQ(first_difference(cone_over_three_hosts(machines, hosts, "--vendor mixed"), expected), "");
}

TEST_F(Hosts, OnePercentLossAndTwoMillisecondsEachWayChangeNoBit) {
  const Machines machines(32);
  const auto expected = on_one_host(machines, "nas979_cone.nc");
  ThreeHosts hosts(ThreeHosts::Cables::long_);
  hosts.enter("control");
  EXPECT_GE(seconds_to_be_refused("10.77.0.3"), 0.004) << "the cables are as long as they should be";
  hosts.leave();
  hosts.expect("loss", "1");
  const auto rows = cone_over_three_hosts(machines, hosts);
  EXPECT_GT(rows.size(), 10000u);
  EXPECT_EQ(first_difference(rows, expected), "");
  const auto dropped = hosts.exec("motion", "iptables -L INPUT -v -x -n");
  std::istringstream lines(dropped.text);
  std::string line;
  std::getline(lines, line), std::getline(lines, line), std::getline(lines, line);
  EXPECT_GT(std::atoi(line.c_str()), 10) << "packets were lost: " << dropped.text;
}

TEST_F(Hosts, ACableCutForFiftyMillisecondsInsideTheLeadIsNotNoticed) {
  // docs/hosts.md computes it: the reserve for stopping, the cut, and what it takes until the lost frames
  // have come.
  const Machines machines(256);
  const auto expected = on_one_host(machines, sweep);
  ThreeHosts hosts;
  start(hosts, machines.three(), "--time real");
  hosts.enter("control");
  {
    Cluster cluster(on_control());
    cluster.keep_rows = true;
    cluster.start_text(sweep);
    ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].line >= 6; })) << cluster.told();
    const auto before = cluster.feedback.starved;
    hosts.expect("cut", " motion 0.05");
    ASSERT_TRUE(cluster.finish()) << cluster.told();
    EXPECT_FALSE(cluster.has_alarm(110)) << cluster.told();
    EXPECT_EQ(cluster.feedback.starved, before);
    EXPECT_EQ(cluster.lost_frames, 0u);
    EXPECT_EQ(first_difference(cluster.rows, expected), "");
  }
  hosts.leave();
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

TEST_F(Hosts, ACableCutForOneSecondStopsAlongThePathAndTheProgramGoesOn) {
  const Machines machines(64);
  const auto expected = on_one_host(machines, sweep);
  ThreeHosts hosts;
  start(hosts, machines.three(), "--time real");
  hosts.enter("control");
  {
    Cluster cluster(on_control());
    cluster.keep_rows = true;
    cluster.start_text(sweep);
    ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].line >= 6; })) << cluster.told();
    hosts.expect("cut", " motion 1");
    ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(110); })) << cluster.told();
    constexpr int held = 2;
    ASSERT_TRUE(cluster.until([&] { return cluster.feedback.mode == held; })) << cluster.told();
    ASSERT_TRUE(cluster.until([&] { return cluster.state() != RunState::RUNNING; })) << cluster.told();
    std::string refusal;
    ASSERT_TRUE(cluster.until([&] {
      cluster.reset_alarms();
      try {
        cluster.client().channel(0, CommandKind::CYCLE_START);
        return true;
      } catch (const std::exception& e) {
        refusal = e.what();
        return false;
      }
    })) << refusal
        << cluster.told();
    ASSERT_TRUE(cluster.until([&] { return cluster.state() == RunState::RUNNING; })) << cluster.told();
    ASSERT_TRUE(cluster.finish()) << cluster.told();
    // The path is sampled every millisecond at 100 mm/s and up to 40 deg/s; half a sample is 0.05 mm and 0.02
    // deg, the stop and the start between samples are as near, and the tolerance of the path is 0.01 mm.
    double farthest = 0;
    for (const auto& row : cluster.rows) {
      // The undisturbed path goes over the same line several times; the nearest of all its samples counts.
      double best = 1e9;
      for (std::size_t i = 0; i < expected.size(); ++i) best = std::min(best, distance(row, expected[i]));
      farthest = std::max(farthest, best);
    }
    EXPECT_EQ(cluster.rows.size(), expected.size()) << "every cycle of the program, only later";
    EXPECT_LT(farthest, 0.1) << "never off the path";
    EXPECT_LT(distance(cluster.rows.back(), expected.back()), 1e-9) << "and at its end";
  }
  hosts.leave();
}

TEST_F(Hosts, EachMistakeIsOneLine) {
  const Machines machines(32);
  ThreeHosts hosts;
  const auto up = [&](const std::string& options) {
    return hosts
        .exec("motion", deploy::binary_directory() + "/trunnion up " + machines.three() + " " + options)
        .text;
  };
  EXPECT_NE(up("--host printer").find("has no host 'printer': there is control, motion, drives\n"),
            std::string::npos);
  const auto wrong = up("--host drives");
  EXPECT_NE(wrong.find("host 'drives' has the address 10.77.0.3, which is none of this computer's"),
            std::string::npos)
      << wrong;
  EXPECT_EQ(std::count(wrong.begin(), wrong.end(), '\n'), 1) << wrong;
}

}  // namespace
}  // namespace trunnion::integration
