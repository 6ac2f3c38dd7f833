// SPDX-License-Identifier: Apache-2.0
#include "motion/plan_braking.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

// Places of the plan at which limits are checked lie this far apart, s.
constexpr double sample_time = 2.5e-4;
// Samples are set up to this time ahead, s of the plan.
constexpr double horizon = 0.06;
// Shares of the strongest braking of a cycle that are tried.
constexpr std::array<double, 6> shares{1, 0.8, 0.6, 0.4, 0.2, 0.05};
constexpr double offset_rounding = 1e-9;
// Path coordinates this near are the same.
constexpr double same_place = 1e-9;
// r'' where no axis bounds it, 1/s^2.
constexpr double most_bend = 1e6;

// Narrows the range of x so that |offset + factor x| <= limit.
void narrow_offset(Range& range, double offset, double factor, double limit) {
  if (std::abs(factor) < 1e-12) {
    if (std::abs(offset) > limit + offset_rounding) range = {1, -1};
    return;
  }
  const double middle = -offset / factor, reach = limit / std::abs(factor);
  range.low = std::max(range.low, middle - reach);
  range.high = std::min(range.high, middle + reach);
}

}  // namespace

PlanBraking::PlanBraking() : samples_(ring) {
  return_.reserve(most_steps);
  tried_.reserve(most_steps);
}

void PlanBraking::start(const SpeedPlan& plan, const SpeedStage& stage) {
  active_ = true;
  now_ = {};
  on_plan_ = stage.state();
  fill_ = {0, on_plan_, plan.current(), stage.current_cell()};
  first_ = filled_ = 0;
  return_.clear();
  returned_ = 0;
}

PlanBraking::Rate PlanBraking::after(const Rate& at, double bend, double time) {
  return {at.time + time * (at.rate + time * (at.slope / 2 + time * bend / 6)),
          at.rate + time * (at.slope + time * bend / 2), at.slope + time * bend};
}

void PlanBraking::sample(const SpeedPiece& piece, const LimitCell& cell) {
  const auto [s, v, a] = fill_.state;
  const double jerk = piece.b2 * v, length = cell.end - cell.at;
  const double part = length > 0 ? std::clamp((s - cell.at) / length, 0.0, 1.0) : 0.0;
  Sample& sample = samples_[filled_ % ring];
  sample.time = fill_.time;
  sample.count = cell.known_axes;
  for (int i = 0; i < cell.known_axes; ++i) {
    const AxisOnCell& axis = cell.axes[static_cast<std::size_t>(i)];
    const AxisRates q = exact_rates(axis, part, length);
    const double most_a = 1 / static_cast<double>(axis.acceleration),
                 most_j = 1 / static_cast<double>(axis.jerk);
    const double speed = q.first * v, acceleration = q.second * v * v + q.first * a;
    sample.axes[static_cast<std::size_t>(i)] = {
        speed * most_a, acceleration * most_a, speed * most_j, acceleration * most_j,
        (q.third * v * v * v + 3 * q.second * v * a + q.first * jerk) * most_j};
  }
  ++filled_;
}

// Up to the last piece, in which the stage stops. Jerk jumps where pieces and cells end, so samples are
// there, too, with what lies behind.
void PlanBraking::fill(const SpeedPlan& plan, const CellRing& cells, double until) {
  while (fill_.piece + 1 < plan.size() && fill_.time <= until && filled_ - first_ < ring) {
    auto& [time, state, piece, cell] = fill_;
    sample(plan[piece], cells[cell]);
    std::size_t reached = piece;
    const PathState next = plan.advance(state, sample_time, reached);
    const double piece_end = plan[piece].end(), cell_end = cells[cell].end;
    const double border = std::min(piece_end, cell_end);
    if (border > next.s) {
      state = next;
      time += sample_time;
      continue;
    }
    const double v = std::sqrt(std::max(0.0, plan[piece].square(border)));
    time += std::max(0.0, 2 * (border - state.s) / std::max(1e-9, state.v + v));
    state = {border, v, plan[piece].slope(border) / 2};
    if (piece_end <= border + same_place) ++piece;
    while (cell + 1 < cells.size() && cells[cell].end <= border + same_place) ++cell;
  }
}

