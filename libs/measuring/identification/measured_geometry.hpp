// SPDX-License-Identifier: Apache-2.0
// A machine measured by a plan, its volumetric compensation from that, and what the compensation leaves.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "identification/geometry_fit.hpp"
#include "identification/improvement.hpp"

namespace trunnion::identification {

/// One measurement of the plan, before and with the compensation.
struct MeasuredRow {
  std::string name;
  bool angular = false;
  double before = 0, after = 0;  ///< root mean square of the readings, mm or rad
  /// Of the position of an axis by a laser, ISO 230-2.
  std::optional<truth::PositionAccuracy> accuracy_before, accuracy_after;
};

struct MeasuredGeometry {
  FitResult fit;
  std::map<std::uint32_t, machine::ParameterValue> values;  ///< parameters of the compensation
  std::vector<MeasuredRow> rows;
  VolumetricErrors before, after;  ///< about the mean deviation
};

struct GeometrySettings {
  std::uint16_t channel = 0;
  std::uint32_t first = 700000;  ///< parameter of the first table value
  std::size_t poses = 200;       ///< that `before` and `after` are of
  std::uint64_t seed = 1;        ///< of the poses
};

/// `report`: the machine; a compensation that it has is left out. `model`: the parameters of the control.
/// Throws std::runtime_error.
MeasuredGeometry measure_geometry(truth::PoseReport report, const truth::Truth& truth,
                                  const machine::MachineOutline& machine, const machine::Parameters& model,
                                  const MeasurementPlan& plan, const GeometrySettings& settings);

}  // namespace trunnion::identification
