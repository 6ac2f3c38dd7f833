// SPDX-License-Identifier: Apache-2.0
// From touches to the vectors of the kinematics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/circle_corrections.hpp"
#include "calibration/touches.hpp"
#include "metrology/axis_of_rotation.hpp"
#include "metrology/kinematic_fit.hpp"

namespace trunnion::calibration {

struct PoseResult {
  Angles angles{};
  std::size_t touches = 0;
  Vec3 centre = Vec3::Zero();      ///< mm: X, Y, Z with the ball's centre in that of the sphere
  Vec3 difference = Vec3::Zero();  ///< mm: expected less measured centre, zero at the first pose
  Vec3 residual = Vec3::Zero();    ///< mm: measured less computed centre with the new vectors
  double diameter = 0;             ///< mm, measured
};

/// One rotary axis alone, from the circle of its centres.
struct AxisResult {
  std::size_t angle = 0;
  std::vector<std::size_t> rows;  ///< numbers of its poses
  metrology::AxisFit circle;
};

struct VectorChange {
  std::string name;  ///< "A", "B" ...: the rotary axis which the vector places
  metrology::Slot slot = metrology::Slot::table_2;
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();  ///< mm, offset with correction
  /// mm: what belongs to `direction_after`, other than `after` where directions are only reported.
  Vec3 with_directions = Vec3::Zero();
  Vec3 expanded = Vec3::Zero();  ///< mm, 95 %, of `after`
  std::array<bool, 3> observed{true, true, true};
  Vec3 direction_before = Vec3::UnitZ(), direction_after = Vec3::UnitZ();  ///< ideal and real unit vector
  Vec3 direction_expanded = Vec3::Zero();
};

struct KinematicsResult {
  std::vector<PoseResult> poses;
  std::vector<AxisResult> axes;
  std::vector<VectorChange> vectors;
  std::vector<ChainCorrection> corrections;  ///< the same as the manual has them; see circle_corrections()
  metrology::ChainParameters before, after;  ///< after: what is to be written
  double ball_diameter = 0;                  ///< mm, effective: calibrated, or that of the inputs
  double touch_deviation = 0;                ///< mm, standard deviation of a touch by the residuals
  std::size_t freedom = 0;
  double condition = 0;
  Vec3 sphere = Vec3::Zero();  ///< mm, its centre in the workpiece frame
  std::vector<std::string> not_observed;
  double largest_change = 0;    ///< mm, of an offset vector
  std::string tolerance_alarm;  ///< not empty: the change of a vector is beyond the tolerance
  std::vector<std::string> warnings;
};

/// `in_correction`: slots that have a named correction, which takes the change. Reference::adapt needs the
/// reference's measurement in the inputs. Throws std::runtime_error: one line with pose, value and limit;
/// nothing can be written then.
KinematicsResult evaluate(const MeasurementInputs& inputs, const MeasuredMachine& machine,
                          const std::vector<TouchedPose>& touched,
                          const std::array<bool, metrology::slot_count>& in_correction = {});

}  // namespace trunnion::calibration
