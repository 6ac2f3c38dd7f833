// SPDX-License-Identifier: Apache-2.0
// The positions of the axes at which a machine with known errors puts its tool where the control wants it.
#pragma once

#include <string>
#include <variant>

#include "compensation/error_model.hpp"

namespace trunnion::volumetric {

struct CompensationSettings {
  bool orientation = false;  ///< rotary axes correct the direction of the tool
  /// Near a pole a rotary axis hardly changes the direction of the tool. With s = change of direction by its
  /// motion, rad/rad, the share (damping^2 / (s^2 + damping^2))^3 of the error remains (three steps of
  /// Levenberg's method), so that no rotary axis is corrected by more than error / damping. At least 1e-4.
  double damping = 0.08;
};

/// What is added to the commanded positions, X Y Z A B C U V W, mm or deg.
struct PositionCorrection {
  std::array<double, axis_count> added{};
  bool converged = true;
  int iterations = 0;
};

/// The inverse of ErrorModel: solves pose(q + correction) = ideal_pose(q). The rotary axes take three damped
/// steps, a smooth function of the pose; then the linear axes put the tip to its place by Newton's method
/// with the derivatives of the chain, which leaves less than 1e-9 mm. Pure, without allocation, the same bits
/// on every host.
class VolumetricCompensation {
 public:
  static constexpr int rotary_steps = 3, most_iterations = 10;
  static constexpr double last_step = 1e-9;  ///< mm: a smaller step ends the iteration

  /// `design` is the chain by which the control moves, `errors` its errors. Otherwise one line that says what
  /// does not fit.
  static std::variant<VolumetricCompensation, std::string> make(const geometry::ChainParameters& design,
                                                                const GeometryErrors& errors,
                                                                const CompensationSettings& settings);

  /// For the commanded positions, directions and tool length of `commanded`. Not converged: no correction
  /// exists, because the linear axes are in one plane, or errors are too large; `added` is zero then.
  PositionCorrection correction(const MachinePose& commanded) const;

  const ErrorModel& model() const { return model_; }

 private:
  VolumetricCompensation(ErrorModel model, const CompensationSettings& settings)
      : model_(std::move(model)), settings_(settings) {}

  ErrorModel model_;
  CompensationSettings settings_;
  std::array<std::size_t, 6> rotary_{};
  std::size_t rotary_count_ = 0;
};

}  // namespace trunnion::volumetric
