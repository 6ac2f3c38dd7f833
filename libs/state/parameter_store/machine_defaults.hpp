// SPDX-License-Identifier: Apache-2.0
// What the files of a machine give the parameter store to begin with.
#pragma once

#include "machine/machine.hpp"
#include "parameter_store/parameter_store.hpp"

namespace trunnion::parameters {

/// Parameters, tools and offsets as the machine's directory has them. Throws std::runtime_error with
/// file:line:column.
MachineDefaults defaults_of(const machine::MachineConfig& machine);

}  // namespace trunnion::parameters
