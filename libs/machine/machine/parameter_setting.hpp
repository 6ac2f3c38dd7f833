// SPDX-License-Identifier: Apache-2.0
// One value of a machine for one call, as it is typed.
#pragma once

#include <cstdint>
#include <string>

#include "machine/parameters.hpp"

namespace trunnion::machine {

/// NUMBER=VALUE of a parameter, or NAME=X,Y,Z of a correction of the kinematic chain, mm. Throws
/// std::runtime_error that names the option --set.
void apply_setting(Parameters& parameters, std::uint16_t channel, const std::string& setting);

}  // namespace trunnion::machine
