// SPDX-License-Identifier: Apache-2.0
// Centre and sweep of a programmed circle or helix.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "language/alarms.hpp"
#include "language/canonical.hpp"

namespace trunnion::language {

inline constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

/// Ends of an arc nearer to each other in the plane than this (mm) are one point: a full circle.
inline constexpr double same_point = 1e-6;

/// Given plane and clockwise in `arc`, sets centre and sweep from the centre's offset to the start (I, J, K).
/// `turns` (>= 1) counts begun turns: each above 1 adds 360 degrees. The radii at both ends may differ by at
/// most `deviation` mm. Frames and units as in Command.
AlarmNumber arc_from_centre(const AxisValues& start, const AxisValues& target,
                            const std::array<double, 3>& centre_offset, unsigned turns, double deviation,
                            Arc& arc);

/// As above from a radius (R): > 0 for the arc up to 180 degrees, < 0 for the longer one. A radius short of
/// half the chord by at most `deviation` makes a half circle.
AlarmNumber arc_from_radius(const AxisValues& start, const AxisValues& target, double radius, unsigned turns,
                            double deviation, Arc& arc);

/// Where the arc from `start` to `target` is when `share` (0..1) of its sweep is done: on the circle or
/// helix, the radius running linearly between those of its ends; all other axes in proportion.
AxisValues point_on_arc(const AxisValues& start, const AxisValues& target, const Arc& arc, double share);

/// Shares (0..1) of its sweep at which the circle from `start` turns back along `axis` (X, Y or Z): the first
/// two, half a turn apart, behind which it only repeats itself. Below 0: there is none.
std::array<double, 2> turning_shares(const AxisValues& start, const Arc& arc, std::size_t axis);

}  // namespace trunnion::language
