// SPDX-License-Identifier: Apache-2.0
// The command line every service shares.
#pragma once

#include <string>

#include "bus/endpoint.hpp"
#include "machine/machine.hpp"

namespace CLI {
class App;
}

namespace trunnion::service {

struct Options {
  std::string service;  ///< name of the executable without "trunnion-"
  std::string machine_directory;
  std::string state_directory;  ///< where this machine keeps what must survive: parameters, programs, encoder
                                ///< positions
  std::uint32_t instance = 0;
  std::uint32_t replica = 0;
  std::uint32_t channel = 0;
  bus::Vendor vendor = bus::Vendor::cyclonedds;
  bus::NetworkSettings network;
  bool virtual_time = false;
  bool parent_bound = false;  ///< stop when the launcher is gone
  std::string snapshot;       ///< file with a recorded state to continue from; empty = none
  bool standby = false;       ///< begin on standby beside the one that it replaces

  machine::MachineConfig machine;  ///< loaded from machine_directory
};

/// Adds the shared options to `app`, so that a service can add its own before parsing.
void add_options(CLI::App& app, Options& options);

/// Parses, loads the machine, returns -1 to go on or the exit status. Prints one line on errors.
int parse_options(CLI::App& app, int argc, char** argv, Options& options);

}  // namespace trunnion::service
