// SPDX-License-Identifier: Apache-2.0
// The protocol of a measurement of the kinematics, as text.
#pragma once

#include <string>

#include "calibration/evaluation.hpp"

namespace trunnion::calibration {

struct ProtocolHead {
  std::string date, time;    ///< "2026-01-31", "12:00:00"
  std::string file, source;  ///< of the protocol itself; where the touches come from
};

/// Table of the differences (expected less measured centre of each pose, as the manual's), residuals and
/// diameters, vectors before and after with their uncertainty. Lengths in mm. Same inputs, same bytes.
std::string protocol_text(const ProtocolHead& head, const MeasurementInputs& inputs,
                          const MeasuredMachine& machine, const KinematicsResult& result);

}  // namespace trunnion::calibration
