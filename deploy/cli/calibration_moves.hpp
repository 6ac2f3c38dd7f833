// SPDX-License-Identifier: Apache-2.0
// The moves of a measurement of the kinematics among the bodies of the machine.
#pragma once

#include "calibration/measuring_program.hpp"
#include "collision_machine.hpp"
#include "machine_probe.hpp"

namespace trunnion::cli {

class CalibrationMoves {
 public:
  /// The bodies of the machine, with the probe of truth.yaml (one of the inputs' dimensions without it) and,
  /// where truth.yaml has no sphere, the sphere that the inputs expect. Throws std::runtime_error.
  CalibrationMoves(const TrueMachine& machine, const std::string& name, std::uint16_t channel,
                   const calibration::MeasurementInputs& inputs,
                   const calibration::MeasuredMachine& measured);

  /// Why the pose cannot be measured: bodies that meet at the approach position or during the touches, in
  /// which the ball may touch the sphere. Empty when it can.
  std::string fault_at(const calibration::PlannedPose& pose) const;
  /// A way on which no bodies meet. Throws std::runtime_error: one line.
  calibration::Way way(const calibration::AxisPosition& from, const calibration::AxisPosition& to) const;
  /// Every pose can be measured, and there is a way to each from the one before, the first one from `from`.
  /// Throws std::runtime_error: one line that names the pose. Returns the number of moves.
  std::size_t check(const calibration::MeasurementPlan& plan, const calibration::AxisPosition& from) const;
  /// `inputs` with the widest range of every rotary axis, in steps of 5 degrees about the middle of its
  /// range, in which all of its points can be measured. Throws std::runtime_error when no range of 10 degrees
  /// can.
  calibration::MeasurementInputs proposal() const;

 private:
  collision::AxisPosition approach(const calibration::PlannedPose& pose) const;
  calibration::Vec3 centre(const calibration::PlannedPose& pose) const;
  bool reachable(const calibration::Angles& angles) const;

  const calibration::MeasurementInputs& inputs_;
  const calibration::MeasuredMachine& measured_;
  collision::Travel travel_;
  std::optional<collision::CollisionModel> moving_, touching_;
  geometry::Chain chain_;
};

}  // namespace trunnion::cli
