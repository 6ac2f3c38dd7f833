// SPDX-License-Identifier: Apache-2.0
// A measurement by the calibration program %001, from the macro variables that it has left.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "calibration/touches.hpp"

namespace trunnion::calibration {

struct ProgramMeasurement {
  MeasurementInputs inputs;
  std::vector<TouchedPose> touched;  ///< the initial pose first
};

/// docs/calibration-programs.md has the numbers. Sphere, ball, tool length and the ranges of the rotary axes
/// are those of the variables, the other inputs are `inputs`; the effective ball is that of the initial pose.
/// Throws std::runtime_error: one line with the variable, its value and what is expected.
ProgramMeasurement measurement_of(const std::map<std::uint32_t, double>& variables, MeasurementInputs inputs,
                                  const MeasuredMachine& machine);

}  // namespace trunnion::calibration
