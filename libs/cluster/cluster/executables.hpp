// SPDX-License-Identifier: Apache-2.0
// Executables that a cluster is started with in the place of its own: --exec SERVICE=PATH.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace trunnion::cluster {

/// Service to absolute path.
using Executables = std::map<std::string, std::string>;

/// From `SERVICE=PATH`, relative to the working directory. Throws std::runtime_error with one line: not of
/// this form, no such service, no such executable, two for one service.
Executables read_executables(const std::vector<std::string>& texts);

/// As they were read, with --exec before each.
std::vector<std::string> executable_arguments(const Executables& executables);

}  // namespace trunnion::cluster
