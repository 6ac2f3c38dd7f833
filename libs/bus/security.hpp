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

/// Throws std::runtime_error naming the file when one of them is not there.
SecurityFiles security_files(const NetworkSettings& network, Vendor vendor);

}  // namespace trunnion::bus
