// SPDX-License-Identifier: Apache-2.0
#include "machine/hosts.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <stdexcept>

#include "machine/yaml.hpp"

namespace trunnion::machine {
namespace {

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

// Names become parts of file names and of unit names.
bool is_plain(const std::string& name) {
  return !name.empty() && name.size() <= 32 && name.front() != '-' &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-") ==
             std::string::npos;
}

std::string names_of(const std::vector<Host>& hosts) {
  std::string names;
  for (const auto& host : hosts) names += (names.empty() ? "" : ", ") + host.name;
  return names;
}

}  // namespace

std::vector<Host> read_hosts(const YAML::Node& section, const std::string& file) {
  std::vector<Host> hosts;
  if (!section) return hosts;
  if (!section.IsSequence() || section.size() == 0)
    throw std::runtime_error(at(file, section) + "'hosts' must be a list of {name: ..., address: ...}");
  for (const auto& node : section) {
    if (!node.IsMap() || node.size() != 2 || !node["name"] || !node["address"])
      throw std::runtime_error(at(file, node) + "a host is {name: ..., address: ...}");
    Host host{scalar(file, node["name"]), scalar(file, node["address"])};
    if (!is_plain(host.name))
      throw std::runtime_error(at(file, node["name"]) +
                               "a host's name has 1 .. 32 letters, digits and dashes");
    if (!is_ipv4(host.address))
      throw std::runtime_error(at(file, node["address"]) + "'" + host.address + "' is not an IPv4 address");
    for (const auto& other : hosts) {
      if (other.name == host.name)
        throw std::runtime_error(at(file, node["name"]) + "host '" + host.name + "' is there twice");
      if (other.address == host.address)
        throw std::runtime_error(at(file, node["address"]) + "address " + host.address +
                                 " is that of host '" + other.name + "'");
    }
    hosts.push_back(std::move(host));
  }
  if (hosts.size() > 16) throw std::runtime_error(at(file, section) + "more than 16 hosts");
  return hosts;
}

std::string host_of(const YAML::Node& entry, std::size_t replica, const std::vector<Host>& hosts,
                    const std::string& file) {
  const auto node = entry["host"];
  if (!node) return hosts.empty() ? "" : hosts.front().name;
  if (hosts.empty()) throw std::runtime_error(at(file, node) + "there is no section 'hosts'");
  if (node.IsSequence() && replica >= node.size())
    throw std::runtime_error(at(file, node) + "replica " + std::to_string(replica) + " has no host");
  const auto name = scalar(file, node.IsSequence() ? node[replica] : node);
  if (std::none_of(hosts.begin(), hosts.end(), [&](const Host& host) { return host.name == name; }))
    throw std::runtime_error(at(file, node) + "unknown host '" + name + "': there is " + names_of(hosts));
  return name;
}

bool read_multicast(const YAML::Node& value, const std::string& file) {
  if (!value) return false;
  const auto text = scalar(file, value);
  if (text != "unicast" && text != "multicast")
    throw std::runtime_error(at(file, value) + "network must be 'unicast' or 'multicast'");
  return text == "multicast";
}

std::string read_security(const YAML::Node& value, const std::string& directory, const std::string& file) {
  const auto text = value ? scalar(file, value) : "off";
  if (text.empty() || text == "off" || text == "false" || text == "no") return "";
  if (text == "on" || text == "true" || text == "yes") return directory + "/security";
  return text.front() == '/' ? text : directory + "/" + text;
}

std::vector<std::string> read_swap_directories(const YAML::Node& section, const std::string& directory,
                                               const std::string& file) {
  std::vector<std::string> directories;
  if (!section) return directories;
  if (!section.IsSequence())
    throw std::runtime_error(at(file, section) + "'swap_directories' must be a list of directories");
  for (const auto& node : section) {
    auto text = scalar(file, node);
    if (text.empty()) throw std::runtime_error(at(file, node) + "a directory without a name");
    if (text.front() != '/') text.insert(0, directory + "/");
    directories.push_back(std::move(text));
  }
  return directories;
}

}  // namespace trunnion::machine
