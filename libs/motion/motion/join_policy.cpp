// SPDX-License-Identifier: Apache-2.0
#include "motion/join_policy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/cell_builder.hpp"

namespace trunnion::motion {
namespace {

// Shorter segments, mm or degrees, are not worth rounding: their directions are mostly rounding themselves.
constexpr double shortest_rounded = 1e-5;

struct Pace {
  double speed = 1e5, acceleration = 1e9, jerk = 1e12;
};

Pace pace_of(const PathBlock& block, const AxisValues& direction, const Limits& limits) {
  Pace pace;
  if (!block.rapid) pace.speed = block.feed;
  for (std::size_t i = 0; i < direction.size(); ++i) {
    const double rate = std::abs(direction[i]);
    if (rate <= 0) continue;
    const AxisLimits& axis = limits.axes[i];
    pace.speed = std::min(pace.speed, (block.rapid ? axis.rapid_velocity : axis.velocity) / rate);
    pace.acceleration = std::min(pace.acceleration, axis.acceleration / rate);
    pace.jerk = std::min(pace.jerk, axis.jerk / rate);
  }
  return pace;
}

double ramp_time(double change, const Pace& pace) {
  const double limit = pace.acceleration * pace.acceleration / pace.jerk;
  return change > limit ? change / pace.acceleration + pace.acceleration / pace.jerk
                        : 2 * std::sqrt(change / pace.jerk);
}

// What a stop gains when both motions may overlap: see CellBuilder::overlap_time.
double overlap_estimate(const PathBlock& before, const PathBlock& block, const Pace& a, const Pace& b,
                        const Limits& limits) {
  const AxisValues first = before.path.derivatives(before.path.length())[0],
                   second = block.path.derivatives(0)[0];
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double q1 = std::abs(first[i]), q2 = std::abs(second[i]);
    if (q1 * a.jerk + q2 * b.jerk > limits.axes[i].jerk * (1 + 1e-9)) return 0;
    if (q1 * a.acceleration + q2 * b.acceleration > limits.axes[i].acceleration * (1 + 1e-9)) return 0;
  }
  const double tolerance = block.rules.contour_tolerance;
  return std::cbrt(6 * tolerance / a.jerk) + std::cbrt(6 * tolerance / b.jerk);
}

}  // namespace

bool stops_at_join(const PathBlock& before, const PathBlock& block, const Limits& limits) {
  if (before.path.unit() != block.path.unit()) return true;
  if (block.weight <= 0 && block.bend_weight <= 0) return false;
  // Exact joins: only what rounding makes of one straight line runs through.
  if (block.weight >= 1e290 || block.bend_weight >= 1e290) return true;
  if (block.weight <= 0) return false;
  // Two directions of length 1 that enclose an angle differ by twice the sine of its half.
  const double turn = std::hypot(block.turn[0], block.turn[1], block.turn[2]);
  if (limits.smooth_corner_angle < 180 &&
      turn > 2 * std::sin(limits.smooth_corner_angle * (std::numbers::pi / 360)))
    return true;
  const double length = std::min(before.move_length(), block.move_length());
  if (length < shortest_rounded) return true;
  const Pace a = pace_of(before, before.path.derivatives(before.path.length())[0], limits);
  const Pace b = pace_of(block, block.path.derivatives(0)[0], limits);
  const Pace pace{std::min(a.speed, b.speed), std::min(a.acceleration, b.acceleration),
                  std::min(a.jerk, b.jerk)};
  // What can be reached on the shorter segment from standstill to standstill.
  const double speed = std::min(
      {pace.speed, std::sqrt(pace.acceleration * length), std::cbrt(pace.jerk * length * length / 4)});
  const double through =
      join_speed(block.turn, std::min(6 / block.weight, BlendedPath::longest_reach), limits);
  if (!(through < speed)) return false;
  const double lost = ramp_time(speed - through, pace) * (speed - through) / speed;
  return lost > ramp_time(speed, pace) - overlap_estimate(before, block, a, b, limits);
}

}  // namespace trunnion::motion
