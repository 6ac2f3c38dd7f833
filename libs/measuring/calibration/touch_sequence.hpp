// SPDX-License-Identifier: Apache-2.0
// Which touches come next in a measurement of the kinematics: every pose is touched twice, about the expected
// centre of the sphere and about the one that the first touches gave.
#pragma once

#include "calibration/touches.hpp"

namespace trunnion::calibration {

class TouchSequence {
 public:
  /// `done` are poses that were touched before; they must be the first ones of the plan, with all their
  /// touches and within the tolerances of the inputs. The arguments must outlive the sequence. Throws
  /// std::runtime_error: one line that names the pose.
  TouchSequence(const MeasurementInputs& inputs, const MeasuredMachine& measured, const MeasurementPlan& plan,
                std::vector<TouchedPose> done);

  bool finished() const { return done_.size() == plan_.poses.size(); }
  /// The pose to be touched. Not when finished().
  const PlannedPose& pose() const { return plan_.poses[done_.size()]; }
  /// The name of pose().
  std::string name() const;
  /// Where the centre is expected: position of X, Y, Z, mm, with the ball's centre in that of the sphere.
  Vec3 centre() const;
  /// The touches of pose() about centre(). True when the pose is complete. Throws std::runtime_error that
  /// names the pose: the touches are on no sphere, or beyond a tolerance. The sequence has ended then.
  bool take(const std::vector<Vec3>& positions);
  /// The complete poses.
  const std::vector<TouchedPose>& done() const { return done_; }

 private:
  void begin_pose();

  const MeasurementInputs& inputs_;
  const MeasuredMachine& measured_;
  const MeasurementPlan& plan_;
  geometry::Chain chain_;
  std::vector<TouchedPose> done_;
  TouchedPose current_;
  Vec3 expected_ = Vec3::Zero();  ///< mm, workpiece frame
  double ball_ = 0;               ///< mm, effective diameter
};

}  // namespace trunnion::calibration
