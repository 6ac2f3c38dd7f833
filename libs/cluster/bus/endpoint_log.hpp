// SPDX-License-Identifier: Apache-2.0
// Notes which topics a process opens, for the tests of its rights.
#pragma once

#include <string>

namespace trunnion::bus {

/// Appends "<identity> writes|reads <topic>" to the file that the environment variable TRUNNION_ENDPOINTS
/// names, if it does: what a process opens is what it needs rights for (docs/security.md), also where
/// discovery would miss it because it exists for a moment only. Throws std::runtime_error when the file
/// cannot be written.
void log_endpoint(const std::string& identity, bool writes, const std::string& topic);

}  // namespace trunnion::bus
