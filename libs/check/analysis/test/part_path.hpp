// SPDX-License-Identifier: Apache-2.0
// The path of a commanded tool tip on the part, and how far two such paths are apart as curves.
#pragma once

#include <string>
#include <vector>

#include "channel_setup/channel_setup.hpp"
#include "geometry/types.hpp"

namespace trunnion::analysis {

using geometry::Vec3;

/// Tips of the program `text`, one per cycle and without those of a tool that stands, in the workpiece frame
/// of G54, mm: from the end of line `from` to the end of line `to`. Throws std::runtime_error when the
/// program ends with an alarm.
std::vector<Vec3> part_path(const std::string& text, channel_setup::ChannelSetup& machine, std::uint32_t from,
                            std::uint32_t to);

/// Largest distance (mm) of the points `of`, in the order in which they lie along it, from the curve through
/// `path`. Between two points of it the curve is taken as the chord or as the cubic through their neighbours,
/// whichever is nearer: the one is right at corners, the other leaves a smooth path by the fourth power of
/// the way between the points.
double farthest_from(const std::vector<Vec3>& path, const std::vector<Vec3>& of);

}  // namespace trunnion::analysis
