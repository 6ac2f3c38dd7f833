// SPDX-License-Identifier: Apache-2.0
// Where the axes of a machine go on the way of one command.
#pragma once

#include "geometry/chain.hpp"
#include "language/canonical.hpp"

namespace trunnion::channel_setup {

using language::AxisValues;

/// The smallest and the largest machine coordinate of every axis, mm and degrees.
struct AxisBox {
  AxisValues low{}, high{};
  /// The box of one point.
  static AxisBox of(const AxisValues& point) { return {point, point}; }
  void include(const AxisBox& other);
};

/// The box of a move (rapid, line or arc) from `from`, both in the frame of `move.modal.transformation`, with
/// the extremes of arcs and of the swings that the linear axes make when rotary axes turn under a tool tip
/// that is held. Places 10 degrees of an arc and 2 degrees of a rotary axis apart are looked at, and an
/// extreme between them is searched for: what is missed is below 1 um for a radius of 1 m. `chain` is what
/// the transformation goes through.
AxisBox extent_of(const AxisValues& from, const language::Command& move, const geometry::Chain& chain);

}  // namespace trunnion::channel_setup
