// SPDX-License-Identifier: Apache-2.0
// What only the gateway reads of machine.yaml.
#pragma once

#include <cstdint>
#include <string>

namespace YAML {
class Node;
}

namespace trunnion::machine {

/// How the gateway is reached by TLS.
struct TlsSettings {
  bool on = false;
  std::string certificate,
      key;  ///< PEM files, relative ones beside machine.yaml; empty = those of the state directory
};

struct GatewaySettings {
  std::uint16_t mtconnect_port = 5000;  ///< of the MTConnect agent; 0 = none
  bool auth = false;                    ///< users log in
  double session_idle = 1800;           ///< s without a request after which a session ends
  bool one_operates = false;            ///< one station at a time; by default when users log in
  double recording_free_space = 200;    ///< MB that must be free for a recording, 0 = not checked
  TlsSettings tls;
};

/// `document` is that of machine.yaml in `file`. Throws std::runtime_error with file:line:column.
GatewaySettings read_gateway_settings(const YAML::Node& document, const std::string& file);
/// Of machine.yaml in `directory`. Throws std::runtime_error.
GatewaySettings load_gateway_settings(const std::string& directory);

}  // namespace trunnion::machine
