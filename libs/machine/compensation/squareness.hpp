// SPDX-License-Identifier: Apache-2.0
// Squareness compensation (HNC-8 parameters 30a030 .. 30a033, 30a040 .. 30a043).
#pragma once

#include "compensation/channel_columns.hpp"

namespace trunnion::compensation {

/// Adds (reference axis - reference point) * tan(angle) to the axis. The angle is positive when the axes
/// enclose more than 90 degrees.
struct Squareness {
  std::size_t reference = 0;  ///< column
  double point = 0;           ///< mm
  double tangent = 0;

  double at(const double* x) const { return (x[reference] - point) * tangent; }
};

/// Those of the two of axis `number` that are on. Throws machine::KinematicsError.
std::vector<Squareness> read_squareness(const machine::Parameters& parameters, std::uint32_t number,
                                        const ChannelColumns& columns);

}  // namespace trunnion::compensation
