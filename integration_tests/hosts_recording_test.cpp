// SPDX-License-Identifier: Apache-2.0
// A recording of a machine on three hosts whose network was interrupted: what `trunnion verify` makes of it.
#include "testing_support/eventually.hpp"
#include "three_host_machine.hpp"

namespace trunnion::integration {
namespace {

/// `trunnion record` on the host of the channel.
class Recorder {
 public:
  Recorder(const ThreeHosts& hosts, std::string file) : file_(std::move(file)) {
    running_ = std::async(std::launch::async, [this, &hosts] {
      return hosts.exec("control", "bash -c 'echo $$ > " + file_ + ".pid; exec " +
                                       cluster::binary_directory() + "/trunnion record " + file_ + " > " +
                                       log() + " 2>&1'");
    });
  }
  ~Recorder() {
    if (running_.valid()) stop();
  }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  bool records() const { return content(log()).find("recording " + file_) != std::string::npos; }
  std::string log() const { return file_ + ".log"; }
  /// Returns when the file is complete.
  std::string stop() {
    const int pid = std::atoi(content(file_ + ".pid").c_str());
    EXPECT_GT(pid, 1);
    if (pid > 1) kill(pid, SIGINT);
    running_.get();
    return content(log());
  }

 private:
  static std::string content(const std::string& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string file_;
  std::future<Shell> running_;
};

// Services that a program of the stream concerns. What stays equal is verified; what does not must say that
// the network was interrupted or which cycles are missing, and a difference without a cause is a failure.
void expect_verified_or_named(const std::string& recording, const std::string& machine) {
  for (const std::string service :
       {"channel", "kinematics", "compensation", "gantry", "drive", "plc", "program", "parameters"}) {
    const Shell verified(cluster::binary_directory() + "/trunnion verify --service " + service +
                         " --recording " + recording + " --machine " + machine);
    const auto says = [&](const char* text) { return verified.text.find(text) != std::string::npos; };
    std::printf("%s\n", verified.text.c_str());
    if (verified.status == 0)
      EXPECT_TRUE(says(": as recorded;")) << verified.text;
    else
      EXPECT_TRUE(says("the network was interrupted (Host ") || says("the recording misses cycles ") ||
                  says("had nothing to do"))
          << service << ": " << verified.text;
  }
}

TEST_F(Hosts, ARecordingOfARunWithAnInterruptionIsVerifiedOrNamesIt) {
  constexpr std::uint32_t first_sweep = 5;  // line
  const Machines machines(64);
  std::string sweeps = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  // 2 x 134 mm at 100 mm/s each, so that the interruption is in the middle of a motion of 54 s.
  for (int i = 0; i < 20; ++i) sweeps += "X60 Y30 A20 C40\nX-60 Y-30 A-10 C-20\n";
  sweeps += "X0 Y0 A0 C0\nG49\nM30\n";
  const auto file = machines.three() + "/cut.mcap";
  ThreeHosts hosts;
  start(hosts, domain, machines.three(), "--time virtual");
  Recorder recorder(hosts, file);
  ASSERT_TRUE(testing_support::eventually([&] { return recorder.records(); })) << recorder.log();
  hosts.enter("control");
  {
    Cluster cluster(on_control(domain));
    cluster.start_text(sweeps);
    EXPECT_TRUE(cluster.until([&] { return cluster.channels[0].line >= first_sweep; })) << cluster.told();
    cut_off_motion(hosts, cluster);
    EXPECT_TRUE(cluster.until([&] { return cluster.state() != RunState::RUNNING; })) << cluster.told();
    // The alarm of the host that was cut off may reach the channel after the start, and holds it once more.
    EXPECT_TRUE(cluster.finish_going_on()) << cluster.told();
  }
  hosts.leave();
  std::printf("%s\n", recorder.stop().c_str());
  expect_verified_or_named(file, machines.three());
}

}  // namespace
}  // namespace trunnion::integration
