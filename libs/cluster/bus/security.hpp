// SPDX-License-Identifier: Apache-2.0
// Where a participant's certificate, key and permissions are: what deploy/security/make_certificates.sh lays
// out.
#pragma once

#include <string>

#include "bus/endpoint.hpp"

namespace trunnion::bus {

/// URIs as DDS Security wants them; all empty when the network has no security.
struct SecurityFiles {
  std::string authority, governance, certificate, key, permissions;
};

/// Seconds of silence after which the others forget a participant. A secured one keeps its place through a
/// cut of the network: when one side has forgotten the other and that one has not, Cyclone DDS 0.10 never
/// authenticates them again, because it begins a handshake with a participant that it discovers, and with no
/// other. Who ends without a word stays known for so long.
inline int lease_seconds(const NetworkSettings& network) { return network.security.empty() ? 3 : 60; }

/// Throws std::runtime_error naming the file when one of them is not there.
SecurityFiles security_files(const NetworkSettings& network, Vendor vendor);

}  // namespace trunnion::bus
