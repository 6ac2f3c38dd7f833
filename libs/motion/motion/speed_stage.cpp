// SPDX-License-Identifier: Apache-2.0
#include "motion/speed_stage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/cell_builder.hpp"

namespace trunnion::motion {
namespace {

// Rounding that is not worth a reaction: of path coordinates in mm, and of speeds and accelerations as a
// share.
constexpr double short_distance = 1e-9;
// Slower cells are taken into account this many stopping distances ahead, before they have to be.
constexpr double look_ahead_stops = 3;
// Speeds this near are the same; of an acceleration, what a cycle of the jerk of its share changes.
constexpr double cruise_rounding = 1e-9;
// A motion that has come to rest with no more of the path than this left has reached its stop, mm or degrees.
constexpr double arrival_distance = 1e-8;

}  // namespace

void SpeedStage::clear() {
  cells_.clear();
  state_ = {};
  stop_.clear();
  current_ = 0;
  entered_ = finished_ = false;
  wait_ = 0;
  clear_until_ = 0;
  arriving_ = false;
  braking_for_.reset();
  tail_.reset();
  overlap_allowed_ = true;
}

void SpeedStage::extended() {
  arriving_ = false;
  if (braking_for_ && braking_for_->end) braking_for_.reset();
}

bool SpeedStage::at_end() const {
  if (cells_.size() == 0) return true;
  return entered_ && wait_ == 0 && at_standstill() && current_ + 1 == cells_.size() &&
         state_.s == cells_[current_].end;
}

std::optional<Tail> SpeedStage::take_tail() { return std::exchange(tail_, std::nullopt); }

double SpeedStage::speed_of(const LimitCell& cell, const SpeedDemand& demand) const {
  if (!demand.programmed) return cell.speed;
  return cell.rapid ? cell.speed * demand.rapid : std::min(cell.speed, cell.feed * demand.feed);
}

RampLimits SpeedStage::local_ramp(double speed, double reach) const {
  RampLimits ramp = cells_[current_].ramp(speed);
  for (std::uint64_t k = current_ + 1;
       k < cells_.size() && cells_[k].at < state_.s + reach && !cells_[k].stop; ++k) {
    const RampLimits& next = cells_[k].ramp(speed);
    ramp.acceleration = std::min(ramp.acceleration, next.acceleration);
    ramp.jerk = std::min(ramp.jerk, next.jerk);
  }
  return ramp;
}

Transition SpeedStage::demanded_transition(const SpeedDemand& demand, bool hold) const {
  const LimitCell& cell = cells_[current_];
  double target = hold ? 0 : speed_of(cell, demand);
  const double v = std::max(state_.v, settled_speed(state_.v, state_.a, cell.ramp(state_.v).jerk));
  // Where faster levels leave less to acceleration, speed is gained level by level.
  if (!cell.uniform && target > v) target = std::min(target, cell.level_speed(v));
  const double fastest = std::max(v, target);
  const RampLimits ramp = local_ramp(fastest, (fastest + 1) * cycle_ * 1.5);
  return Transition(state_.v, state_.a, target, ramp);
}

// Where a curve is as fast as the axes, its cells permit more braking at lower speeds: first to one of two
// lower speeds, the powers of two that do not change during the braking, and from there to a standstill.
SpeedStage::StagedStop SpeedStage::staged_stop(const PathState& state, double highest, const RampLimits& ramp,
                                               std::uint64_t cell, std::uint64_t last) const {
  StagedStop best{braking_distance(state.v, state.a, 0, ramp), 0};
  double speed = stage_below(highest);
  for (int n = 0; n < 2; ++n, speed /= 2) {
    RampLimits slow = cells_[cell].ramp(speed);
    for (std::uint64_t k = cell + 1; k < last; ++k) {
      const RampLimits& own = cells_[k].ramp(speed);
      slow = {std::min(slow.acceleration, own.acceleration), std::min(slow.jerk, own.jerk)};
    }
    if (!(slow.acceleration > ramp.acceleration)) continue;
    // A cycle is left at the lower speed, since cycles do not end with the braking.
    const double distance = braking_distance(state.v, state.a, speed, ramp) + speed * cycle_ +
                            braking_distance(speed, 0, 0, slow);
    if (distance < best.distance) best = {distance, speed};
  }
  return best;
}

// Searches the cells ahead in legs: a leg leads from the state, or from a slower cell at its speed, to the
// next slower cell. Beyond a slower cell only what is reachable from its speed counts; when something is not,
// the cell has to be entered at a lower speed.
SpeedStage::Obstacle SpeedStage::obstacle_ahead(const PathState& state, std::uint64_t cell,
                                                const SpeedDemand& demand) const {
  PathState from = state;
  double highest = std::max(from.v, settled_speed(from.v, from.a, cells_[cell].ramp(from.v).jerk));
  RampLimits ramp = cells_[cell].ramp(highest);
  double stop = braking_distance(from.v, from.a, 0, ramp);
  Obstacle first;     // the slower cell the first leg ended at
  RampLimits behind;  // the least from there on
  const auto report = [&](double speed, std::uint64_t k, bool end) -> Obstacle {
    if (!first.found) return {true, speed, ramp, k, end};
    const double distance = (end ? cells_[k - 1].end : cells_[k].at) - cells_[first.cell].at;
    double low = std::min(speed, first.speed), high = first.speed;
    for (int n = 0; n < 12; ++n) {
      const double middle = 0.5 * (low + high);
      (middle > speed && braking_distance(middle, 0, speed, behind) > distance ? high : low) = middle;
    }
    Obstacle obstacle = first;
    obstacle.speed = low;
    obstacle.end = end;
    if (braking_distance(state.v, state.a, low, first.ramp) + low * cycle_ <= cells_[first.cell].at - state.s)
      obstacle.found = false;
    return obstacle;
  };
  for (std::uint64_t k = cell + 1;; ++k) {
    const bool end = k >= cells_.size();
    const double distance = (end ? cells_[k - 1].end : cells_[k].at) - from.s + demand.rounding;
    if (distance >= (demand.programmed ? look_ahead_stops : 1) * stop) return {};
    if (end || cells_[k].stop) {
      if (distance >= stop) return {};
      if (first.found) return report(0, k, end);
      const StagedStop staged = staged_stop(state, highest, ramp, cell, k);
      return distance >= std::min(stop, staged.distance) ? Obstacle{}
                                                         : Obstacle{true, staged.speed, ramp, k, end};
    }
    const LimitCell& next = cells_[k];
    if (first.found) {
      const RampLimits& own = next.ramp(first.speed);
      behind = {std::min(behind.acceleration, own.acceleration), std::min(behind.jerk, own.jerk)};
    }
    const double speed = speed_of(next, demand);
    const bool slower = highest > speed * (1 + relative_rounding);
    // A cycle is left between the end of the braking and the slower cell, since cycles do not end at cells.
    const double margin = first.found ? 0 : speed * cycle_;
    if (slower && braking_distance(from.v, from.a, speed, ramp) + margin > distance)
      return report(speed, k, false);
    if (!first.found) {
      const RampLimits& own = next.ramp(highest);
      const double excess = std::abs(state.a) - own.acceleration * (1 + relative_rounding);
      if (excess > 0) {
        const double jerk = state.a > 0 ? -ramp.jerk : ramp.jerk;
        const PathState reduced = integrate({0, state.v, state.a}, jerk, excess / ramp.jerk);
        if (reduced.s + std::min(speed, std::max(0.0, reduced.v)) * cycle_ > distance)
          return {true,
                  state.a > 0 ? settled_speed(state.v, state.a, ramp.jerk) : state.v,
                  {own.acceleration, ramp.jerk},
                  k,
                  false,
                  true};
      }
    }
    if (slower) {
      if (!first.found) {
        first = {true, speed, ramp, k, false};
        behind = next.ramp(speed);
      }
      from = {next.at, speed, 0};
      highest = speed;
      ramp = next.ramp(speed);
      stop = braking_distance(speed, 0, 0, ramp);
      continue;
    }
    const RampLimits& own = next.ramp(highest);
    if (own.acceleration < ramp.acceleration || own.jerk < ramp.jerk) {
      ramp.acceleration = std::min(ramp.acceleration, own.acceleration);
      ramp.jerk = std::min(ramp.jerk, own.jerk);
      stop = braking_distance(from.v, from.a, 0, ramp);
    }
  }
}

SpeedStage::Outcome SpeedStage::evaluate(const PathState& state, const SpeedDemand& demand) const {
  Outcome outcome{state, current_, {}};
  const double fastest = std::max(state_.v, state.v);
  while (state.s > cells_[outcome.cell].end + (outcome.cell + 1 >= cells_.size() ? 1 : 0) * demand.rounding) {
    const std::uint64_t next = outcome.cell + 1;
    const bool end = next >= cells_.size() || cells_[next].stop;
    if (end) {
      if (state.s > cells_[outcome.cell].end + 2 * demand.rounding || state.v > 1e-3)
        outcome.obstacle = {true, 0, local_ramp(fastest, fastest * cycle_), next, next >= cells_.size()};
      return outcome;
    }
    const double speed = speed_of(cells_[next], demand);
    if (fastest > speed * (1 + relative_rounding)) {
      outcome.obstacle = {true, speed, local_ramp(fastest, fastest * cycle_), next, false};
      return outcome;
    }
    outcome.cell = next;
  }
  outcome.obstacle = obstacle_ahead(state, outcome.cell, demand);
  return outcome;
}

// A cycle at constant speed, when nothing within the look-ahead distance requires another one. The result is
// that of the search, but each cell is examined once and not in every cycle.
bool SpeedStage::cruises(const Overrides& now, const SpeedDemand& demand) {
  const double target = speed_of(cells_[current_], demand);
  if (!(target > 0) || std::abs(state_.v - target) > cruise_rounding * target ||
      std::abs(state_.a) > cruise_rounding * cells_[current_].ramps[0].jerk * cycle_)
    return false;
  const bool known = clear_until_ > current_ && clear_speed_ == target && clear_overrides_.feed == now.feed &&
                     clear_overrides_.rapid == now.rapid;
  if (!known) {
    clear_until_ = current_;
    clear_speed_ = target;
    clear_overrides_ = now;
    clear_ramp_ = cells_[current_].ramp(target);
    clear_stop_ = braking_distance(target, 0, 0, clear_ramp_);
  }
  const double step = target * cycle_;
  while (true) {
    if (clear_until_ > current_ &&
        cells_[clear_until_ - 1].end - state_.s > look_ahead_stops * clear_stop_ + step)
      break;
    if (clear_until_ >= cells_.size()) return false;
    const LimitCell& cell = cells_[clear_until_];
    if ((cell.stop && clear_until_ > current_) || speed_of(cell, demand) < target) {
      clear_until_ = 0;
      return false;
    }
    const RampLimits& own = cell.ramp(target);
    if (own.acceleration < clear_ramp_.acceleration || own.jerk < clear_ramp_.jerk) {
      clear_ramp_.acceleration = std::min(clear_ramp_.acceleration, own.acceleration);
      clear_ramp_.jerk = std::min(clear_ramp_.jerk, own.jerk);
      clear_stop_ = braking_distance(target, 0, 0, clear_ramp_);
    }
    ++clear_until_;
  }
  state_ = {state_.s + step, target, 0};
  while (state_.s > cells_[current_].end) ++current_;
  stop_.clear();
  stop_.add(Transition(target, 0, 0, clear_ramp_));
  return true;
}

// Follows the transition for as long a part of the cycle as the obstacle it leads to allows, and brakes for
// that obstacle for the rest. When braking at once is not enough for another obstacle, that braking is
// followed.
bool SpeedStage::follow(const Transition& demanded, const SpeedDemand& demand, int depth) {
  PhaseList action;
  const Outcome whole = evaluate(demanded.after(state_, cycle_), demand);
  Obstacle obstacle = whole.obstacle;
  double low = cycle_ / 2;
  if (!obstacle.found) {
    action.add(demanded, cycle_);
    if (accept(action)) return true;
    // No stop was found behind it: take the part that leaves one, and brake for the rest.
    obstacle = {true, 0, local_ramp(state_.v, (state_.v + 1) * cycle_ * 1.5), current_, true};
  } else {
    const auto part = [&](double time, const SpeedDemand& how) {
      const PathState at = demanded.after(state_, time);
      return evaluate(Transition(at.v, at.a, obstacle.speed, obstacle.ramp).after(at, cycle_ - time), how);
    };
    const Outcome at_once = part(0, demand);
    if (at_once.obstacle.found) {
      if (depth >= 6) return false;
      // The ramp of an obstacle is the least on the path to it; stronger braking is possible as long as the
      // cells directly ahead permit it.
      const bool same = at_once.obstacle.cell == obstacle.cell && at_once.obstacle.speed == obstacle.speed;
      const RampLimits ramp =
          same ? local_ramp(state_.v, (state_.v + 1) * cycle_ * 1.5) : at_once.obstacle.ramp;
      return follow(Transition(state_.v, state_.a, same ? 0 : at_once.obstacle.speed, ramp), demand,
                    depth + 1);
    }
    // The rounding allowed is kept for the cycles that follow.
    SpeedDemand strict = demand;
    strict.rounding = 0;
    low = 0;
    double high = cycle_;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (part(middle, strict).obstacle.found ? high : low) = middle;
    }
  }
  if (take_part(demanded, obstacle, low, whole.obstacle.found)) return true;
  // The ramp to an obstacle is that of the path to it, which begins where the cycle ends; the cells before
  // that may permit less.
  const RampLimits near = local_ramp(std::max(state_.v, whole.state.v), whole.state.s - state_.s);
  const RampLimits least{std::min(obstacle.ramp.acceleration, near.acceleration),
                         std::min(obstacle.ramp.jerk, near.jerk)};
  if (least.acceleration == obstacle.ramp.acceleration && least.jerk == obstacle.ramp.jerk) return false;
  obstacle.ramp = least;
  return take_part(demanded, obstacle, low, false);
}

