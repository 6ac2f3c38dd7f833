// SPDX-License-Identifier: Apache-2.0
// Who runs a cluster, as other launchers are shown it.
#pragma once

#include <string>

#include "contracts/types.hpp"

namespace trunnion::cluster {

using Identity = idl::service::LauncherIdentity;

/// Of this process. `instance` as in cluster/instances.hpp.
Identity make_identity(const std::string& machine, std::uint32_t instance, bool open);

/// For example "launcher 1234 of user cnc on host mill (machine ac-table, domain 11, since
/// 2026-01-31T08:00:00Z)".
std::string describe(const Identity& identity, std::uint32_t domain);

/// One line of JSON, and back; a line that is none gives an identity with pid 0.
std::string write_identity(const Identity& identity, std::uint32_t domain);
Identity read_identity(const std::string& line, std::uint32_t& domain);

/// Two launchers that may not be in one domain at the same time: of two machines, or of the same host of one
/// machine.
bool conflict(const Identity& a, const Identity& b);

}  // namespace trunnion::cluster