// r'' that keep the limits for half a cycle, by the samples from `first` on, which is moved along. False:
// none does, or the plan is not known so far.
bool PlanBraking::range(const Rate& at, double half, std::uint64_t& first, Range& bend) const {
  const double r0 = at.rate, r1 = std::max(0.0, at.rate + half * at.slope);  // at the end, about
  const double fastest = std::max(r0, r1), end = at.time + half * fastest;
  while (first + 1 < filled_ && samples_[(first + 1) % ring].time <= at.time) ++first;
  bend = {-most_bend, most_bend};
  // Shares of the limits used where the plan itself uses no more; the rest is for what lies between samples.
  constexpr double acceleration_share = 0.997, jerk_share = 0.99;
  for (std::uint64_t n = first; n < filled_; ++n) {
    const Sample& sample = samples_[n % ring];
    for (int i = 0; i < sample.count; ++i) {
      const AxisSample& q = sample.axes[static_cast<std::size_t>(i)];
      const double acceleration =
          std::max(acceleration_share, fastest * fastest * std::abs(q.acceleration_a));
      const double jerk = std::max(jerk_share, fastest * fastest * fastest * std::abs(q.jerk_j));
      narrow_offset(bend, r0 * r0 * r0 * q.jerk_j + 3 * r0 * at.slope * q.acceleration_j, q.speed_j, jerk);
      narrow_offset(bend, r1 * r1 * r1 * q.jerk_j + 3 * r1 * at.slope * q.acceleration_j,
                    q.speed_j + 3 * r1 * half * q.acceleration_j, jerk);
      narrow_offset(bend, r1 * r1 * q.acceleration_a + at.slope * q.speed_a, half * q.speed_a, acceleration);
    }
    if (sample.time >= end) return bend.low <= bend.high;
  }
  return false;
}

// Brakes for a cycle with a share of the strongest braking, and returns to a constant rate as soon as
// possible.
bool PlanBraking::proves(double share, double half, const SpeedPlan& plan, const SpeedStage& stage) {
  tried_.clear();
  Rate at = now_;
  std::uint64_t first = first_;
  while (tried_.size() < most_steps) {
    Range bend;
    if (!range(at, half, first, bend)) return false;
    double use = 0;
    if (tried_.size() < 2) {
      use = std::clamp(share * bend.low, bend.low, bend.high);
    } else {
      use = std::clamp(-at.slope / half, bend.low, bend.high);
    }
    tried_.push_back(use);
    const bool settles = tried_.size() > 2 && use == -at.slope / half;
    at = after(at, use, half);
    if (at.rate < 0 || at.slope > offset_rounding) return false;
    if (!settles) continue;
    const SpeedPiece& last = plan[plan.size() - 1];
    const double v = at.rate * std::sqrt(std::max(0.0, last.b0));
    return stage.stops_from({last.at, v, 0}) && stage.stops_from({last.end(), v, 0});
  }
  return false;
}

PathState PlanBraking::step(SpeedPlan& plan, const SpeedStage& stage, double cycle, bool brake) {
  const double half = cycle / 2;
  while (first_ + 1 < filled_ && samples_[(first_ + 1) % ring].time <= now_.time) ++first_;
  fill(plan, stage.cells(), now_.time + horizon);
  if (brake) {
    for (const double share : shares) {
      if (!proves(share, half, plan, stage)) continue;
      return_.swap(tried_);
      returned_ = 0;
      break;
    }
  }
  const double from = now_.time;
  for (int k = 0; k < 2; ++k) {
    const bool returns = returned_ < return_.size();
    now_ = after(now_, returns ? return_[returned_++] : 0, half);
    if (returned_ >= return_.size()) now_.slope = 0;
  }
  passed_ = now_.time - from;
  on_plan_ = plan.advance(on_plan_, passed_);
  const double r = now_.rate;
  return {on_plan_.s, r * on_plan_.v, now_.slope * on_plan_.v + r * r * on_plan_.a};
}

}  // namespace trunnion::motion