// The demanded transition for `most` seconds of the cycle, or less when that is not accepted, and braking for
// the obstacle.
bool SpeedStage::take_part(const Transition& demanded, const Obstacle& obstacle, double most, bool keep) {
  PhaseList action;
  const int attempts = at_standstill() ? 30 : 5;
  for (int k = 0; k <= attempts; ++k) {
    const double time = k < attempts ? std::ldexp(most, -k) : 0;
    action.clear();
    action.add(demanded, time);
    const PathState at = demanded.after(state_, time);
    action.add(Transition(at.v, at.a, obstacle.speed, obstacle.ramp), cycle_ - time);
    if (!accept(action)) continue;
    braking_for_.reset();
    if (keep && !obstacle.momentary && k == 0) braking_for_ = obstacle;
    return true;
  }
  return false;
}

// Programmed speeds and slower cells far ahead are demands, not limits: when they become known too late to be
// met, they are approached within the limits.
void SpeedStage::move(const Transition& demanded, const SpeedDemand& demand) {
  if (follow(demanded, demand, 0)) return;
  SpeedDemand limits_only = demand;
  limits_only.programmed = false;
  const Outcome ahead = evaluate(demanded.after(state_, cycle_), demand);
  const RampLimits ramp = local_ramp(state_.v, (state_.v + 1) * cycle_ * 1.5);
  braking_for_.reset();
  const bool found = ahead.obstacle.found &&
                     follow(Transition(state_.v, state_.a, ahead.obstacle.speed, ramp), limits_only, 0);
  braking_for_.reset();
  if (found) return;
  ++stopping_;
  follow_stop();
}

