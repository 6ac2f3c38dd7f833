// SPDX-License-Identifier: Apache-2.0
// The path of the tool tip from one point a cycle to few points.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace trunnion::gateway {

struct PathPoint {
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< mm
  std::uint32_t line = 0;
  bool rapid = false;
  double seconds = 0;
};

/// Leaves out what is within a tolerance of straight lines (strips, after Reumann and Witkam, 1974). The end
/// of every line of the program stays. When there are `most` points (at least 2), the tolerance doubles until
/// there are fewer, and ends of lines are left out, too.
class PlannedPath {
 public:
  explicit PlannedPath(std::size_t most, double tolerance = 0.01) : most_(most), tolerance_(tolerance) {}

  void add(const PathPoint& point);
  /// With the newest point.
  std::vector<PathPoint> points() const;
  double tolerance() const { return tolerance_; }  ///< mm
  bool whole() const { return whole_; }            ///< no end of a line was left out

 private:
  void take(const PathPoint& point);
  void keep(const PathPoint& point);

  const std::size_t most_;
  double tolerance_;
  bool whole_ = true;
  std::vector<PathPoint> kept_;
  PathPoint newest_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();  ///< of the strip from kept_.back(); 0: none yet
  double reach_ = 0;                                     ///< mm, of newest_ along it
};

}  // namespace trunnion::gateway
