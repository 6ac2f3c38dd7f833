// SPDX-License-Identifier: Apache-2.0
// The speed stage where the path is curved and the speed is near the limits of the axes. Closed forms over
// whole cells would give too much away there. Instead the speed profile is integrated step by step along the
// limits of each axis (pace.hpp): each cycle takes as much of the demanded change of speed as leaves a proved
// stop.
#include <algorithm>
#include <cmath>

#include "motion/pace.hpp"
#include "motion/speed_stage.hpp"

namespace trunnion::motion {
namespace {

// Below this share of the speed of a cell its ramps give almost nothing away.
constexpr double easy_share = 0.4;
// A stop has about this many steps, and none is shorter than a cycle.
constexpr double stop_steps = 60;
// How far beside a place of the path a motion may end and count as ending there, mm or degrees.
constexpr double place_tolerance = 1e-9;
// When braking fails, the acceleration is reduced earlier, down to this share of the jerk.
constexpr double least_ramp_down = 0.75;

}  // namespace

double SpeedStage::top_of(const LimitCell& cell, const SpeedDemand& demand) const {
  if (!demand.programmed) return cell.top;
  return cell.rapid ? cell.top * demand.rapid : std::min(cell.top, cell.feed * demand.feed);
}

double SpeedStage::stop_step(const PathState& state) const {
  const RampLimits& ramp = cells_[current_].ramps[LimitCell::levels - 1];
  const double time = state.v / ramp.acceleration + 2 * ramp.acceleration / ramp.jerk;
  return std::max(cycle_, time / stop_steps);
}

// True when a curved cell within the braking distance has, or is to have, a speed near the limits of its
// axes.
bool SpeedStage::needs_speed_profile(const SpeedDemand& demand) const {
  const double demanded = demand.programmed ? top_of(cells_[current_], demand) : 0;
  const double fastest =
      std::max({state_.v, settled_speed(state_.v, state_.a, cells_[current_].ramps[0].jerk),
                std::min(demanded, state_.v + 0.05 * demanded)});
  const double reach =
      state_.s + braking_distance(fastest, 0, 0, cells_[current_].ramps[LimitCell::levels - 1]);
  for (std::uint64_t k = current_; k < cells_.size() && (k == current_ || !cells_[k].stop); ++k) {
    const LimitCell& cell = cells_[k];
    if (k > current_ && cell.at > reach) break;
    if (cell.uniform || cell.axis_count == 0) continue;
    if (std::max(fastest, top_of(cell, demand)) > easy_share * cell.speed) return true;
  }
  return false;
}

// Braking to a standstill: first to the speed of a cell that does not permit more, and with less acceleration
// and jerk where a cell on the path permits less.
bool SpeedStage::find_curved_stop(const PathState& state, std::uint64_t cell, PhaseList& stop,
                                  Braked& why) const {
  stop.clear();
  PathState from = state;
  std::uint64_t here = cell;
  const double step = stop_step(state);
  Pacing pacing;
  for (int leg = 0; leg < 8; ++leg) {
    PhaseList part;
    const BrakeEnd whole = brake(from, cells_, here, 0, step, pacing, part);
    why = whole.result;
    if (whole.result == Braked::yes) return stop.add(part);
    if (whole.result == Braked::beyond) return false;
    const LimitCell& rough = cells_[whole.cell];
    const double v = whole.state.v;
    if (v > rough.top * (1 + relative_rounding)) {
      part.clear();
      const BrakeEnd slower = brake(from, cells_, here, rough.top, step, pacing, part);
      if (slower.result != Braked::yes || slower.cell > whole.cell || !stop.add(part)) return false;
      from = slower.state;
      here = slower.cell;
      continue;
    }
    if (pacing.ramp_down > least_ramp_down) {
      pacing.ramp_down *= 0.88;
      continue;
    }
    const RampLimits& gentle = rough.ramp(v);
    if (gentle.acceleration >= pacing.acceleration && gentle.jerk >= pacing.jerk) return false;
    pacing.acceleration = std::min(pacing.acceleration, gentle.acceleration);
    pacing.jerk = std::min(pacing.jerk, gentle.jerk);
  }
  return false;
}

// The cell ahead whose speed is most critical for `state`, by its closed form.
std::optional<std::uint64_t> SpeedStage::critical_cell(const PathState& state, std::uint64_t cell,
                                                       const SpeedDemand& demand) const {
  std::optional<std::uint64_t> found;
  double worst = 0.5;
  const double highest = std::max(state.v, settled_speed(state.v, state.a, cells_[cell].ramps[0].jerk));
  RampLimits ramp = cells_[cell].ramp(highest);
  ramp.acceleration =
      std::max(ramp.acceleration, 1e-3 * cells_[cell].ramps[LimitCell::levels - 1].acceleration);
  const double stop = braking_distance(highest, 0, 0, ramp);
  for (std::uint64_t k = cell + 1; k < cells_.size() && !cells_[k].stop; ++k) {
    const double distance = cells_[k].at - state.s;
    if (distance > 2 * stop) break;
    const double speed = top_of(cells_[k], demand);
    if (highest <= speed * (1 + relative_rounding)) continue;
    const double needed = braking_distance(highest, 0, speed, ramp) / std::max(distance, 1e-9);
    if (needed > worst) worst = needed, found = k;
  }
  return found;
}

// Accepts the action when it keeps all limits, a stop exists behind it, and slower cells ahead can be entered
// at their speed without acceleration.
bool SpeedStage::accept_curved(const PhaseList& action, const SpeedDemand& demand, Braked& why) {
  PathState next = state_;
  std::uint64_t cell = current_;
  why = Braked::blocked;
  for (std::size_t k = 0; k < action.size(); ++k) {
    const PathState to = integrate(next, action[k].jerk, action[k].time);
    if (!keeps_axes(next, to, action[k].jerk, cells_, cell)) {
      if (cell + 1 >= cells_.size() || cells_[cell + 1].stop) why = Braked::beyond;
      return false;
    }
    next = to;
  }
  if (std::abs(next.v) < 1e-9 && std::abs(next.a) < 1e-6) next.v = next.a = 0;
  PhaseList stop;
  if (!find_curved_stop(next, cell, stop, why)) return false;
  if (demand.programmed) {
    if (const auto slower = critical_cell(next, cell, demand)) {
      PhaseList leg;
      const BrakeEnd end =
          brake(next, cells_, cell, top_of(cells_[*slower], demand), stop_step(next), {}, leg);
      why = Braked::blocked;
      if (end.result != Braked::yes || end.state.s > cells_[*slower].at + place_tolerance) return false;
    }
  }
  state_ = next;
  current_ = cell;
  stop_ = stop;
  return true;
}

void SpeedStage::fill_cycle(PathState state, double time, double target, PhaseList& action) const {
  std::uint64_t cell = current_;
  for (int n = 0; n < 6 && time > 1e-12; ++n) {
    while (cell + 1 < cells_.size() && !cells_[cell + 1].stop && state.s > cells_[cell].end) ++cell;
    PacePhase phase = next_phase(state, cells_, cell, target, time, {}, false);
    if (!(phase.time > 0)) phase = {time, 0};
    action.add(JerkPhase{phase.time, phase.jerk});
    state = integrate(state, phase.jerk, phase.time);
    time -= phase.time;
  }
  if (time > 0) action.add(JerkPhase{time, 0});
}

void SpeedStage::follow_stop() {
  state_ = stop_.advance(state_, cycle_);
  if (stop_.size() == 0) state_.v = state_.a = 0;
  while (current_ + 1 < cells_.size() && !cells_[current_ + 1].stop && state_.s > cells_[current_].end)
    ++current_;
}

bool SpeedStage::integrate_speed_profile(const SpeedDemand& demand, bool hold) {
  const LimitCell& here = cells_[current_];
  if (arriving_ && stop_.size() > 0) {
    follow_stop();
    return true;
  }
  arriving_ = false;
  const double target = hold ? 0 : top_of(here, demand);
  SpeedDemand checked = demand;
  checked.programmed = !hold;
  Braked why = Braked::yes;
  PhaseList demanded, action;
  fill_cycle(state_, cycle_, target, demanded);
  if (state_.v > target * (1 + relative_rounding)) checked.programmed = false;
  if (accept_curved(demanded, checked, why)) return true;
  double low = 0, high = cycle_;
  bool taken = false;
  const PathState before = state_;
  const std::uint64_t cell_before = current_;
  PathState best;
  std::uint64_t best_cell = 0;
  PhaseList best_stop;
  int tries = why == Braked::beyond ? 34 : at_standstill() ? 30 : 6;
  for (int k = 0; k <= tries; ++k) {
    const double time = k == 0 ? 0 : 0.5 * (low + high);
    action.clear();
    PathState at = before;
    double left = time;
    for (std::size_t n = 0; n < demanded.size() && left > 0; ++n) {
      const double part = std::min(left, demanded[n].time);
      action.add(JerkPhase{part, demanded[n].jerk});
      at = integrate(at, demanded[n].jerk, part);
      left -= part;
    }
    fill_cycle(at, cycle_ - time, 0, action);
    Braked reason = Braked::yes;
    if (accept_curved(action, checked, reason)) {
      low = time;
      taken = true;
      best = state_, best_cell = current_, best_stop = stop_;
      state_ = before, current_ = cell_before;
      const double rest = best_stop.after(best).s;
      std::uint64_t last = best_cell;
      while (last + 1 < cells_.size() && !cells_[last + 1].stop && rest > cells_[last].end) ++last;
      const bool ends = last + 1 < cells_.size() ? cells_[last + 1].stop : finished_;
      if (ends && cells_[last].end - rest < place_tolerance) {
        arriving_ = true;
        break;
      }
    } else {
      high = time;
      if (reason == Braked::beyond && tries < 34) tries = 34;
      if (k == 0) break;
    }
  }
  if (taken) {
    state_ = best, current_ = best_cell, stop_ = best_stop;
    return true;
  }
  // A demanded speed ahead cannot be met any more: brake within the limits.
  if (checked.programmed) {
    checked.programmed = false;
    action.clear();
    fill_cycle(state_, cycle_, 0, action);
    if (accept_curved(action, checked, why)) return true;
  }
  return false;
}

}  // namespace trunnion::motion
