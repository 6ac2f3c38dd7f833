// SPDX-License-Identifier: Apache-2.0
// The arguments of CYCLE9960 (A650, 2022) in a part program, as inputs of a measurement.
#pragma once

#include <string>

#include "calibration/measuring_program.hpp"

namespace trunnion::calibration {

/// Arguments of the call by their place from 1, without those that are left out.
using CycleArguments = MacroVariables;

/// The inputs as the text of an inputs file. What is left out is as in default_inputs(). The manual names the
/// inputs and prints four calls; the places follow from these and their protocols, and the digits of S_MVAR
/// from the value that all four have (docs/calibration.md). Throws std::runtime_error: one line that begins
/// with "CYCLE9960" and names the argument, its value and its limits.
std::string inputs_text(const CycleArguments& arguments, const MeasuredMachine& machine);

/// The centre of the sphere in the workpiece frame, mm, when the probe stands over its pole at `position`:
/// between ball and sphere is the measuring path, along the tool. In the sample programs this is 20 mm over
/// the centre: 30 / 2 + 6 / 2 + 2.
Vec3 sphere_under_probe(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                        const AxisPosition& position);

}  // namespace trunnion::calibration
