// SPDX-License-Identifier: Apache-2.0
// Connections of those who mean no good: opened, begun, and never brought to an end.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace trunnion::gateway {

/// To a port of this computer; they end with it.
class HeldConnections {
 public:
  explicit HeldConnections(std::uint16_t port) : port_(port) {
    rlimit files{};
    getrlimit(RLIMIT_NOFILE, &files);
    files.rlim_cur = std::min<rlim_t>(files.rlim_max, 8192);
    setrlimit(RLIMIT_NOFILE, &files);
  }
  ~HeldConnections() {
    for (const int fd : held_) ::close(fd);
  }
  HeldConnections(const HeldConnections&) = delete;
  HeldConnections& operator=(const HeldConnections&) = delete;

  /// One on which `begin` is sent and nothing is ever read.
  int open(const std::string& begin) {
    const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
    const int buffer = 4096;
    setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port_);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    EXPECT_EQ(::send(fd, begin.data(), begin.size(), MSG_NOSIGNAL), static_cast<ssize_t>(begin.size()));
    held_.push_back(fd);
    return fd;
  }

 private:
  const std::uint16_t port_;
  std::vector<int> held_;
};

/// Milliseconds that `what` takes.
inline double milliseconds_of(const std::function<void()>& what) {
  const auto begun = std::chrono::steady_clock::now();
  what();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
}

}  // namespace trunnion::gateway