// At a stop, or the end of the path, once the motion has settled there.
void SpeedStage::arrive() {
  if (!at_standstill()) return;
  const bool last = current_ + 1 >= cells_.size();
  if (last ? !finished_ : !cells_[current_ + 1].stop) return;
  if (cells_[current_].end - state_.s > arrival_distance) return;
  state_.s = cells_[current_].end;
  braking_for_.reset();
}

// At a stop or the end of the known path.
bool SpeedStage::at_stop() const {
  return (current_ + 1 >= cells_.size() || cells_[current_ + 1].stop) &&
         cells_[current_].end - state_.s <= arrival_distance;
}

void SpeedStage::begin_tail() {
  if (!overlap_allowed_ || !braking_for_ || braking_for_->speed != 0 || state_.a >= 0) return;
  const std::uint64_t next = braking_for_->cell;
  if (next != current_ + 1 || next >= cells_.size() || !(cells_[next].overlap > 0)) return;
  const double jerk = braking_for_->ramp.jerk, time = -state_.a / jerk;
  if (time > cells_[next].overlap) return;
  // Only the last phase of the braking, which nothing can change any more.
  if (std::abs(state_.v - jerk * time * time / 2) > 1e-6 * (state_.v + 1e-3)) return;
  if (std::abs(cells_[current_].end - state_.s - jerk * time * time * time / 6) > 1e-8) return;
  tail_ = Tail{cells_[current_].end, time, jerk, current_};
  state_ = {cells_[next].at, 0, 0};
  stop_.clear();
  current_ = next;
  braking_for_.reset();
}

