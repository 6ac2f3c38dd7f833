// One process of a cluster: how it is started, what it says of itself.
#pragma once

#include <cstdint>
#include <string>

#include "contracts/types.hpp"
#include "launch_options.hpp"
#include "restart_policy.hpp"

namespace trunnion::launcher {

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

}  // namespace trunnion::launcher
