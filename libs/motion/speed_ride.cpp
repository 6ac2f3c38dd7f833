// The speed stage where the path is curved and speed comes near what the axes stand: instead of closed forms
// over whole cells, each cycle takes as much of the wish as leaves a way to a standstill that is followed
// step by step (pace.hpp). So the limits themselves are what is ridden along.
#include <algorithm>
#include <cmath>

#include "motion/pace.hpp"
#include "motion/speed_stage.hpp"

namespace trunnion::motion {
namespace {

constexpr double rounding = 1e-7;
// Below this share of what the ramps of a cell were made for they give next to nothing away.
constexpr double easy_share = 0.4;
// A way to a standstill has about this many steps, and none is shorter than a cycle.
constexpr double stop_steps = 60;
// How far beside a place of the path a motion may end and count as ending there, mm or degrees.
constexpr double place_tolerance = 1e-9;
// When braking fails, the acceleration is taken back earlier, down to this share of the jerk.
constexpr double least_take_back = 0.75;

}  // namespace

double SpeedStage::top_of(const LimitCell& cell, const Look& look) const {
  if (!look.soft) return cell.top;
  return cell.rapid ? cell.top * look.rapid : std::min(cell.top, cell.feed * look.feed);
}

double SpeedStage::stop_step(const PathState& state) const {
  const RampLimits& ramp = cells_[current_].ramps[LimitCell::levels - 1];
  const double time = state.v / ramp.acceleration + 2 * ramp.acceleration / ramp.jerk;
  return std::max(cycle_, time / stop_steps);
}

// Curved cells within the way to a standstill on which the speed there is, or is wished for, is not an easy
// one.
bool SpeedStage::rides(const Look& look) const {
  const double wished = look.soft ? top_of(cells_[current_], look) : 0;
  const double fastest =
      std::max({state_.v, settled_speed(state_.v, state_.a, cells_[current_].ramps[0].jerk),
                std::min(wished, state_.v + 0.05 * wished)});
  const double reach =
      state_.s + braking_distance(fastest, 0, 0, cells_[current_].ramps[LimitCell::levels - 1]);
  for (std::uint64_t k = current_; k < cells_.size() && (k == current_ || !cells_[k].stop); ++k) {
    const LimitCell& cell = cells_[k];
    if (k > current_ && cell.at > reach) break;
    if (cell.uniform || cell.axis_count == 0) continue;
    if (std::max(fastest, top_of(cell, look)) > easy_share * cell.speed) return true;
  }
  return false;
}

// Braking to a standstill, first to the speed of a cell that does not stand it otherwise, and more gently
// where a rough cell is on the way.
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
    if (v > rough.top * (1 + rounding)) {
      part.clear();
      const BrakeEnd slower = brake(from, cells_, here, rough.top, step, pacing, part);
      if (slower.result != Braked::yes || slower.cell > whole.cell || !stop.add(part)) return false;
      from = slower.state;
      here = slower.cell;
      continue;
    }
    if (pacing.take_back > least_take_back) {
      pacing.take_back *= 0.88;
      continue;
    }
    const RampLimits& gentle = rough.ramp(v);
    if (gentle.acceleration >= pacing.acceleration && gentle.jerk >= pacing.jerk) return false;
    pacing.acceleration = std::min(pacing.acceleration, gentle.acceleration);
    pacing.jerk = std::min(pacing.jerk, gentle.jerk);
  }
  return false;
}

// The cell ahead that is nearest to being too slow for `state`, by its closed form.
std::optional<std::uint64_t> SpeedStage::critical_cell(const PathState& state, std::uint64_t cell,
                                                       const Look& look) const {
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
    const double speed = top_of(cells_[k], look);
    if (highest <= speed * (1 + rounding)) continue;
    const double needed = braking_distance(highest, 0, speed, ramp) / std::max(distance, 1e-9);
    if (needed > worst) worst = needed, found = k;
  }
  return found;
}

// Takes the action when it keeps all limits, a way to a standstill follows, and slower cells ahead can be
// entered at their speed without acceleration.
bool SpeedStage::accept_curved(const PhaseList& action, const Look& look, Braked& why) {
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
  if (look.soft) {
    if (const auto slower = critical_cell(next, cell, look)) {
      PhaseList leg;
      const BrakeEnd end = brake(next, cells_, cell, top_of(cells_[*slower], look), stop_step(next), {}, leg);
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

bool SpeedStage::ride(const Look& look, bool hold) {
  const LimitCell& here = cells_[current_];
  if (arriving_ && stop_.size() > 0) {
    follow_stop();
    return true;
  }
  arriving_ = false;
  const double target = hold ? 0 : top_of(here, look);
  Look judged = look;
  judged.soft = !hold;
  Braked why = Braked::yes;
  PhaseList wish, action;
  fill_cycle(state_, cycle_, target, wish);
  if (state_.v > target * (1 + rounding)) judged.soft = false;
  if (accept_curved(wish, judged, why)) return true;
  double low = 0, high = cycle_;
  bool taken = false;
  const PathState before = state_;
  const std::uint64_t cell_before = current_;
  PathState best;
  std::uint64_t best_cell = 0;
  PhaseList best_stop;
  int tries = why == Braked::beyond ? 34 : standing() ? 30 : 6;
  for (int k = 0; k <= tries; ++k) {
    const double time = k == 0 ? 0 : 0.5 * (low + high);
    action.clear();
    PathState at = before;
    double left = time;
    for (std::size_t n = 0; n < wish.size() && left > 0; ++n) {
      const double part = std::min(left, wish[n].time);
      action.add(JerkPhase{part, wish[n].jerk});
      at = integrate(at, wish[n].jerk, part);
      left -= part;
    }
    fill_cycle(at, cycle_ - time, 0, action);
    Braked reason = Braked::yes;
    if (accept_curved(action, judged, reason)) {
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
  // What is only wished ahead comes too late: braking is all there is to do about it.
  if (judged.soft) {
    judged.soft = false;
    action.clear();
    fill_cycle(state_, cycle_, 0, action);
    if (accept_curved(action, judged, why)) return true;
  }
  return false;
}

}  // namespace trunnion::motion
