// One process of a cluster: how it is started, what it says of itself.
#pragma once

#include <cstdint>
#include <string>

#include "contracts/types.hpp"
#include "machine/machine.hpp"
#include "restart_policy.hpp"

namespace trunnion::deploy {

struct LaunchOptions;

/// Instances, the numbers of processes: services count from 1 in the order of machine.yaml, launchers from
/// here on in the order of its hosts.
inline constexpr std::uint32_t launcher_instance = 1000;
/// What is swapped in has the number of the first process in its place and this much more for every swap its
/// launcher has begun. So every host's launcher sees whose place it takes.
inline constexpr std::uint32_t generation_step = 10000;
inline std::uint32_t place_of(std::uint32_t instance) { return instance % generation_step; }

struct ServiceProcess {
  machine::ServiceEntry entry;
  std::string executable;
  std::string log;
  int pid = 0;
  std::uint32_t restarts = 0;
  RestartPolicy policy;
  idl::service::Lifecycle lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  std::string detail;
  bool in_step = false;  ///< of the process that runs now
  std::uint64_t frames_out = 0;
  bool alive = false;     ///< has beaten since its start
  bool local = true;      ///< on this host; of those on others only the heartbeats are known
  bool lost = false;      ///< it died and is not back
  bool retiring = false;  ///< another one has taken over: its end is no loss

  /// Forks and executes. As a shadow it takes part only on SIGUSR1.
  void start(const LaunchOptions& options, bool shadow);
  /// Takes over what the process says of itself; false when it is not this process's.
  bool hear(const idl::service::ServiceState& state, double now);
  /// Service, channel or copy, as alarms name it.
  std::string name() const;
};

/// The last line a service wrote before it ended.
std::string last_line(const std::string& path);

}  // namespace trunnion::deploy
