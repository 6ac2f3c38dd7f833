// SPDX-License-Identifier: Apache-2.0
// The least time any motion along a path can take when axes are limited in velocity and acceleration only.
#pragma once

#include <vector>

#include "canonical/axes.hpp"
#include "motion/limits.hpp"

namespace trunnion::analysis {

using canonical::AxisValues;

/// A place of a path: machine positions of the axes at the path length `s`, and the speed allowed there.
struct PathSample {
  double s = 0;          ///< strictly growing
  AxisValues machine{};  ///< after the transformation
  double speed = 1e9;    ///< programmed, per second
};

/// Time-optimal sweep: with x = (ds/dt)^2 every axis demands |q' x' / 2 + q'' x| <= a and |q'| sqrt(x) <= v;
/// the largest x that keeps this forwards from rest and backwards from rest is the bound. Derivatives are
/// central differences of the samples, so a corner between samples counts as rounded over their distance.
/// At least two samples, of a path of any length in constant memory.
class AccelerationBound {
 public:
  explicit AccelerationBound(const motion::Limits& limits) : limits_(limits) {}
  /// The next place of the path. `speed` holds from there on.
  void add(const PathSample& sample);
  /// The speed allowed at the newest place is at most this.
  void slow(double speed);
  /// Seconds; the path has ended. The next one may begin.
  double finish();

 private:
  void sweep(bool ends);

  motion::Limits limits_;
  std::vector<PathSample> window_;
  double first_ = 0, second_ = 0;  // x at the first two places of a window that continues
  bool continues_ = false;
  double time_ = 0;
};

/// Least time for a full circle from rest to rest when the vectors of acceleration and jerk, whatever their
/// direction, stay within the limits of one axis: speed sqrt(a r) (or cbrt(j r^2)), reached and left in ramps
/// in which the acceleration along the path u, its normal part v^2/r, and the two parts of the jerk,
/// u' - v^3/r^2 along the path and 3 v u / r across it, share the limits. Axes whose directions are used one
/// by one may be a little faster. Millimetres and seconds, all above 0.
double circle_time(double radius, double acceleration, double jerk);

}  // namespace trunnion::analysis
