// SPDX-License-Identifier: Apache-2.0
// How a process of a cluster learns where the others are: from machine.yaml to the command line and back.
#pragma once

#include <string>
#include <vector>

#include "bus/endpoint.hpp"
#include "machine/machine.hpp"

namespace CLI {
class App;
}

namespace trunnion::service {

/// The host of `config` this computer is: the one whose address is an address of this computer, or else the
/// first. Empty when the machine has no hosts.
std::string local_host(const machine::MachineConfig& config);

/// The network of a process on `host`: the host's address, and the addresses of all hosts. Without hosts it
/// is the loopback. Throws std::runtime_error with one line when there is no such host, or its address is not
/// one of this computer.
bus::NetworkSettings network_of(const machine::MachineConfig& config, const std::string& host);

/// --interface, --peers, --security, --clock-offset and --multicast.
void add_network_options(CLI::App& app, bus::NetworkSettings& network);
/// What add_network_options() reads back. The domain and the identity are not in it.
std::vector<std::string> network_arguments(const bus::NetworkSettings& network);

}  // namespace trunnion::service
