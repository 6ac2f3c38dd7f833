// SPDX-License-Identifier: Apache-2.0
// Straightness compensation (HNC-8 parameters 30a050 .. 30a057, 30a065 .. 30a072).
#pragma once

#include "compensation/axis_motion.hpp"
#include "compensation/channel_columns.hpp"

namespace trunnion::compensation {

/// Adds the value of a table over the reference axis, which is not straight, to the axis.
struct Straightness {
  std::size_t reference = 0;  ///< column
  ErrorTable table;

  /// `direction`: of the reference axis, as AxisMotion.
  double at(const double* x, double direction) const { return table.at(x[reference], direction >= 0); }
};

/// Those of the two of axis `number` that are on. Throws machine::KinematicsError.
std::vector<Straightness> read_straightness(TableReader& reader, std::uint32_t number,
                                            const ChannelColumns& columns);

}  // namespace trunnion::compensation
