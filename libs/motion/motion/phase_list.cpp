// SPDX-License-Identifier: Apache-2.0
#include "motion/phase_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trunnion::motion {
namespace {

// A phase is checked in slices of this length, s, or a sixth of it.
constexpr double slice_time = 0.002;

}  // namespace

bool PhaseList::add(const JerkPhase& phase) {
  if (!(phase.time > 0)) return true;
  if (count_ > 0 && phases_[count_ - 1].jerk == phase.jerk) {
    phases_[count_ - 1].time += phase.time;
    return true;
  }
  if (count_ == capacity) return false;
  phases_[count_++] = phase;
  return true;
}

bool PhaseList::add(const Transition& transition, double time) {
  for (const JerkPhase& phase : transition.phases()) {
    const double part = std::min(phase.time, time);
    if (!add(JerkPhase{part, phase.jerk})) return false;
    time -= part;
  }
  return !std::isfinite(time) || add(JerkPhase{time, 0});
}

bool PhaseList::add(const Transition& transition) {
  return add(transition, std::numeric_limits<double>::infinity());
}

bool PhaseList::add(const PhaseList& other) {
  for (std::size_t k = 0; k < other.count_; ++k) {
    if (!add(other.phases_[k])) return false;
  }
  return true;
}

PathState PhaseList::after(PathState state) const {
  for (std::size_t k = 0; k < count_; ++k) state = integrate(state, phases_[k].jerk, phases_[k].time);
  return state;
}

PathState PhaseList::advance(PathState state, double time) {
  std::size_t done = 0;
  while (done < count_ && phases_[done].time <= time) {
    state = integrate(state, phases_[done].jerk, phases_[done].time);
    time -= phases_[done].time;
    ++done;
  }
  if (done < count_ && time > 0) {
    state = integrate(state, phases_[done].jerk, time);
    phases_[done].time -= time;
  }
  std::move(phases_.begin() + static_cast<std::ptrdiff_t>(done),
            phases_.begin() + static_cast<std::ptrdiff_t>(count_), phases_.begin());
  count_ -= done;
  return state;
}

bool keeps_limits(const PhaseList& phases, PathState state, const CellRing& cells, std::uint64_t& cell) {
  for (std::size_t k = 0; k < phases.size(); ++k) {
    const double jerk = phases[k].jerk;
    const int slices = static_cast<int>(std::clamp(std::ceil(phases[k].time / slice_time), 1.0, 8.0));
    const double time = phases[k].time / slices;
    for (int n = 0; n < slices; ++n) {
      const PathState next = integrate(state, jerk, time);
      double fastest = std::max(state.v, next.v), slowest = std::min(state.v, next.v);
      if (state.a * next.a < 0) {
        const double turning = state.v - state.a * state.a / (2 * jerk);
        fastest = std::max(fastest, turning);
        slowest = std::min(slowest, turning);
      }
      if (slowest < -1e-6) return false;
      const double strongest = std::max(std::abs(state.a), std::abs(next.a));
      while (true) {
        const LimitCell& here = cells[cell];
        const RampLimits& ramp = here.ramp(fastest);
        if (fastest > here.speed * (1 + relative_rounding) + 1e-9) return false;
        if (strongest > ramp.acceleration * (1 + relative_rounding) + 1e-6) return false;
        if (std::abs(jerk) > ramp.jerk * (1 + relative_rounding)) return false;
        if (next.s <= here.end) break;
        if (cell + 1 >= cells.size() || cells[cell + 1].stop) {
          if (next.s > here.end + rounding_distance) return false;
          break;
        }
        ++cell;
      }
      state = next;
    }
  }
  return true;
}

}  // namespace trunnion::motion
