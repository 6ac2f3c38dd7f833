// SPDX-License-Identifier: Apache-2.0
// Which instrument measures along which line: plan.yaml of `trunnion measure geometry`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "truth/measurement.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::identification {

/// An error of a linear axis by its name: EXX, EYX .. ECZ.
struct LinearAxisError {
  std::size_t component = 0;  ///< 0 .. 2 translation along X Y Z, 3 .. 5 rotation about X Y Z
  std::size_t axis = 0;       ///< 0 .. 2: X Y Z
};
std::optional<LinearAxisError> linear_axis_error(const std::string& name);

/// A rotation about the tool does not move the tool's axis: no laser shows it.
bool laser_shows(const LinearAxisError& error, const truth::Vec3& tool_direction);

enum class InstrumentKind { laser, ballbar, nest };

/// One line, circle or turn.
struct Measurement {
  InstrumentKind kind = InstrumentKind::laser;
  std::string name;                          ///< "laser EXX", "ballbar XY", "rtest C"
  truth::LaserPlan laser;                    ///< of a laser
  truth::BallbarPath ballbar;                ///< of a ballbar
  std::size_t axis = 0;                      ///< of an R-test: 3 .. 8
  double from = 0, to = 360;                 ///< of an R-test, deg
  std::size_t points = 13;                   ///< of an R-test
  truth::Vec3 centre = truth::Vec3::Zero();  ///< of an R-test: the ball in the frame of the workpiece, mm
  double tool_length = 0;                    ///< mm
  double uncertainty = 1e-3;                 ///< standard uncertainty of one reading, mm or rad

  /// The reference of a straightness is parallel to the table (its surface, its slot); otherwise its
  /// direction is unknown.
  bool aligned = false;

  bool angular() const { return kind == InstrumentKind::laser && laser.component > 2; }
  bool straightness() const {
    return kind == InstrumentKind::laser && laser.component < 3 && laser.component != laser.axis;
  }
};

struct MeasurementPlan {
  std::string structure;  ///< ISO 10791; empty: as parameter 04c955
  std::vector<Measurement> measurements;
};

/// Throws std::runtime_error that begins with file:line:column.
MeasurementPlan parse_plan(const std::string& text, const std::string& file,
                           const machine::MachineOutline& machine);

/// What the instrument shows on the machine of `report`: of a laser the mean deviations of the runs at each
/// target, up, then down; of a ballbar both circles; of a nest x y z of each angle, there and back. mm or
/// rad.
std::vector<double> readings(truth::PoseReport report, const Measurement& measurement,
                             const truth::InstrumentTruth& instrument);

/// The instrument of a measurement: ballbar, laser, laser_angle, rtest in truth.yaml.
truth::InstrumentTruth instrument_of(const truth::Truth& truth, const Measurement& measurement);

}  // namespace trunnion::identification
