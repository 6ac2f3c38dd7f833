// SPDX-License-Identifier: Apache-2.0
// A machine of the command line with its truth.yaml.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "identification/true_machine.hpp"

namespace trunnion::cli {

using identification::TrueMachine;

/// That of identification by a name as machine_directory() takes it.
TrueMachine load_true_machine(const std::string& machine, std::uint16_t channel,
                              const std::vector<std::string>& settings);

/// X,Y,Z in mm. Throws std::runtime_error that names the option.
truth::Vec3 coordinates(const std::string& option, const std::string& text);

}  // namespace trunnion::cli
