// SPDX-License-Identifier: Apache-2.0
#include "machine/gateway_settings.hpp"

#include <stdexcept>

#include "machine/yaml.hpp"

namespace trunnion::machine {

namespace {

TlsSettings read_tls(const YAML::Node& node, const std::string& file) {
  if (node.IsScalar()) {
    try {
      return {node.as<bool>(), "", ""};
    } catch (const YAML::Exception&) {
    }
  }
  TlsSettings tls{true, "", ""};
  if (node.IsMap()) {
    for (const auto& entry : node) {
      const auto name = entry.first.Scalar();
      if (name != "certificate" && name != "key")
        throw std::runtime_error(at(file, entry.first) + "tls has 'certificate' and 'key', not '" + name +
                                 "'");
      (name == "key" ? tls.key : tls.certificate) = entry.second.IsScalar() ? entry.second.Scalar() : "";
    }
  }
  if (tls.certificate.empty() || tls.key.empty())
    throw std::runtime_error(at(file, node) +
                             "tls must be 'on', 'off', or {certificate: FILE, key: FILE} in PEM form");
  return tls;
}

}  // namespace

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
  if (const auto node = document["session_idle_minutes"]) {
    double minutes = 0;
    try {
      minutes = node.as<double>();
    } catch (const YAML::Exception&) {
    }
    if (!(minutes >= 0.05 && minutes <= 720))
      throw std::runtime_error(at(file, node) + "session_idle_minutes must be 0.05 .. 720");
    settings.session_idle = minutes * 60;
  }
  settings.one_operates = settings.auth;
  if (const auto node = document["operating_right"]) {
    const auto text = node.IsScalar() ? node.Scalar() : std::string();
    if (text != "one" && text != "any")
      throw std::runtime_error(at(file, node) + "operating_right must be 'one' or 'any'");
    settings.one_operates = text == "one";
  }
  if (const auto node = document["recording_free_space"]) {
    double megabytes = -1;
    try {
      megabytes = node.as<double>();
    } catch (const YAML::Exception&) {
    }
    if (!(megabytes >= 0 && megabytes <= 1e9))
      throw std::runtime_error(at(file, node) +
                               "recording_free_space must be 0 .. 1000000000 MB, 0 = not checked");
    settings.recording_free_space = megabytes;
  }
  if (const auto node = document["tls"]) settings.tls = read_tls(node, file);
  return settings;
}

GatewaySettings load_gateway_settings(const std::string& directory) {
  const auto file = directory + "/machine.yaml";
  return read_gateway_settings(parse_yaml(read_text(file), file), file);
}

}  // namespace trunnion::machine
