// SPDX-License-Identifier: Apache-2.0
#include "machine/machine.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "machine/chain_section.hpp"
#include "machine/collision_mode.hpp"
#include "machine/dialect_section.hpp"
#include "machine/gateway_loss.hpp"
#include "machine/gateway_settings.hpp"
#include "machine/kinematics.hpp"
#include "machine/services.hpp"
#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::machine {
namespace {

// "a, b and c"
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

template <class T>
T value(const std::string& file, const YAML::Node& parent, const char* key, T fallback) {
  const auto node = parent[key];
  if (!node) return fallback;
  try {
    return node.as<T>();
  } catch (const YAML::Exception&) {
    throw std::runtime_error(at(file, node) + "'" + key + "' has a value of the wrong kind");
  }
}

void read_hardware(const std::string& file, const YAML::Node& document, MachineConfig& config) {
  const auto hardware = value<std::string>(file, document, "hardware", "simulation");
  if (hardware != "simulation" && hardware != "hal")
    throw std::runtime_error(at(file, document["hardware"]) + "hardware must be 'simulation' or 'hal'");
  const auto hal = document["hal"];
  if (hardware == "simulation") {
    if (hal) throw std::runtime_error(at(file, hal) + "'hal' needs 'hardware: hal'");
    return;
  }
  config.hardware = Hardware::hal;
  if (!hal)
    throw std::runtime_error(
        at(file, document["hardware"]) +
        "'hardware: hal' needs 'hal: {file: NAME.hal}', the file that describes the machine");
  YamlReader(file).only(hal, {"file", "queue"});
  const auto name = value<std::string>(file, hal, "file", "");
  if (name.empty()) throw std::runtime_error(at(file, hal) + "'file' is missing");
  const auto path = std::filesystem::path(config.directory) / name;
  if (!std::filesystem::is_regular_file(path))
    throw std::runtime_error(at(file, hal["file"]) + "there is no file '" + path.string() + "'");
  config.hal.file = std::filesystem::absolute(path).lexically_normal().string();
  config.hal.queue = value<std::uint32_t>(file, hal, "queue", config.hal.queue);
  if (config.hal.queue < 2 || config.hal.queue > 256)
    throw std::runtime_error(at(file, hal["queue"]) + "queue must be 2 .. 256 setpoint rows");
  if (config.virtual_time)
    throw std::runtime_error(at(file, document["time"]) +
                             "time must be 'real' with 'hardware: hal': HAL's servo thread is the clock");
}

}  // namespace

