// SPDX-License-Identifier: Apache-2.0
#include "motion/pace.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

// Once the acceleration is being reduced, that continues while it needs at least this share of the jerk.
constexpr double kept_share = 0.5;
constexpr double near_share = 0.985;
constexpr double tiny = 1e-9;
constexpr int ramp_down_steps = 6;
// The reduction of the acceleration is not followed to where less than this share of the jerk is left.
constexpr double least_jerk = 0.1;
// Where much more jerk than this would be needed, the acceleration has to be reduced at once.
constexpr double near_ramp_down = 0.3;

Range capped(Range range, double cap) { return {std::max(range.low, -cap), std::min(range.high, cap)}; }

// The constant jerk that would reduce the acceleration to zero with the same change of speed as the jerk that
// the axes permit from place to place. `sign` is that of the acceleration, `down` the jerk here.
double mean_ramp_down(const PathState& state, const CellRing& cells, std::uint64_t cell, double sign,
                      double down, const Pacing& pacing) {
  PathState at = state;
  double jerk = down;
  for (int n = ramp_down_steps; n > 0; --n) {
    const double left = at.a * sign;
    at = integrate(at, -sign * jerk, left / (jerk * n));
    if (at.v <= 0 || n == 1) break;
    while (cell + 1 < cells.size() && !cells[cell + 1].stop && at.s > cells[cell].end) ++cell;
    const Range range = capped(jerk_range(cells[cell], part_of(cells[cell], at.s), at.v, at.a), pacing.jerk);
    jerk = sign > 0 ? -range.low : range.high;
    if (!(jerk > least_jerk * down)) return down;
  }
  const double change = std::abs(at.v - state.v), gone = state.a * state.a - at.a * at.a;
  return change > 0 ? gone / (2 * change) : down;
}

}  // namespace

PacePhase next_phase(const PathState& state, const CellRing& cells, std::uint64_t cell, double target,
                     double time, const Pacing& pacing, bool ramping_down) {
  const LimitCell& here = cells[cell];
  const double part = part_of(here, state.s);
  Range jerk = capped(jerk_range(here, part, state.v, state.a), pacing.jerk);
  if (jerk.low > jerk.high) return {};
  const double change = target - state.v;
  const double sign = change < 0 || (change == 0 && state.a > 0) ? -1 : 1;
  const double a = state.a * sign, change_left = std::abs(change);
  if (change_left <= tiny * (target + 1e-3) && std::abs(a) <= tiny) return {time, 0};
  // Seen in the direction of the change: `up` builds the acceleration up, `down` reduces it.
  const auto turned = [sign](Range r) { return sign > 0 ? r : Range{-r.high, -r.low}; };
  Range j = turned(jerk);
  const double down = -j.low;
  double mean = down;
  const double share = here.uniform ? std::min(pacing.ramp_down, 0.99) : pacing.ramp_down;
  if (a > 0) {
    const double needed = change_left > 0 ? a * a / (2 * change_left) : 1e300;
    if (down > 0 && !here.uniform && needed > near_ramp_down * down)
      mean = std::max(down, mean_ramp_down(state, cells, cell, sign, down, pacing));
    if (needed >= (ramping_down ? kept_share * down : near_share * share * mean)) {
      if (!(down > 0)) return {};
      const double used = std::min(needed, down);
      return {std::min(time, a / used), -sign * used, true};
    }
  }
  const PathState ahead = integrate(state, 0, time);
  std::uint64_t next = cell;
  while (next + 1 < cells.size() && !cells[next + 1].stop && ahead.s > cells[next].end) ++next;
  const Range now = turned(capped(acceleration_range(here, part, state.v), pacing.acceleration));
  // Where the curvature relieves an axis, it does so less at the lower speed at the end of the step.
  const double v_then = std::max(0.0, state.v + state.a * time);
  const Range then = turned(
      capped(acceleration_range(cells[next], part_of(cells[next], ahead.s), v_then), pacing.acceleration));
  const double most = std::max(0.0, std::min(now.high, then.high));
  double used = std::clamp((most - a) / time, j.low, j.high);
  // What is allowed at the end of the step.
  PathState end = integrate(state, sign * used, time);
  const Range j_end = turned(
      capped(jerk_range(cells[next], part_of(cells[next], end.s), std::max(0.0, end.v), end.a), pacing.jerk));
  if (j_end.low <= j_end.high && j_end.low <= j.high && j_end.high >= j.low)
    used = std::clamp(used, std::max(j.low, j_end.low), std::min(j.high, j_end.high));
  // Not beyond the moment at which the acceleration has to be reduced.
  const auto late = [&](double t) {
    const double a_then = a + used * t, left = change_left - t * (a + used * t / 2);
    return a_then > 0 && a_then * a_then >= 2 * share * mean * left;
  };
  if (down > 0 && late(time)) {
    double low = 0, high = time;
    for (int k = 0; k < 24; ++k) {
      const double middle = 0.5 * (low + high);
      (late(middle) ? high : low) = middle;
    }
    time = high;
  }
  return {time, sign * used};
}

BrakeEnd brake(const PathState& state, const CellRing& cells, std::uint64_t cell, double target, double step,
               const Pacing& pacing, PhaseList& phases) {
  BrakeEnd end{Braked::yes, state, cell};
  bool ramping_down = false;
  for (std::size_t n = 0; n < PhaseList::capacity; ++n) {
    if (end.state.v <= target + tiny && std::abs(end.state.a) <= tiny) return end;
    PacePhase phase;

    if (end.state.v <= target + tiny &&
        end.state.a < 0) {  // below the target already: reduce the acceleration only
      const LimitCell& here = cells[end.cell];
      const double high =
          std::min(pacing.jerk, jerk_range(here, part_of(here, end.state.s), end.state.v, end.state.a).high);
      if (!(high > 0)) return {Braked::blocked, end.state, end.cell};
      phase = {std::min(step, -end.state.a / high), high};
    } else {
      phase = next_phase(end.state, cells, end.cell, target, step, pacing, ramping_down);
      ramping_down = phase.ramping_down;
    }
    if (!(phase.time > 0)) return {Braked::blocked, end.state, end.cell};
    PathState next = integrate(end.state, phase.jerk, phase.time);
    if (std::abs(next.a) <= 1e-7 && std::abs(next.v - target) <= 1e-7) next.a = 0, next.v = target;
    std::uint64_t at = end.cell;
    if (!keeps_axes(end.state, next, phase.jerk, cells, at)) {
      const bool over = (at + 1 >= cells.size() || cells[at + 1].stop) && next.s > cells[at].end;
      return {over ? Braked::beyond : Braked::blocked, over ? next : end.state, at};
    }
    if (!phases.add(JerkPhase{phase.time, phase.jerk})) return {Braked::blocked, end.state, end.cell};
    end.state = next;
    end.cell = at;
  }
  return {Braked::blocked, end.state, end.cell};
}

}  // namespace trunnion::motion
