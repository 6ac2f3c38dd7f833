// SPDX-License-Identifier: Apache-2.0
// One cluster in a state directory, and one in a DDS domain of a computer. Both locks end with the process
// that holds them, however it ends.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cluster/launcher_identity.hpp"

namespace trunnion::cluster {

/// The lock is held by another process; what() is one line that names it.
class Locked : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr const char* lock_file = "cluster.lock";

/// flock(2) on a file in the state directory, which names the holder: also over a network file system.
class StateLock {
 public:
  /// The directory must exist. Throws Locked, and std::runtime_error when there can be no such file.
  StateLock(const std::string& directory, const Identity& holder, std::uint32_t domain);
  ~StateLock();
  StateLock(const StateLock&) = delete;
  StateLock& operator=(const StateLock&) = delete;

 private:
  int file_ = -1;
};

/// Who holds the state directory now; nothing when nobody does.
std::optional<std::string> state_holder(const std::string& directory);

/// A socket in the abstract name space, which belongs to the network namespace, as the loopback does: two
/// clusters that could hear each other there cannot both have it, of whichever users they are.
class DomainLock {
 public:
  /// `host` is the host of machine.yaml, empty when it has none. Throws Locked.
  DomainLock(std::uint32_t domain, const std::string& host, const Identity& holder);
  ~DomainLock();
  DomainLock(const DomainLock&) = delete;
  DomainLock& operator=(const DomainLock&) = delete;
  /// Answers those who ask who holds the domain. Never waits.
  void answer();

 private:
  int socket_;
  std::string line_;
};

/// Who holds the domain on this computer now; nothing when nobody does.
std::optional<std::string> domain_holder(std::uint32_t domain, const std::string& host = "");

/// Says that a recorder runs in the domain for as long as this process lives, also when another program
/// replaces it. Nothing happens where no cluster of this user runs on this computer.
void hold_recording(std::uint32_t domain);
/// A process holds that.
bool is_recorded(std::uint32_t domain);

/// Services of a cluster whose launcher is gone: processes of this user that were started with this state
/// directory or domain as services.
std::vector<int> leftover_services(const std::string& state_directory, std::uint32_t domain);
/// SIGTERM, and SIGKILL after `timeout` seconds. Returns when none of them lives.
void end_processes(const std::vector<int>& pids, double timeout = 2);

}  // namespace trunnion::cluster
