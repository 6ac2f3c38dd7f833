// SPDX-License-Identifier: Apache-2.0
// A machine on the command line, and values of it for one call.
#pragma once

#include <cstdint>
#include <string>

#include "machine/parameters.hpp"

namespace trunnion::cli {

/// The directory of a name under configs/machines, a directory with machine.yaml, or that file. Throws
/// std::runtime_error.
std::string machine_directory(const std::string& machine);

/// NUMBER=VALUE of a parameter, or NAME=X,Y,Z of a correction of the kinematic chain. Throws
/// std::runtime_error.
void apply_setting(machine::Parameters& parameters, std::uint16_t channel, const std::string& setting);

}  // namespace trunnion::cli
