// SPDX-License-Identifier: Apache-2.0
// Commanded poses as text, and where the tool truly is at each: what `trunnion truth` prints.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compensation/volumetric_compensation.hpp"
#include "machine/machine_outline.hpp"
#include "truth/true_geometry.hpp"

namespace trunnion::truth {

/// True less ideal pose of the tool.
struct PoseDeviation {
  Vec3 tip = Vec3::Zero();   ///< mm
  Vec3 axis = Vec3::Zero();  ///< of the unit vectors: rad, across the axis to first order
};

struct PoseAnswer {
  MachinePose commanded;
  ToolPose actual;
  PoseDeviation deviation;
};

struct Spread {
  double mean = 0, percentile_95 = 0, maximum = 0;
};

struct DeviationSummary {
  std::size_t count = 0;
  Spread tip;   ///< length of the tip's deviation, mm
  Spread axis;  ///< angle between true and ideal axis, rad
};

class PoseReport {
 public:
  /// `model` is the chain by which the control believes the tool to be somewhere: that of the parameters in
  /// force.
  PoseReport(TrueGeometry geometry, geometry::Chain model, const machine::MachineOutline& machine);

  double tool_length = 0;  ///< mm
  Temperatures temperatures{};
  /// When present, what the control adds to the commanded positions.
  std::shared_ptr<const volumetric::VolumetricCompensation> compensation;

  /// A line of axis words: `X100 Y-20 A30 C45`, in any order; an axis that is not named is at zero. The
  /// direction of approach of each axis is that from the line before. Nothing for an empty line or a comment
  /// after `#` or `;`. Throws std::runtime_error that begins with "line:column: ".
  std::optional<PoseAnswer> answer(const std::string& line, std::size_t line_number);

  PoseAnswer at(const MachinePose& machine) const;
  /// Where the tool truly is when the control commands `machine`.
  ToolPose true_pose(const MachinePose& machine) const;
  /// `count` poses that are evenly distributed in the travel (of an endless axis: a turn), with either
  /// approach.
  std::vector<MachinePose> random_poses(std::size_t count, std::uint64_t seed) const;
  /// Of random_poses().
  DeviationSummary summary(std::size_t count, std::uint64_t seed) const;

  const TrueGeometry& geometry() const { return geometry_; }
  const geometry::Chain& model() const { return model_; }

 private:
  bool has(std::size_t axis) const;

  TrueGeometry geometry_;
  geometry::Chain model_;
  machine::MachineOutline machine_;
  std::array<int, axis_count> approach_{};
  std::optional<std::array<double, axis_count>> previous_;
};

/// The answer as numbers: tip x y z (mm), axis i j k, then their deviations in um and urad.
std::string text_of(const PoseAnswer& answer);

}  // namespace trunnion::truth
