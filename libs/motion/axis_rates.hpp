// How fast the machine axes move along a segment, after the transformation.
#pragma once

#include "geometry/chain.hpp"
#include "motion/path_segment.hpp"

namespace trunnion::motion {

/// Derivatives of the machine axis positions q by the path length s of a segment.
struct AxisRates {
  AxisValues at_start{};  ///< dq/ds
  AxisValues at_end{};    ///< dq/ds
  AxisValues largest{};   ///< largest |dq/ds| on the segment
  AxisValues bend{};      ///< largest |d2q/ds2| on the segment
};

/// Samples the rates: with a chain, positions are tips and the linear axes follow from its Jacobian; without
/// (nullptr) they are the axes. The samples stand closer than two degrees of rotary travel, at least three
/// and at most 65 of them.
AxisRates sample_rates(const PathSegment& segment, const geometry::Chain* chain, double tool_length);

/// Machine axis positions of a position in the frame of the command (see sample_rates).
AxisValues machine_axes(const AxisValues& position, const geometry::Chain* chain, double tool_length);

}  // namespace trunnion::motion
