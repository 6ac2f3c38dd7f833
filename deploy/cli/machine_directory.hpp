// SPDX-License-Identifier: Apache-2.0
// A machine on the command line.
#pragma once

#include <string>

namespace trunnion::cli {

/// The directory of a name under configs/machines, a directory with machine.yaml, or that file. Throws
/// std::runtime_error.
std::string machine_directory(const std::string& machine);

}  // namespace trunnion::cli
