// SPDX-License-Identifier: Apache-2.0
#include "bus/security.hpp"

#include <fstream>
#include <stdexcept>

namespace trunnion::bus {
namespace {

std::string uri(const std::string& path) {
  if (!std::ifstream(path))
    throw std::runtime_error(
        "security: " + path +
        ": cannot be read (deploy/security/make_certificates.sh makes the certificates)");
  return "file:" + path;
}

}  // namespace

SecurityFiles security_files(const NetworkSettings& network, Vendor vendor) {
  if (network.security.empty()) return {};
  const std::string& root = network.security;
  const std::string own = root + "/" + network.identity + "-" + to_string(vendor);
  return {uri(root + "/ca.pem"), uri(root + "/governance.p7s"), uri(own + "/certificate.pem"),
          uri(own + "/key.pem"), uri(own + "/permissions.p7s")};
}

}  // namespace trunnion::bus
