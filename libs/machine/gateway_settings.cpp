// SPDX-License-Identifier: Apache-2.0
#include "machine/gateway_settings.hpp"

#include <stdexcept>

#include "machine/yaml.hpp"

namespace trunnion::machine {

GatewaySettings read_gateway_settings(const YAML::Node& document, const std::string& file) {
  GatewaySettings settings;
  if (const auto node = document["mtconnect_port"]) {
    int port = -1;
    try {
      port = node.as<int>();
    } catch (const YAML::Exception&) {
    }
    if (port < 0 || port > 65535)
      throw std::runtime_error(at(file, node) + "mtconnect_port must be 1 .. 65535, or 0 for no agent");
    settings.mtconnect_port = static_cast<std::uint16_t>(port);
  }
  if (const auto node = document["auth"]) {
    try {
      settings.auth = node.as<bool>();
    } catch (const YAML::Exception&) {
      throw std::runtime_error(at(file, node) + "auth must be 'on' or 'off'");
    }
  }
  return settings;
}

GatewaySettings load_gateway_settings(const std::string& directory) {
  const auto file = directory + "/machine.yaml";
  return read_gateway_settings(parse_yaml(read_text(file), file), file);
}

}  // namespace trunnion::machine
