// SPDX-License-Identifier: Apache-2.0
// Inputs of a measurement of the kinematics as YAML; docs/calibration.md has the format.
#pragma once

#include <string>

#include "calibration/measurement_inputs.hpp"

namespace trunnion::calibration {

/// Keys that are absent have the values of default_inputs(). Throws std::runtime_error that begins with
/// file:line:column.
MeasurementInputs parse_inputs(const std::string& text, const std::string& file,
                               const MeasuredMachine& machine);

/// A map of sphere_mm and zero_offset_mm, as text_of() writes it. Throws as parse_inputs().
ReferenceMeasurement parse_reference(const std::string& text, const std::string& file);
std::string text_of(const ReferenceMeasurement& reference);

}  // namespace trunnion::calibration
