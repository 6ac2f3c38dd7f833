// SPDX-License-Identifier: Apache-2.0
// What a launcher is started with.
#pragma once

#include <optional>
#include <string>

#include "bus/endpoint.hpp"
#include "cluster/cluster_files.hpp"
#include "cluster/executables.hpp"
#include "machine/machine.hpp"

namespace trunnion::launcher {

struct LaunchOptions {
  machine::MachineConfig machine;
  std::string state_directory;
  bool virtual_time = false;
  std::uint16_t port = 8080;
  cluster::RunDirectory run;
  std::string host;  ///< which of the machine's hosts this is; empty when it has none
  bus::NetworkSettings network;
  int session = 0;                   ///< in which the command was called that has started this
  std::optional<int> owner;          ///< process with which the cluster ends
  bool keep_faulty = false;          ///< it goes on after a faulty start, to be corrected
  cluster::Executables executables;  ///< in the place of those beside the launcher

  /// Computers of a network can join without security.
  bool open() const { return !machine.hosts.empty() && machine.security.empty(); }
};

}  // namespace trunnion::launcher
