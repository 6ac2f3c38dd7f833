// SPDX-License-Identifier: Apache-2.0
// Compensation of thermal expansion by tables over temperature (HNC-8 parameters 30a005 .. 30a010; 30a011 ..
// 30a017 inferred).
#pragma once

#include "compensation/error_table.hpp"

namespace trunnion::compensation {

/// Adds offset + slope * (x - reference). Offset and slope are tables over the temperatures of two sensors,
/// which are parameters 010950 ..: a new value arrives as a new revision, so it takes effect at a stated
/// cycle.
struct Thermal {
  bool enabled = false;
  double reference = 0;                    ///< mm or deg
  double offset_target = 0;                ///< mm or deg
  double slope_target = 0;                 ///< mm/mm or deg/deg
  double offset_rate = 0, slope_rate = 0;  ///< largest change in one cycle
  double offset = 0, slope = 0;            ///< state

  /// Throws machine::KinematicsError.
  static Thermal read(TableReader& reader, std::uint32_t axis);

  double add(double x) {
    offset += std::clamp(offset_target - offset, -offset_rate, offset_rate);
    slope += std::clamp(slope_target - slope, -slope_rate, slope_rate);
    return offset + slope * (x - reference);
  }
};

}  // namespace trunnion::compensation
