// SPDX-License-Identifier: Apache-2.0
// JSON of an HTTP body -> a request to the measurement service, checked.
#pragma once

#include <map>

#include "calibration/last_calibration.hpp"
#include "core/requests.hpp"
#include "core/router.hpp"
#include "machine/parameters.hpp"

namespace trunnion::gateway {

/// Of the operations measurement_start .. measurement_discard. Start: {"channel", "inputs": YAML, "mode",
/// "sphere_mm": [X, Y, Z], "probe_length_mm", "retract"}, all optional; confirm: {"acknowledge"}; the others
/// have no fields. Throws BadRequest.
idl::measurement::MeasurementRequest measurement_request(Operation operation, const bus::Json& body);

/// One import of `values` in the name of `who`, which can be undone as a calibration.
idl::parameters::ParameterRequest calibration_request(
    const std::map<std::uint32_t, machine::ParameterValue>& values, const std::string& who);
/// One import of the values before `last`, in the name of `who`.
idl::parameters::ParameterRequest undo_request(const calibration::LastCalibration& last,
                                               const std::string& who);
/// {"time", "who", "changes": [{"number", "before", "after"}]} of a calibration that can be undone.
bus::Json calibration_answer(const calibration::LastCalibration& last);

}  // namespace trunnion::gateway
