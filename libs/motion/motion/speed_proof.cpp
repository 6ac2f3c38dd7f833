// SPDX-License-Identifier: Apache-2.0
// The speed stage: the proof of a cycle before it is accepted, and the gentle start from a standstill.
#include <cmath>

#include "motion/speed_stage.hpp"

namespace trunnion::motion {
namespace {

constexpr int most_halvings = 40;
// Slower motion brakes at once, mm/s or degrees/s.
constexpr double least_staged = 0.5;

}  // namespace

void SpeedStage::place(const PathState& state) {
  state_ = state;
  while (current_ + 1 < cells_.size() && !cells_[current_ + 1].stop && state_.s > cells_[current_].end)
    ++current_;
  stop_.clear();
  clear_until_ = 0;
  arriving_ = false;
  braking_for_.reset();
  tail_.reset();
}

bool SpeedStage::stops_from(const PathState& state) const {
  std::uint64_t cell = current_;
  while (cell + 1 < cells_.size() && !cells_[cell + 1].stop && state.s > cells_[cell].end) ++cell;
  PhaseList stop;
  return state.s <= cells_[cell].end && find_stop(state, cell, stop);
}

bool SpeedStage::take_over() {
  PhaseList stop;
  Braked why = Braked::yes;
  if (!find_stop(state_, current_, stop) && !find_curved_stop(state_, current_, stop, why)) return false;
  stop_ = stop;
  return true;
}

bool SpeedStage::find_stop(const PathState& state, std::uint64_t cell, PhaseList& stop) const {
  return find_stop(state, cell, 1, stop) || find_stop(state, cell, 0.5, stop);
}

// A stop from `state`: braking with what all cells on the path permit; where a slower cell would be entered
// too fast, first to its speed, and where the path is too short, first to a share `stage` of the next power
// of two, where cells permit more; from there to a standstill.
bool SpeedStage::find_stop(const PathState& state, std::uint64_t cell, double stage, PhaseList& stop) const {
  stop.clear();
  PathState at = state;
  std::uint64_t here = cell;
  for (int leg = 0; leg < 8; ++leg) {
    if (at.v <= 0 && at.a == 0) return true;
    // The least ramp limits over the distance that braking with them takes.
    RampLimits ramp = cells_[here].ramp(at.v);
    Obstacle slower;
    double distance_needed = braking_distance(at.v, at.a, 0, ramp);
    for (std::uint64_t k = here + 1; k < cells_.size() && !cells_[k].stop; ++k) {
      const double distance = cells_[k].at - at.s;
      if (distance > distance_needed) break;
      if (!slower.found && at.v > cells_[k].speed * (1 + relative_rounding))
        slower = {true, cells_[k].speed, ramp, k, false};
      const RampLimits& own = cells_[k].ramp(at.v);
      if (own.acceleration < ramp.acceleration || own.jerk < ramp.jerk) {
        ramp.acceleration = std::min(ramp.acceleration, own.acceleration);
        ramp.jerk = std::min(ramp.jerk, own.jerk);
        distance_needed = braking_distance(at.v, at.a, 0, ramp);
      }
    }
    PhaseList whole;
    whole.add(Transition(at.v, at.a, 0, ramp));
    std::uint64_t end = here;
    if (keeps_limits(whole, at, cells_, end)) {
      for (std::size_t k = 0; k < whole.size(); ++k) {
        if (!stop.add(whole[k])) return false;
      }
      return true;
    }
    if (!slower.found) {
      if (!(at.v > least_staged)) return false;
      slower = {true, stage * stage_below(at.v), ramp};
      stage = 1;
    }
    PhaseList part;
    part.add(Transition(at.v, at.a, slower.speed, slower.ramp));
    end = here;
    if (part.size() == 0 || !keeps_limits(part, at, cells_, end)) return false;
    for (std::size_t k = 0; k < part.size(); ++k) {
      if (!stop.add(part[k])) return false;
    }
    at = part.after(at);
    at.v = slower.speed;
    at.a = 0;
    here = end;
  }
  return false;
}

// Accepts a cycle when it keeps the limits and leaves a proved stop.
bool SpeedStage::accept(const PhaseList& action) {
  std::uint64_t cell = current_;
  if (!keeps_limits(action, state_, cells_, cell)) return false;
  PathState next = action.after(state_);
  if (std::abs(next.v) < 1e-9 && std::abs(next.a) < 1e-6) next.v = next.a = 0;
  PhaseList stop;
  if (!find_stop(next, cell, stop)) return false;
  state_ = next;
  current_ = cell;
  stop_ = stop;
  return true;
}

// Starts from a standstill with an acceleration and jerk that every cell up to the next standstill permits.
// The optimistic candidates of advance() may come to a standstill repeatedly in front of a cell whose axes
// permit almost no acceleration.
bool SpeedStage::start_gently(const SpeedDemand& demand) {
  double speed = speed_of(cells_[current_], demand);
  for (int n = 0; n < most_halvings; ++n, speed /= 2) {
    const RampLimits own = cells_[current_].ramp(speed);
    const double reach = 2 * speed * (speed / own.acceleration + own.acceleration / own.jerk + cycle_);
    const RampLimits ramp = local_ramp(speed, reach);
    PhaseList action;
    action.add(Transition(0, 0, speed, ramp), cycle_);
    if (!accept(action)) continue;
    braking_for_.reset();
    return !at_standstill();
  }
  return false;
}

}  // namespace trunnion::motion
