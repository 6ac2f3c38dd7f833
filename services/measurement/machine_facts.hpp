// SPDX-License-Identifier: Apache-2.0
// The files of the machine that a measurement needs.
#pragma once

#include "machine/machine.hpp"
#include "measurement.hpp"

namespace trunnion::measurement {

/// parameters.yaml, truth.yaml (probe and sphere) and bodies.yaml in the machine's directory. Throws
/// std::runtime_error that begins with file:line:column.
MachineFacts load_facts(const machine::MachineConfig& machine);

}  // namespace trunnion::measurement
