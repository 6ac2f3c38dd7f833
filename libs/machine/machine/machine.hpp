// SPDX-License-Identifier: Apache-2.0
// machine.yaml: which services make up a machine, where they run and how they talk.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "machine/hosts.hpp"
#include "machine/parameter_fault.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine {

/// One process of the cluster.
struct ServiceEntry {
  std::string service;         ///< a name of services.yaml
  std::string vendor;          ///< fastdds or cyclonedds
  std::uint32_t instance = 0;  ///< unique in the cluster, in the order of machine.yaml
  std::uint32_t replica = 0;   ///< number of the replica, from 0
  std::uint32_t channel = 0;   ///< of a channel service
  std::string host;            ///< where it runs; empty when the machine has no `hosts`
};

/// What the drive service moves.
enum class Hardware {
  simulation,  ///< simulated servo axes, spindles and skip inputs, in the process of the drive
  hal,         ///< LinuxCNC's hardware abstraction layer: docs/hal.md
};

/// Of a machine with `hardware: hal`.
struct HalSettings {
  std::string file;          ///< absolute path of the .hal file that describes the machine
  std::uint32_t queue = 16;  ///< setpoint rows kept in HAL's FIFO ahead of its servo thread, 2 .. 256
};

struct MachineConfig {
  std::string directory;
  std::string name;
  std::string title;
  std::uint32_t domain = 1;
  std::uint16_t port = 8080;            ///< of the gateway
  std::vector<std::string> host_names;  ///< under which browsers reach the gateway, besides addresses
  bool virtual_time = false;
  Hardware hardware = Hardware::simulation;
  HalSettings hal;
  std::uint32_t channels = 1;
  std::vector<ServiceEntry> services;
  std::vector<Host> hosts;  ///< empty: everything on one computer, over its loopback
  bool multicast = false;   ///< hosts find each other by multicast instead of by the list of addresses
  std::string security;     ///< directory of the cluster's certificates; empty: DDS security is off
  bool open = false;        ///< hosts without security are intended
  /// Where executables for a swap may be, besides the directory of the launcher itself.
  std::vector<std::string> swap_directories;
  std::map<std::uint32_t, ParameterValue> chain_parameters;  ///< what the section `chains` comes to
  /// What `dialect` and `program_dialects` come to; a channel's own value in parameters.yaml goes before.
  std::map<std::uint32_t, ParameterValue> dialect_parameters;

  std::string parameters_file() const { return directory + "/parameters.yaml"; }
  std::string programs_directory() const { return directory + "/programs"; }
  bool simulated() const { return hardware == Hardware::simulation; }
  std::string plc_directory() const { return directory + "/plc"; }
};

/// `text` is that of machine.yaml in `directory`. `vendor_override`: empty, fastdds, cyclonedds or mixed
/// (alternating). Throws std::runtime_error with file:line:column.
MachineConfig parse_machine(const std::string& text, const std::string& directory,
                            const std::string& vendor_override = "");
/// The same from the file; throws std::runtime_error also when it cannot be read.
MachineConfig load_machine(const std::string& directory, const std::string& vendor_override = "");

/// Name of the program that runs `entry`; the drive has one for each kind of hardware.
std::string program_of(const MachineConfig& config, const ServiceEntry& entry);

/// Everything on one computer, over its loopback.
void forget_hosts(MachineConfig& config);

/// A parameter of a kinematic chain that `values`, those of parameters.yaml, have for a channel with a chain
/// in machine.yaml: there would be two truths.
std::optional<ParameterFault> chain_conflict(const std::map<std::uint32_t, ParameterValue>& values,
                                             const MachineConfig& config);

/// parameters.yaml with the chains and dialects of machine.yaml. Throws std::runtime_error, also for a
/// chain_conflict().
std::map<std::uint32_t, ParameterValue> machine_parameters(const MachineConfig& config);

}  // namespace trunnion::machine