void SpeedStage::step(const Overrides& overrides) {
  tail_.reset();
  if (cells_.size() == 0) return;
  Overrides now{std::clamp(overrides.feed, 0.0, highest_override), std::clamp(overrides.rapid, 0.0, 1.0),
                overrides.hold};
  if (now.feed != last_.feed || now.rapid != last_.rapid || now.hold != last_.hold) braking_for_.reset();
  last_ = now;
  if (!entered_) {
    entered_ = true;
    state_ = {cells_[0].at, 0, 0};
    wait_ = cells_[0].wait_cycles;
  } else if (at_standstill() && state_.s == cells_[current_].end && current_ + 1 < cells_.size() &&
             cells_[current_ + 1].stop && wait_ == 0) {
    ++current_;
    wait_ = cells_[current_].wait_cycles;
  }
  if (wait_ > 0) {
    if (!now.hold) --wait_;
    return;
  }
  const LimitCell& cell = cells_[current_];
  const bool hold = now.hold || (cell.rapid ? now.rapid <= 0 : now.feed <= 0);
  if (hold && at_standstill()) return;
  SpeedDemand demand{!hold, now.feed, now.rapid, short_distance};
  if (now.feed <= 0) demand.feed = 1e-3;  // a feed move after a rapid that continues is approached slowly
  if (now.rapid <= 0) demand.rapid = 1e-3;
  if (!hold && !braking_for_ && cruises(now, demand)) return;
  const PathState before = state_;
  const std::uint64_t cell_before = current_;
  advance(demand, hold);
  if (!hold && before.v == 0 && before.a == 0 && at_standstill() && !tail_ && !at_stop()) {
    const PathState optimistic = std::exchange(state_, before);
    const std::uint64_t optimistic_cell = std::exchange(current_, cell_before);
    stop_.clear();
    if (!start_gently(demand)) {
      state_ = optimistic;
      current_ = optimistic_cell;
      stop_.clear();
    }
  }
}

void SpeedStage::advance(const SpeedDemand& demand, bool hold) {
  if (needs_speed_profile(demand) && integrate_speed_profile(demand, hold)) {
    braking_for_.reset();
    arrive();
    return;
  }
  arriving_ = false;
  if (braking_for_ && !hold) {
    const Transition transition(state_.v, state_.a, braking_for_->speed, braking_for_->ramp);
    const bool over = transition.duration() <= cycle_;
    move(transition, demand);
    if (over) braking_for_.reset();
  } else {
    move(demanded_transition(demand, hold), demand);
  }
  begin_tail();
  arrive();
}

}  // namespace trunnion::motion
