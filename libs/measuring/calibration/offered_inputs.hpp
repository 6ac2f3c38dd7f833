// SPDX-License-Identifier: Apache-2.0
// The inputs that a machine offers for the measurement of its kinematics, to be shown and changed.
#pragma once

#include <nlohmann/json.hpp>

#include "calibration/measurement_inputs.hpp"
#include "machine/machine.hpp"

namespace trunnion::calibration {

/// The machine as its files (parameters.yaml, truth.yaml) and its active parameters have it. Throws
/// std::runtime_error: a file's fault begins with file:line:column.
MeasuredMachine load_measured_machine(const machine::MachineConfig& config, const machine::Parameters& active,
                                      std::uint16_t channel);

/// The inputs by the keys of their file (docs/calibration.md), in its units: parse_inputs() makes the same of
/// it, for JSON is YAML. Absent is what has no value.
nlohmann::ordered_json input_document(const MeasurementInputs& inputs);

/// Travel of each rotary axis that has one, by its letter: [low, high] in deg.
nlohmann::ordered_json travel_document(const MeasurementInputs& inputs, const MeasuredMachine& machine);

}  // namespace trunnion::calibration
