// SPDX-License-Identifier: Apache-2.0
// A measurement of the kinematics by the probe of the machine that runs.
#pragma once

#include <functional>

#include "calibration/touches.hpp"
#include "program_runner.hpp"

namespace trunnion::cli {

/// The way of the axes between two positions. Throws std::runtime_error when there is none.
using WayBetween = std::function<calibration::Way(const calibration::AxisPosition& from,
                                                  const calibration::AxisPosition& to)>;

struct MachineMeasurement {
  const calibration::MeasurementInputs& inputs;
  const calibration::MeasuredMachine& machine;
  const calibration::MeasurementPlan& plan;
  std::uint16_t channel = 0;
  std::string touches_file;  ///< has every complete pose
  std::vector<calibration::TouchedPose> done;
  WayBetween way;  ///< empty: by the upper end of Z
  /// Before anything moves: the number of moves from here through all poses. Throws std::runtime_error.
  std::function<std::size_t(const calibration::AxisPosition& from)> check;
};

/// Checks the repeatability of the probe, then touches the poses that are not done. Every complete pose is in
/// the file at once. Progress goes to stderr. Throws std::runtime_error: one line with the phase and the
/// cause, and how to continue.
std::vector<calibration::TouchedPose> measure_on_machine(std::uint32_t domain,
                                                         const MachineMeasurement& measurement);

}  // namespace trunnion::cli
