// SPDX-License-Identifier: Apache-2.0
// The machine axes along the path, after the transformation.
#pragma once

#include <array>

#include "canonical/canonical.hpp"
#include "geometry/chain.hpp"

namespace trunnion::motion {

using canonical::AxisValues;

/// First to third derivative by the path length.
using PathRates = std::array<AxisValues, 3>;

/// Machine axis positions of a position in the frame of the command: with a chain, X Y Z are a tip and the
/// linear axes follow; without (nullptr) they are the axes. Tool length in mm.
AxisValues machine_axes(const AxisValues& position, const geometry::Chain* chain, double tool_length);

/// Derivatives of the machine axes where the path in the frame of the command has the position and the
/// derivatives given.
PathRates machine_rates(const AxisValues& position, const PathRates& rates, const geometry::Chain* chain,
                        double tool_length);

}  // namespace trunnion::motion
