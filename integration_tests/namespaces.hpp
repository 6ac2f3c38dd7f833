// SPDX-License-Identifier: Apache-2.0
// Network namespaces as hosts, through deploy/network/namespaces.sh, for tests that run as root.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <string>
#include <vector>

#include "cluster/cluster_files.hpp"

namespace trunnion::integration {

/// Output of a shell command, with its exit status.
struct Shell {
  explicit Shell(const std::string& command) {
    FILE* pipe = popen(("{ " + command + "; } 2>&1").c_str(), "r");
    std::array<char, 4096> buffer;
    while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
    status = pclose(pipe);
  }
  int status = -1;
  std::string text;
};

/// Why there can be no namespaces here, or empty.
inline std::string no_namespaces() {
  if (geteuid() != 0) return "needs root for network namespaces";
  for (const char* tool : {"ip", "iptables", "unshare"})
    if (Shell(std::string("command -v ") + tool).status != 0) return std::string("needs the program ") + tool;
  if (access("/dev/net/tun", R_OK | W_OK) != 0) return "needs the device /dev/net/tun";
  const std::string probe = "trunnion-probe-" + std::to_string(getpid());
  const Shell made("ip netns add " + probe);
  if (made.status != 0) return "no network namespaces here: " + made.text;
  const Shell used(
      "ip -n " + probe + " link add name bridge0 type bridge && ip -n " + probe +
      " link add name cable0 type veth peer name cable1 && ip netns exec " + probe +
      " iptables -A INPUT -m statistic --mode random --probability 0.5 -j DROP && ip netns exec " + probe +
      " unshare --mount --uts true");
  const Shell deleted("ip netns del " + probe);
  return used.status == 0 ? ""
                          : "no bridge, cable, packet filter or mounts in a namespace here: " + used.text;
}

/// Three hosts: `control`, `motion` and `drives`, 10.77.0.1 to 10.77.0.3.
class ThreeHosts {
 public:
  enum class Cables { short_, long_ };  ///< a bridge, or a switch with 2 ms delay in each direction

  explicit ThreeHosts(Cables cables = Cables::short_) : prefix_("t" + std::to_string(getpid() % 100000)) {
    const std::string pairs = " control=10.77.0.1 motion=10.77.0.2 drives=10.77.0.3";
    script("down");
    expect(cables == Cables::short_ ? "up" : "bare", pairs);
    if (cables == Cables::short_) return;
    switch_ = popen((cluster::binary_directory() + "/tap-switch 2000 " + prefix_ + "-control " + prefix_ +
                     "-motion " + prefix_ + "-drives > " + switch_log())
                        .c_str(),
                    "w");
    for (int i = 0; i < 500 && Shell("grep -q ready " + switch_log()).status != 0; ++i) usleep(10000);
    expect("address", pairs);
  }
  ~ThreeHosts() {
    leave();
    for (auto& down :
         exec_on_all([](const std::string&) { return cluster::binary_directory() + "/trunnion down"; }))
      (void)down.second.get();
    if (switch_ != nullptr) pclose(switch_);
    std::filesystem::remove(switch_log());
    expect("down", "");
  }
  ThreeHosts(const ThreeHosts&) = delete;
  ThreeHosts& operator=(const ThreeHosts&) = delete;

  Shell script(const std::string& verb, const std::string& arguments = "") const {
    // The script works from outside, wherever this thread is.
    const int here = home_ < 0 ? -1 : open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
    if (here >= 0) {
      EXPECT_EQ(setns(home_, CLONE_NEWNET), 0);
    }
    Shell result(std::string(TRUNNION_NAMESPACES) + " " + verb + " " + prefix_ + " " + arguments);
    if (here >= 0) {
      EXPECT_EQ(setns(here, CLONE_NEWNET), 0);
      close(here);
    }
    return result;
  }
  void expect(const std::string& verb, const std::string& arguments) const {
    const auto result = script(verb, arguments);
    EXPECT_EQ(result.status, 0) << verb << arguments << ": " << result.text;
  }
  Shell exec(const std::string& host, const std::string& command) const {
    return script("exec", host + " " + command);
  }
  /// A command on each host, at once.
  std::map<std::string, std::future<Shell>> exec_on_all(
      const std::function<std::string(const std::string&)>& command) const {
    std::map<std::string, std::future<Shell>> running;
    for (const std::string host : {"motion", "drives", "control"})
      running[host] =
          std::async(std::launch::async, [this, host, text = command(host)] { return exec(host, text); });
    return running;
  }
  /// From now on the sockets that this thread and the threads it starts make are on `host`, and they go
  /// before the cluster's: one who looks on must not lose batches of virtual time, which waits for nobody.
  void enter(const std::string& host) {
    home_ = open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
    const int there = open(("/run/netns/" + prefix_ + "-" + host).c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(setns(there, CLONE_NEWNET), 0);
    close(there);
    schedule(SCHED_FIFO, 10);
  }
  void leave() {
    if (home_ < 0) return;
    schedule(SCHED_OTHER, 0);
    EXPECT_EQ(setns(home_, CLONE_NEWNET), 0);
    close(home_);
    home_ = -1;
  }

 private:
  static void schedule(int policy, int priority) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    sched_setscheduler(0, policy, &parameters);
  }
  std::string switch_log() const { return "/tmp/trunnion-switch-" + prefix_; }
  std::string prefix_;
  FILE* switch_ = nullptr;
  int home_ = -1;
};

}  // namespace trunnion::integration
