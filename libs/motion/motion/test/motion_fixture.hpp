// SPDX-License-Identifier: Apache-2.0
// What the tests of motion share: machines, programs, and a run that keeps every setpoint.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "geometry/chain.hpp"
#include "motion/axis_motion.hpp"
#include "motion/trajectory.hpp"

namespace trunnion::motion::test {

using canonical::Command;
using canonical::CommandKind;

inline constexpr double cycle = 0.001;

inline Limits uniform_limits(double velocity, double acceleration, int cycles) {
  Limits limits;
  limits.axes.fill({velocity, 2 * velocity, acceleration, 60000});
  limits.smoothing_cycles = cycles;
  return limits;
}

inline geometry::Chain ac_table() {
  geometry::ChainParameters p;
  p.table_1 = geometry::RotaryAxis{{-1, 0, 0}, {0, 0.1, 0}, 0};
  p.table_2 = geometry::RotaryAxis{{0, 0, -1}, {5, -4, -60}, 2};
  return std::get<geometry::Chain>(geometry::Chain::make(p));
}

inline Command line_to(const AxisValues& target, double feed_mm_per_minute, std::uint32_t number = 1) {
  Command c;
  c.kind = CommandKind::line;
  c.line = c.sequence = number;
  c.target = target;
  c.modal.feed = feed_mm_per_minute;
  return c;
}

inline Command arc_to(const AxisValues& target, double cx, double cy, double sweep, bool clockwise,
                      double feed) {
  Command c = line_to(target, feed);
  c.kind = CommandKind::arc;
  c.arc = {canonical::Plane::xy, clockwise, {cx, cy, 0}, sweep};
  return c;
}

struct Motion {
  std::vector<Setpoint> setpoints;
  bool stopped = false;  // came to rest by itself
};

using Override = std::function<double(std::size_t)>;

/// Feeds the program as room is there and steps until the trajectory rests, at most `most` cycles.
inline Motion run(
    Trajectory& t, const std::vector<Command>& program, std::size_t most = 2000000,
    const Override& feed = [](std::size_t) { return 1.0; }) {
  Motion result;
  std::size_t next = 0;
  bool finished = false;
  while (result.setpoints.size() < most) {
    while (next < program.size() && t.can_accept()) {
      if (!t.push(program[next++])) return result;
    }
    if (next == program.size() && !finished) {
      t.finish();
      finished = true;
    }
    result.setpoints.push_back(t.step(feed(result.setpoints.size()), 1, false));
    if (finished && result.setpoints.back().at_rest) {
      result.stopped = true;
      return result;
    }
  }
  return result;
}

struct Ratios {
  double velocity = 0, acceleration = 0,
         jerk = 0;  // largest finite difference of a machine axis by its limit
};

/// Finite differences of the machine axes over a run that began at rest at `start`.
inline Ratios axis_ratios(const Motion& run, const AxisValues& start, const Limits& limits,
                          const geometry::Chain* chain, double tool_length, bool rapid = false) {
  Ratios ratios;
  AxisValues q2 = machine_axes(start, chain, tool_length);
  AxisValues q1 = q2, q3 = q2;
  const double build_up = std::clamp(limits.smoothing_cycles, 1, max_smoothing_cycles) * cycle;
  for (const Setpoint& s : run.setpoints) {
    const AxisValues q = machine_axes(s.position, chain, tool_length);
    for (std::size_t i = 0; i < q.size(); ++i) {
      const AxisLimits& axis = limits.axes[i];
      const double velocity = std::abs(q[i] - q1[i]) / cycle;
      const double acceleration = std::abs(q[i] - 2 * q1[i] + q2[i]) / (cycle * cycle);
      ratios.velocity = std::max(ratios.velocity, velocity / (rapid ? axis.rapid_velocity : axis.velocity));
      ratios.acceleration = std::max(ratios.acceleration, acceleration / axis.acceleration);
      const double jerk = std::abs(q[i] - 3 * q1[i] + 3 * q2[i] - q3[i]) / (cycle * cycle * cycle);
      ratios.jerk = std::max(ratios.jerk, jerk / std::min(axis.jerk, axis.acceleration / build_up));
    }
    q3 = q2;
    q2 = q1;
    q1 = q;
  }
  return ratios;
}

inline double square_to_leg(const AxisValues& p, const AxisValues& a, const AxisValues& b) {
  double along = 0, length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (p[i] - a[i]) * (b[i] - a[i]);
    length += (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double f = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = p[i] - a[i] - f * (b[i] - a[i]);
    square += d * d;
  }
  return square;
}

/// Largest distance of a setpoint from the polyline `points` (X Y Z). Every leg counts for every setpoint,
/// but one that some leg near the last nearest brings within the largest distance so far cannot change it.
inline double contour_error(const Motion& run, const std::vector<AxisValues>& points) {
  constexpr std::size_t nearby = 4;
  double worst = 0;
  std::size_t nearest = 1;
  for (const Setpoint& s : run.setpoints) {
    double best = 1e300;
    std::size_t found = nearest;
    const auto look = [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) {
        const double square = square_to_leg(s.position, points[k - 1], points[k]);
        if (square < best) best = square, found = k;
      }
    };
    look(nearest > nearby ? nearest - nearby : 1, std::min(points.size(), nearest + nearby));
    if (best > worst) look(1, points.size());
    worst = std::max(worst, best);
    nearest = found;
  }
  return std::sqrt(worst);
}

}  // namespace trunnion::motion::test
