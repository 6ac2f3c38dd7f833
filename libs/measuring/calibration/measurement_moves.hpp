// SPDX-License-Identifier: Apache-2.0
// The moves of a measurement of the kinematics among the bodies of the machine.
#pragma once

#include "calibration/measuring_program.hpp"
#include "collision/bodies_file.hpp"
#include "collision/way_search.hpp"

namespace trunnion::calibration {

/// Nothing here changes, so another thread may ask while the owner does something else.
class MeasurementMoves {
 public:
  /// `bodies` of the machine, with those of `solids`, and without a tool unless the file has one. The probe
  /// is put on the tool: `probe`, or one of the inputs' dimensions. Where no solid is a sphere, the one that
  /// the inputs expect is added. `inputs` and `measured` must outlive the object. Throws
  /// std::runtime_error, one line, when the measuring path is so long that the stylus would meet the sphere.
  MeasurementMoves(collision::MachineBodies bodies, const std::vector<touch_probe::Solid>& solids,
                   const std::optional<touch_probe::TouchProbeTruth>& probe, const MeasurementInputs& inputs,
                   const MeasuredMachine& measured);

  /// Why the pose cannot be measured: bodies that meet at the approach position or during the touches, in
  /// which the ball may touch the sphere. Empty when it can.
  std::string fault_at(const PlannedPose& pose) const;
  /// A way on which no bodies meet. Throws std::runtime_error: one line.
  Way way(const AxisPosition& from, const AxisPosition& to) const;
  /// The pose can be measured, and there is a way to it from `from`. Returns its approach position. Throws
  /// std::runtime_error: one line that names the pose.
  AxisPosition check(const PlannedPose& pose, const AxisPosition& from) const;
  /// `inputs` with the widest range of every rotary axis, in steps of 5 degrees about the middle of its
  /// range, in which all of its points can be measured. Throws std::runtime_error when no range of 10 degrees
  /// can.
  MeasurementInputs proposal() const;

 private:
  collision::AxisPosition approach(const PlannedPose& pose) const;
  Vec3 centre(const PlannedPose& pose) const;
  bool reachable(const Angles& angles) const;

  const MeasurementInputs& inputs_;
  const MeasuredMachine& measured_;
  collision::Travel travel_;
  std::optional<collision::CollisionModel> moving_, uncertain_, touching_;
  geometry::Chain chain_;
};

}  // namespace trunnion::calibration
