// SPDX-License-Identifier: Apache-2.0
#include "service/network.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>

namespace trunnion::service {
namespace {

std::vector<std::string> own_addresses() {
  std::vector<std::string> addresses;
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return addresses;
  for (const ifaddrs* entry = all; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN];
    const auto* address = reinterpret_cast<const sockaddr_in*>(entry->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text, sizeof text) != nullptr) addresses.emplace_back(text);
  }
  freeifaddrs(all);
  return addresses;
}

template <class Range, class Text>
std::string joined(const Range& range, const char* separator, Text&& text) {
  std::string all;
  for (const auto& entry : range) all += (all.empty() ? "" : separator) + std::string(text(entry));
  return all;
}

}  // namespace

std::string local_host(const machine::MachineConfig& config) {
  if (config.hosts.empty()) return "";
  const auto addresses = own_addresses();
  const auto here = std::find_if(config.hosts.begin(), config.hosts.end(), [&](const machine::Host& host) {
    return std::find(addresses.begin(), addresses.end(), host.address) != addresses.end();
  });
  return here != config.hosts.end() ? here->name : config.hosts.front().name;
}

bus::NetworkSettings network_of(const machine::MachineConfig& config, const std::string& host) {
  bus::NetworkSettings network;
  network.domain = config.domain;
  network.security = config.security;
  if (config.hosts.empty()) {
    if (!host.empty())
      throw std::runtime_error("machine " + config.name + " has no section 'hosts', so no host '" + host +
                               "'");
    return network;
  }
  const auto found = std::find_if(config.hosts.begin(), config.hosts.end(),
                                  [&](const machine::Host& other) { return other.name == host; });
  if (found == config.hosts.end())
    throw std::runtime_error(
        "machine " + config.name + " has no host '" + host + "': there is " +
        joined(
            config.hosts, ", ", [](const machine::Host& other) -> const auto& { return other.name; }));
  const auto addresses = own_addresses();
  if (std::find(addresses.begin(), addresses.end(), found->address) == addresses.end())
    throw std::runtime_error("host '" + host + "' has the address " + found->address +
                             ", which is none of this computer's (" +
                             joined(addresses, ", ", [](const auto& address) { return address; }) +
                             "): name this host with --host, or correct machine.yaml");
  network.interface_address = found->address;
  network.peers = joined(
      config.hosts, ",", [](const machine::Host& other) -> const auto& { return other.address; });
  network.multicast = config.multicast;
  return network;
}

void add_network_options(CLI::App& app, bus::NetworkSettings& network) {
  app.add_option("--interface", network.interface_address, "IPv4 address of this host's interface");
  app.add_option("--peers", network.peers, "IPv4 addresses of the hosts, separated by commas");
  app.add_option("--security", network.security, "Directory with the cluster's certificates");
  app.add_option("--clock-offset", network.clock_offset,
                 "ns from the monotonic clock to the time in messages; 0: the wall clock's now");
  app.add_flag("--multicast", network.multicast, "Find the others by multicast instead of by --peers");
}

std::vector<std::string> network_arguments(const bus::NetworkSettings& network) {
  std::vector<std::string> arguments{"--interface", network.interface_address, "--peers", network.peers};
  if (!network.security.empty()) arguments.insert(arguments.end(), {"--security", network.security});
  if (network.clock_offset != 0)
    arguments.insert(arguments.end(), {"--clock-offset", std::to_string(network.clock_offset)});
  if (network.multicast) arguments.emplace_back("--multicast");
  return arguments;
}

}  // namespace trunnion::service
