// SPDX-License-Identifier: Apache-2.0
// An Ethernet switch whose cables are long: it puts a TAP device `cable` into each of the given network
// namespaces and carries frames between them, every one a fixed time later and in order. Says "ready" when
// the devices exist, ends when its standard input does. Needs root.
#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using Address = std::array<std::uint8_t, 6>;

struct Frame {
  Clock::time_point due;
  std::size_t from;
  std::vector<std::uint8_t> bytes;
};

/// The device belongs to the namespace, the descriptor works from anywhere.
int make_tap(const std::string& space) {
  const int home = open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
  const int there = open(("/run/netns/" + space).c_str(), O_RDONLY | O_CLOEXEC);
  if (home < 0 || there < 0 || setns(there, CLONE_NEWNET) != 0)
    throw std::runtime_error(space + ": no such network namespace, or not root");
  const int tap = open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ifreq request{};
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  std::strcpy(request.ifr_name, "cable");
  const bool made = tap >= 0 && ioctl(tap, TUNSETIFF, &request) == 0;
  if (setns(home, CLONE_NEWNET) != 0 || !made) throw std::runtime_error(space + ": no TAP device");
  close(there);
  close(home);
  return tap;
}

class Switch {
 public:
  Switch(const std::vector<std::string>& spaces, std::chrono::microseconds delay) : delay_(delay) {
    for (const auto& space : spaces) taps_.push_back(make_tap(space));
  }
  void run() {
    std::vector<pollfd> waits;
    for (const int tap : taps_) waits.push_back({tap, POLLIN, 0});
    waits.push_back({STDIN_FILENO, POLLIN, 0});
    for (;;) {
      const auto wait = queue_.empty() ? Clock::duration(std::chrono::seconds(1))
                                       : std::max(Clock::duration::zero(), queue_.front().due - Clock::now());
      const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(wait).count();
      const timespec timeout{nanoseconds / 1000000000, nanoseconds % 1000000000};
      ppoll(waits.data(), waits.size(), &timeout, nullptr);
      if (waits.back().revents != 0) {
        char c = 0;
        if (read(STDIN_FILENO, &c, 1) <= 0) return;
      }
      for (std::size_t port = 0; port < taps_.size(); ++port) take(port);
      deliver();
    }
  }

 private:
  void take(std::size_t port) {
    std::array<std::uint8_t, 2048> buffer;
    for (ssize_t n = 0; (n = read(taps_[port], buffer.data(), buffer.size())) > 0;)
      if (n >= 14) queue_.push_back({Clock::now() + delay_, port, {buffer.begin(), buffer.begin() + n}});
  }
  void deliver() {
    for (const auto now = Clock::now(); !queue_.empty() && queue_.front().due <= now; queue_.pop_front()) {
      const auto& frame = queue_.front();
      Address to, from;
      std::memcpy(to.data(), frame.bytes.data(), to.size());
      std::memcpy(from.data(), frame.bytes.data() + 6, from.size());
      ports_[from] = frame.from;
      const auto known = ports_.find(to);
      for (std::size_t port = 0; port < taps_.size(); ++port)
        if (port != frame.from && (known == ports_.end() || known->second == port) &&
            write(taps_[port], frame.bytes.data(), frame.bytes.size()) < 0)
          ++lost_;  // the host takes no more: as on a cable
    }
  }

  std::chrono::microseconds delay_;
  std::vector<int> taps_;
  std::deque<Frame> queue_;  // in the order of `due`, because the delay is the same for all
  std::map<Address, std::size_t> ports_;
  std::uint64_t lost_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "tap-switch DELAY_US NAMESPACE...\n");
    return 2;
  }
  try {
    Switch ethernet({argv + 2, argv + argc}, std::chrono::microseconds(std::atoi(argv[1])));
    std::printf("ready\n");
    std::fflush(stdout);
    ethernet.run();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "tap-switch: %s\n", e.what());
    return 1;
  }
}
