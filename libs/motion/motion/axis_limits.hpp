// SPDX-License-Identifier: Apache-2.0
// The limits at one place of a cell, for every axis by itself. LimitCell's ramps hold on the whole cell and
// up to a speed, so they give away what the axes permit at one place and not at another.
#pragma once

#include "motion/limit_cell.hpp"

namespace trunnion::motion {

/// Derivatives of an axis by the path length.
struct AxisRates {
  double first = 0, second = 0, third = 0;
};

/// At `part` (0..1) of a cell that is `length` long. The first derivative is taken with the third, which is
/// nearly constant on a cell.
AxisRates rates_at(const AxisOnCell& axis, double part, double length);

/// The same where the third derivative changes linearly on the cell, as on every rounding.
AxisRates exact_rates(const AxisOnCell& axis, double part, double length);

struct Range {
  double low = 0, high = 0;
};

/// Path jerk at speed v and acceleration a, `part` (0..1) along the cell. Empty (low > high) when an axis
/// leaves its limits whatever the jerk is.
Range jerk_range(const LimitCell& cell, double part, double v, double a);

/// Path accelerations at speed v that the axes permit with a margin for jerk in both directions. May be
/// empty.
Range acceleration_range(const LimitCell& cell, double part, double v);

/// True when constant jerk from one state to the next keeps the limits of every axis on every cell it runs
/// over; the path ends at a stop or behind the last cell. Moves `cell` along. The times between the states
/// must be so short that speed and acceleration change little.
bool keeps_axes(const PathState& from, const PathState& to, double jerk, const CellRing& cells,
                std::uint64_t& cell);

}  // namespace trunnion::motion
