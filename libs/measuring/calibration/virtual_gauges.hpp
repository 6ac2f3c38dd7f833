// SPDX-License-Identifier: Apache-2.0
// Probe and sphere of truth.yaml for a virtual measurement.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/measurement_inputs.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::calibration {

/// What is taken in place of truth.yaml, mm.
struct GaugeChanges {
  std::optional<double> repeatability, pre_travel, lobing;  ///< of the probe
  std::optional<std::uint64_t> seed;                        ///< of the probe
  std::optional<Vec3> sphere;                               ///< its true centre, workpiece frame
};

/// That of truth.yaml; without one, an exact probe as the inputs have it.
touch_probe::TouchProbeTruth true_probe(const truth::Truth& truth, const MeasurementInputs& inputs,
                                        const GaugeChanges& changes);

/// Those of truth.yaml; without a sphere among them, one where the inputs expect it.
std::vector<touch_probe::Solid> true_solids(const truth::Truth& truth, const MeasurementInputs& inputs,
                                            const GaugeChanges& changes);

}  // namespace trunnion::calibration
