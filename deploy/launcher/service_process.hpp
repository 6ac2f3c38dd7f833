// SPDX-License-Identifier: Apache-2.0
// One process of a cluster: how it is started, what it publishes of itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cluster/child_process.hpp"
#include "contracts/types.hpp"
#include "launch_options.hpp"
#include "restart_policy.hpp"
#include "service_fault.hpp"

namespace trunnion::launcher {

struct ServiceProcess {
  machine::ServiceEntry entry;
  std::string executable;
  std::string log;
  cluster::ChildProcess child;  ///< of a local process
  int pid = 0;                  ///< 0 when it does not run
  std::uint32_t restarts = 0;
  RestartPolicy policy;
  idl::service::Lifecycle lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  std::string detail;
  bool in_step = false;  ///< of the process that runs now
  idl::service::StandbyState standby = idl::service::StandbyState::JOINING;
  std::uint64_t compared = 0;  ///< on standby: ticks in which it has done the same as the running one
  std::string difference;      ///< on standby: what differs
  bool alive = false;          ///< has beaten since its start
  bool local = true;           ///< on this host; of those on others only the heartbeats are known
  ServiceFault fault;
  bool retiring = false;  ///< another one has taken over: its end is no loss

  /// On standby it takes no part until it is promoted.
  void start(const LaunchOptions& options, bool on_standby, double now);
  /// Of a local process, once: the status of waitpid() when it has ended.
  std::optional<int> ended();
  /// Takes what the process publishes of itself; false when it is not this process's.
  bool hear(const idl::service::ServiceState& state, double now);
  /// Service, channel or replica, as alarms name it.
  std::string name() const;
};

}  // namespace trunnion::launcher
