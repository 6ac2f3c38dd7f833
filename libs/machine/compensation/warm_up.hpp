// SPDX-License-Identifier: Apache-2.0
// The temperatures of a machine's axes and of its spindle, which rise with their motion.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "geometry/types.hpp"

namespace trunnion::volumetric {

/// X Y Z A B C U V W, and the spindle.
inline constexpr std::size_t axis_count = 9, heat_source_count = 10, spindle_source = 9;

/// Temperature rises above the reference temperature of 20 degrees Celsius (ISO 1), K.
using Temperatures = std::array<double, heat_source_count>;

/// What warms one axis or the spindle and what its temperature does. Rise and effect are in proportion.
struct HeatSource {
  double rise_per_speed = 0;    ///< final rise: K per mm/s, deg/s or (spindle) 1/min
  double constant_rise = 0;     ///< final rise at rest: an ambient temperature that is not 20 degrees, K
  double time_constant = 1800;  ///< s, above zero
  double expansion = 0;         ///< linear axis: 1/K, of its measuring system or screw
  double fixed_point = 0;       ///< mm: the position that does not shift by the expansion
  geometry::Vec3 shift = geometry::Vec3::Zero();  ///< mm/K, as the axis's EX. EY. EZ.
  geometry::Vec3 tilt = geometry::Vec3::Zero();   ///< rad/K, as the axis's EA. EB. EC.
};

using HeatSources = std::array<HeatSource, heat_source_count>;

/// First-order warm-up: dT/dt = (rise_per_speed * |speed| + constant_rise - T) / time_constant.
class WarmUp {
 public:
  WarmUp() = default;
  /// Continues from these temperatures.
  explicit WarmUp(const Temperatures& rise) : rise_(rise) {}

  /// Advances by `dt` s at `speeds` (mm/s, deg/s, 1/min; any sign). Backward Euler, whose bits do not depend
  /// on the host's exponential function and whose error over a warm-up is below dt / time_constant.
  void step(const HeatSources& sources, const std::array<double, heat_source_count>& speeds, double dt);
  const Temperatures& temperatures() const { return rise_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("rise", self.rise_);
  }

 private:
  Temperatures rise_{};
};

}  // namespace trunnion::volumetric
