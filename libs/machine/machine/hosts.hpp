// SPDX-License-Identifier: Apache-2.0
// The sections `hosts` and `network` of machine.yaml: on which computers the services run and how they find
// each other.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace trunnion::machine {

/// One computer of the cluster.
struct Host {
  std::string name;
  std::string address;  ///< IPv4, of the interface that the cluster uses
};

/// An absent section is an empty list: everything runs on one computer, over its loopback. Throws
/// std::runtime_error with file:line:column, also for a name or an address that is there twice.
std::vector<Host> read_hosts(const YAML::Node& section, const std::string& file);

/// The host of replica `replica` of a service: `entry` is its line, whose key `host` is a name or a list with
/// one name for each replica. Without the key it is the first host; empty when there are no hosts. Throws
/// std::runtime_error with file:line:column for a name that is not in `hosts`.
std::string host_of(const YAML::Node& entry, std::size_t replica, const std::vector<Host>& hosts,
                    const std::string& file);

/// `network: unicast` (the default) or `multicast`: true for the latter. Multicast is for finding each other
/// only.
bool read_multicast(const YAML::Node& value, const std::string& file);

/// `security: off` (the default), `on`, which is the directory `security` beside machine.yaml, or another
/// directory. Returns the directory with the cluster's certificates, or empty.
std::string read_security(const YAML::Node& value, const std::string& directory, const std::string& file);

/// The list `swap_directories`, relative ones from the machine's directory. Throws std::runtime_error with
/// file:line:column.
std::vector<std::string> read_swap_directories(const YAML::Node& section, const std::string& directory,
                                               const std::string& file);

}  // namespace trunnion::machine