MachineConfig parse_machine(const std::string& text, const std::string& directory,
                            const std::string& vendor_override) {
  const std::string file = directory + "/machine.yaml";
  const auto document = parse_yaml(text, file);
  YamlReader(file).only(document, {"name",
                                   "title",
                                   "domain",
                                   "port",
                                   "mtconnect_port",
                                   "auth",
                                   "session_idle_minutes",
                                   "tls",
                                   "operating_right",
                                   "recording_free_space",
                                   "host_names",
                                   "time",
                                   "vendor",
                                   "hardware",
                                   "hal",
                                   "collision",
                                   "dialect",
                                   "program_dialects",
                                   "gateway_loss",
                                   "hosts",
                                   "network",
                                   "security",
                                   "open",
                                   "swap_directories",
                                   "services",
                                   "chains"});
  MachineConfig config;
  config.directory = directory;
  config.name = value<std::string>(file, document, "name", "");
  if (config.name.empty()) throw std::runtime_error(file + ":1:1: error: 'name' is missing");
  config.title = value<std::string>(file, document, "title", config.name);
  config.domain = value<std::uint32_t>(file, document, "domain", 1);
  if (config.domain > 100) throw std::runtime_error(at(file, document["domain"]) + "domain must be 0 .. 100");
  const int port = value<int>(file, document, "port", 8080);
  if (port < 1 || port > 65535)
    throw std::runtime_error(at(file, document["port"]) + "port must be 1 .. 65535");
  config.port = static_cast<std::uint16_t>(port);
  read_gateway_settings(document, file);  // the gateway reads them itself; an error is found at the start
  for (const auto& name : document["host_names"]) config.host_names.push_back(scalar(file, name));
  read_collision_mode(document, file);  // the channel reads it itself
  read_gateway_loss(document, file);    // and this one the launcher
  const auto time = value<std::string>(file, document, "time", "real");
  if (time != "real" && time != "virtual")
    throw std::runtime_error(at(file, document["time"]) + "time must be 'real' or 'virtual'");
  config.virtual_time = time == "virtual";
  read_hardware(file, document, config);
  const auto default_vendor = value<std::string>(file, document, "vendor", "cyclonedds");

  config.hosts = read_hosts(document["hosts"], file);
  config.multicast = read_multicast(document["network"], file);
  config.security = read_security(document["security"], directory, file);
  config.open = value<bool>(file, document, "open", false);
  if (!config.hosts.empty() && config.security.empty() && !config.open)
    throw std::runtime_error(
        at(file, document["hosts"]) +
        "every computer in the network of these hosts could move the machine: add 'security: "
        "on' (docs/security.md), or 'open: true' when the network is yours alone");
  config.swap_directories = read_swap_directories(document["swap_directories"], directory, file);
  config.chain_parameters = read_chain_parameters(document["chains"], file);

  const auto services = document["services"];
  if (!services || !services.IsSequence())
    throw std::runtime_error(file + ":1:1: error: 'services' is missing");
  config.channels = 0;
  for (const auto& node : services) {
    YamlReader(file).only(node, {"service", "vendor", "replicas", "channel", "host"});
    ServiceEntry entry;
    entry.service = value<std::string>(file, node, "service", "");
    const auto* definition = find_service(entry.service);
    if (definition == nullptr)
      throw std::runtime_error(at(file, node) + "unknown service '" + entry.service + "'");
    entry.channel = value<std::uint32_t>(file, node, "channel", 0);
    if (entry.channel > 31) throw std::runtime_error(at(file, node["channel"]) + "channel must be 0 .. 31");
    if (definition->per_channel) config.channels = std::max(config.channels, entry.channel + 1);
    const bool twice =
        std::any_of(config.services.begin(), config.services.end(), [&](const ServiceEntry& other) {
          return other.service == entry.service &&
                 (!definition->per_channel || other.channel == entry.channel);
        });
    const auto replicas = value<std::uint32_t>(file, node, "replicas", 1);
    if (replicas < 1 || replicas > 2 || (replicas == 2 && !definition->transforms()))
      throw std::runtime_error(at(file, node["replicas"]) + "replicas must be 1, or 2 for " +
                               listed(transforming_stages()));
    for (std::uint32_t replica = 0; replica < replicas; ++replica) {
      entry.replica = replica;
      entry.host = host_of(node, replica, config.hosts, file);
      const auto vendor = node["vendor"];
      entry.vendor = vendor && vendor.IsSequence()
                         ? (replica < vendor.size() ? scalar(file, vendor[replica]) : default_vendor)
                         : value<std::string>(file, node, "vendor", default_vendor);
      if (entry.vendor != "fastdds" && entry.vendor != "cyclonedds")
        throw std::runtime_error(at(file, vendor ? vendor : document["vendor"]) + "unknown vendor '" +
                                 entry.vendor + "': fastdds or cyclonedds");
      entry.instance = static_cast<std::uint32_t>(config.services.size() + 1);
      if (vendor_override == "mixed")
        entry.vendor = entry.instance % 2 == 0 ? "fastdds" : "cyclonedds";
      else if (!vendor_override.empty())
        entry.vendor = vendor_override;
      config.services.push_back(entry);
    }
    if (twice)
      throw std::runtime_error(
          at(file, node) + "service '" + entry.service + "' is there twice" +
          (definition->per_channel ? " for channel " + std::to_string(entry.channel) : ""));
  }
  for (const auto& definition : service::all) {
    const bool there = std::any_of(config.services.begin(), config.services.end(),
                                   [&](const auto& s) { return s.service == definition.name; });
    if (!there && definition.required)
      throw std::runtime_error(at(file, services) + "service '" + definition.name + "' is missing");
  }
  config.dialect_parameters = read_dialect_parameters(document, file, config.channels);
  return config;
}

MachineConfig load_machine(const std::string& directory, const std::string& vendor_override) {
  return parse_machine(read_text(directory + "/machine.yaml"), directory, vendor_override);
}

std::string program_of(const MachineConfig& config, const ServiceEntry& entry) {
  const bool hal = entry.service == "drive" && config.hardware == Hardware::hal;
  return "trunnion-" + entry.service + (hal ? "-hal" : "");
}

void forget_hosts(MachineConfig& config) {
  config.hosts.clear();
  for (auto& entry : config.services) entry.host.clear();
}

std::optional<ParameterFault> chain_conflict(const std::map<std::uint32_t, ParameterValue>& values,
                                             const MachineConfig& config) {
  for (const auto& [number, value] : config.chain_parameters) {
    // All of a channel's numbers, also those its chain leaves at their defaults.
    const auto first = number / 1000 * 1000;
    const auto last = values.lower_bound(first + 1000);
    const auto twice = std::find_if(values.lower_bound(first), last,
                                    [](const auto& entry) { return is_chain_parameter(entry.first); });
    if (twice != last)
      return ParameterFault{{twice->first},
                            "parameter " + number_text(twice->first) +
                                " belongs to the kinematic chain of the channel, which machine.yaml has"};
  }
  return std::nullopt;
}

std::map<std::uint32_t, ParameterValue> machine_parameters(const MachineConfig& config) {
  auto values = read_parameter_file(config.parameters_file());
  if (const auto fault = chain_conflict(values, config))
    throw std::runtime_error(config.parameters_file() + ": error: " + fault->text);
  values.insert(config.chain_parameters.begin(), config.chain_parameters.end());
  values.insert(config.dialect_parameters.begin(), config.dialect_parameters.end());
  return values;
}

}  // namespace trunnion::machine
