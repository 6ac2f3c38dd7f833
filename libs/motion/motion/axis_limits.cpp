// SPDX-License-Identifier: Apache-2.0
#include "motion/axis_limits.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

// Ranges leave this for the change along a short step; the check afterwards may use half of it.
constexpr double range_share = 0.999;
constexpr double checked_share = 1.0003;
// Jerk that stays free when an acceleration is chosen.
constexpr double kept_jerk = 0.05;

// Narrows the range of x so that |offset + factor x| <= limit.
inline void narrow(Range& range, double offset, double factor, double limit) {
  if (std::abs(factor) < 1e-12) {
    if (std::abs(offset) > limit) range = {1, -1};
    return;
  }
  const double inverse = 1 / factor, middle = -offset * inverse, reach = std::abs(limit * inverse);
  range.low = std::max(range.low, middle - reach);
  range.high = std::min(range.high, middle + reach);
}

bool within_axis_limits(const LimitCell& cell, double part, const PathState& state, double jerk) {
  if (cell.uniform || cell.axis_count == 0) {
    const RampLimits& ramp = cell.uniform ? cell.ramps[0] : cell.ramp(state.v);
    return std::abs(state.a) <= ramp.acceleration * (1 + relative_rounding) + 1e-6 &&
           std::abs(jerk) <= ramp.jerk * (1 + relative_rounding);
  }
  const double v = state.v, a = state.a;
  for (int i = 0; i < cell.axis_count; ++i) {
    const AxisOnCell& axis = cell.axes[static_cast<std::size_t>(i)];
    const AxisRates q = rates_at(axis, part, cell.end - cell.at);
    if (std::abs(q.second * v * v + q.first * a) > checked_share * static_cast<double>(axis.acceleration))
      return false;
    if (std::abs(v * (q.third * v * v + 3 * q.second * a) + q.first * jerk) >
        checked_share * static_cast<double>(axis.jerk))
      return false;
  }
  return true;
}

}  // namespace

AxisRates rates_at(const AxisOnCell& axis, double part, double length) {
  const auto mix = [part, &axis](std::size_t n) {
    return static_cast<double>(axis.begin[n]) +
           part * (static_cast<double>(axis.end[n]) - static_cast<double>(axis.begin[n]));
  };
  const double third = mix(2);
  return {mix(0) - third * length * length * part * (1 - part) / 2, mix(1), third};
}

AxisRates exact_rates(const AxisOnCell& axis, double x, double length) {
  const auto mix = [x, &axis](std::size_t n) {
    const auto begin = static_cast<double>(axis.begin[n]), end = static_cast<double>(axis.end[n]);
    return begin + x * (end - begin);
  };
  const auto third = static_cast<double>(axis.begin[2]), change = static_cast<double>(axis.end[2]) - third;
  const double bow = x * (1 - x) / 2;
  return {mix(0) - length * length * (third * bow + change * (x - x * x * x) / 6),
          mix(1) - length * change * bow, third + x * change};
}

Range jerk_range(const LimitCell& cell, double part, double v, double a) {
  if (cell.uniform || cell.axis_count == 0) {
    const RampLimits& ramp = cell.uniform ? cell.ramps[0] : cell.ramp(v);
    return {-ramp.jerk, ramp.jerk};
  }
  Range range{-1e12, 1e12};
  for (int i = 0; i < cell.axis_count; ++i) {
    const AxisOnCell& axis = cell.axes[static_cast<std::size_t>(i)];
    const AxisRates q = rates_at(axis, part, cell.end - cell.at);
    narrow(range, v * (q.third * v * v + 3 * q.second * a), q.first,
           range_share * static_cast<double>(axis.jerk));
  }
  return range;
}

Range acceleration_range(const LimitCell& cell, double part, double v) {
  if (cell.uniform || cell.axis_count == 0) {
    const RampLimits& ramp = cell.uniform ? cell.ramps[0] : cell.ramp(v);
    return {-ramp.acceleration, ramp.acceleration};
  }
  Range range{-1e9, 1e9};
  for (int i = 0; i < cell.axis_count; ++i) {
    const AxisOnCell& axis = cell.axes[static_cast<std::size_t>(i)];
    const AxisRates q = rates_at(axis, part, cell.end - cell.at);
    narrow(range, q.second * v * v, q.first, range_share * static_cast<double>(axis.acceleration));
    const double bend = q.third * v * v * v, jerk = static_cast<double>(axis.jerk);
    narrow(range, bend, 3 * q.second * v, std::max((1 - kept_jerk) * jerk, std::abs(bend)));
  }
  return range;
}

bool keeps_axes(const PathState& from, const PathState& to, double jerk, const CellRing& cells,
                std::uint64_t& cell) {
  const double fastest = std::max(from.v, to.v);
  if (std::min(from.v, to.v) < -1e-6) return false;
  const auto part = [](const LimitCell& here, double s) {
    const double length = here.end - here.at;
    return length > 0 ? std::clamp((s - here.at) / length, 0.0, 1.0) : 0.0;
  };
  const auto between = [&](double share) {
    return PathState{from.s + share * (to.s - from.s), from.v + share * (to.v - from.v),
                     from.a + share * (to.a - from.a)};
  };
  if (!within_axis_limits(cells[cell], part(cells[cell], from.s), from, jerk)) return false;
  double entered = 0;  // share of the step that is done
  while (true) {
    const LimitCell& here = cells[cell];
    if (fastest > here.top * (1 + relative_rounding) + 1e-9) return false;
    const bool last = to.s <= here.end;
    const double left = last ? 1 : std::clamp((here.end - from.s) / (to.s - from.s), entered, 1.0);
    const PathState middle = between(0.5 * (entered + left)), edge = between(left);
    if (!within_axis_limits(here, part(here, middle.s), middle, jerk)) return false;
    if (!within_axis_limits(here, part(here, edge.s), edge, jerk)) return false;
    if (last) return true;
    if (cell + 1 >= cells.size() || cells[cell + 1].stop) return to.s <= here.end + rounding_distance;
    if (!within_axis_limits(cells[cell + 1], 0, edge, jerk)) return false;
    entered = left;
    ++cell;
  }
}

}  // namespace trunnion::motion
