// SPDX-License-Identifier: Apache-2.0
// Whether the axes, spindles and gantries of a machine fit together, which no value alone shows.
#pragma once

#include <vector>

#include "machine/parameter_fault.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine {

/// Everything that is wrong with the axes of the channels, the spindles, the gantries, and the travel of the
/// axes. Empty for a machine that may move.
std::vector<ParameterFault> axis_faults(const Parameters& parameters);

}  // namespace trunnion::machine
