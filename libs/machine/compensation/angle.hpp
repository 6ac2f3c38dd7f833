// SPDX-License-Identifier: Apache-2.0
// Angle compensation (HNC-8 parameters 30a080 .. 30a089, 30a095 .. 30a104).
#pragma once

#include "compensation/axis_motion.hpp"
#include "compensation/channel_columns.hpp"

namespace trunnion::compensation {

/// The motion of the reference axis turns the carriage by the angle of a table; the axis that owns the
/// parameters is the lever arm: (axis - reference point) * tan(angle) is added to the compensated axis. The
/// manual names the three axes and not their roles: this reading is inferred.
struct AngleCompensation {
  std::size_t reference = 0, arm = 0, compensated = 0;  ///< columns
  double point = 0;                                     ///< mm
  ErrorTable table;                                     ///< deg

  double at(const double* x, double direction) const;
};

/// Those of the two of axis `number` that are on. Throws machine::KinematicsError.
std::vector<AngleCompensation> read_angles(TableReader& reader, std::uint32_t number,
                                           const ChannelColumns& columns);

}  // namespace trunnion::compensation
