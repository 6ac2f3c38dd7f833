// SPDX-License-Identifier: Apache-2.0
#include "motion/planned_speed.hpp"

#include <algorithm>
#include <cmath>

#include "motion/cell_builder.hpp"

namespace trunnion::motion {
namespace {

// s of motion in the first window, which is solved within one cycle.
constexpr double first_horizon = 0.08;
// And in the others, and more for each second of a stop.
constexpr double least_horizon = 0.42, longest_horizon = 1.5, horizon_in_stops = 2.2, beside_stops = 0.25;
// A window begins this far ahead of the motion, s: more cycles than solving takes.
constexpr double lead = 0.045;
// The next window is begun when no more than this and the braking ahead are left of the plan, s.
constexpr double least_left = 0.08, left_in_stops = 1.3;
// Near the end of a section the stage takes over as soon as it can, s before it.
constexpr double hand_over = 0.06;
constexpr double creep_cycles = 2;
// Slower motion is the stage's, mm/s or degrees/s.
constexpr double slowest = 1;
// Cycles after an attempt that failed.
constexpr int pause = 40;
// Dense curves this time ahead are near, s.
constexpr double near_time = 0.15;
constexpr double longest_stop = 0.5;
constexpr int most_near = 200;

// Time of a stop from the speed v on a cell, s, by what it permits at low speed.
double stop_time(const LimitCell& cell, double v) {
  const RampLimits& ramp = cell.ramps[LimitCell::levels - 1];
  const double a = std::max(ramp.acceleration, 1e-3), j = std::max(ramp.jerk, 1e-3);
  return v / a + a / j;
}

double horizon_at(const LimitCell& cell, double v, double feed) {
  const double fastest =
      std::max(v, cell.rapid ? cell.reachable : std::min(cell.reachable, cell.feed * feed));
  return std::clamp(beside_stops + horizon_in_stops * stop_time(cell, fastest), least_horizon,
                    longest_horizon);
}

}  // namespace

void PlannedSpeed::clear() {
  optimizer_.cancel();
  braking_.clear();
  plan_.clear();
  pause_ = 0;
  blocked_to_ = -1e300;
}

PlannedSpeed::Demand PlannedSpeed::demand_of(const Overrides& overrides, const LimitCell& cell) {
  const double feed = std::clamp(overrides.feed, 0.0, highest_override),
               rapid = std::clamp(overrides.rapid, 0.0, 1.0);
  return {feed, rapid, overrides.hold || (cell.rapid ? rapid <= 0 : feed <= 0)};
}

bool PlannedSpeed::is_near(const SpeedStage& stage, bool any_curve) const {
  const CellRing& cells = stage.cells();
  const std::uint64_t here = stage.current_cell();
  const double reach = stage.state().s + (any_curve ? 2 : 1) * near_time * stage.state().v;
  for (std::uint64_t k = here; k < cells.size() && k < here + most_near; ++k) {
    if (k > here && (cells[k].stop || cells[k].at > reach)) return false;
    if (cells[k].known_axes == 0) return false;
    if (cells[k].dense || (any_curve && !cells[k].uniform && cells[k].axis_count == 0)) return true;
  }
  return false;
}

// The last piece is left at a constant speed, and there the stage has to prove its stop: at the latest at its
// end, within which a cycle ends.
bool PlannedSpeed::take(const SpeedStage& stage, std::size_t index) {
  const SpeedPiece& last = optimizer_.pieces().back();
  const double square = last.square(last.end()), v = std::sqrt(std::max(0.0, square));
  const SpeedPiece creeping{last.end(), creep_cycles * cycle_ * v, square, 0, 0};
  if (!(v > 0) || !stage.stops_from({creeping.at, v, 0}) || !stage.stops_from({creeping.end(), v, 0}))
    return false;
  if (!plan_.replace(index, optimizer_.pieces(), creeping)) return false;
  demand_ = asked_;
  known_ = asked_known_;
  reaches_end_ = optimizer_.reaches_end();
  drawn_ = optimizer_.drawn();
  left_ = 0;
  for (std::size_t k = plan_.current(); k < plan_.size(); ++k) left_ += plan_[k].duration();
  return true;
}

void PlannedSpeed::end(bool at_end) {
  if (at_end) blocked_to_ = plan_.end() + 0.001;
  optimizer_.cancel();
  braking_.clear();
  plan_.clear();
  pause_ = at_end ? 0 : pause;
}

void PlannedSpeed::launch(const SpeedStage& stage, const Demand& demand) {
  std::size_t index = plan_.current() + 1;
  for (double time = 0; time < lead && index < plan_.size(); ++index) time += plan_[index].duration();
  if (index + 1 >= plan_.size()) return;
  const SpeedPiece& piece = plan_[index];
  const CellRing& cells = stage.cells();
  SpeedRequest request;
  request.cell = stage.current_cell();
  while (request.cell + 1 < cells.size() && cells[request.cell].end <= piece.at + 1e-12) ++request.cell;
  request.from = {piece.at, std::sqrt(std::max(0.0, piece.b0)), piece.b1 / 2};
  request.feed = demand.feed;
  request.rapid = demand.rapid;
  request.lower = drawn_ || demand.feed < demand_.feed || demand.rapid < demand_.rapid;
  request.horizon = horizon_at(cells[request.cell], request.from.v, demand.feed);
  start_ = index;
  asked_ = demand;
  asked_known_ = cells.size();
  if (!optimizer_.begin(cells, request, &plan_)) {
    pause_ = pause;
    demand_ = demand;
    known_ = cells.size();
  }
}

void PlannedSpeed::work(const SpeedStage& stage) {
  if (!optimizer_.work(stage.cells())) return;
  if (!optimizer_.solved()) {
    ++failed_;
    pause_ = pause;
    return;
  }
  if (plan_.current() < start_ && take(stage, start_)) {
    ++solved_;
    return;
  }
  ++failed_;
  pause_ = pause;
}

bool PlannedSpeed::step(SpeedStage& stage, const Overrides& overrides) {
  if (plan_.empty()) return false;
  const Demand demand = demand_of(overrides, stage.cells()[stage.current_cell()]);
  if (pause_ > 0) --pause_;
  if (demand.brake && !braking_.active()) {
    optimizer_.cancel();
    braking_.start(plan_, stage);
  }
  if (braking_.active()) {
    // The plan is followed more slowly until the stage proves a stop.
  } else if (optimizer_.running()) {
    work(stage);
  } else if (pause_ == 0) {
    const bool grown = stage.cells().size() != known_;
    const double stop = stop_time(stage.cells()[stage.current_cell()], stage.state().v);
    const bool short_left = left_ < least_left + left_in_stops * std::min(stop, longest_stop);
    if (!(demand == demand_) || (short_left && (!reaches_end_ || grown))) launch(stage, demand);
  }
  const bool ends = (left_ < hand_over && !optimizer_.running()) || plan_.current() + 1 == plan_.size();
  if ((braking_.active() || ends || !is_near(stage, true)) && stage.take_over()) {
    end(ends);
    return false;
  }
  if (braking_.active()) {
    slow_down(stage, demand.brake);
  } else {
    stage.place(plan_.advance(stage.state(), cycle_));
    left_ -= cycle_;
  }
  return true;
}

// When the hold is over before the stage has proved a stop, the plan goes on at the rate reached.
void PlannedSpeed::slow_down(SpeedStage& stage, bool brake) {
  stage.place(braking_.step(plan_, stage, cycle_, brake));
  left_ -= braking_.plan_time();
  if (brake || !braking_.constant()) return;
  plan_.slow_down(braking_.rate());
  left_ /= braking_.rate();
  braking_.clear();
  demand_ = {0, 0};  // to be replaced
}

void PlannedSpeed::begin(SpeedStage& stage, const Overrides& overrides) {
  if (stage.at_standstill()) {
    blocked_to_ = -1e300;
    pause_ = 0;
    return;
  }
  if (pause_ > 0) {
    --pause_;
    return;
  }
  if (stage.state().v < slowest || stage.state().s < blocked_to_ || !is_near(stage, false)) return;
  const CellRing& cells = stage.cells();
  const Demand demand = demand_of(overrides, cells[stage.current_cell()]);
  if (demand.brake) return;
  SpeedRequest request;
  request.cell = stage.current_cell();
  request.from = stage.state();
  request.feed = demand.feed;
  request.rapid = demand.rapid;
  request.horizon = std::min(first_horizon, horizon_at(cells[request.cell], request.from.v, demand.feed));
  asked_ = demand;
  asked_known_ = cells.size();
  pause_ = pause;
  if (!optimizer_.begin(cells, request, nullptr)) return;
  while (!optimizer_.work(cells)) {
  }
  if (!optimizer_.solved()) {
    ++failed_;
    return;
  }
  plan_.clear();
  if (!take(stage, 0)) {
    ++failed_;
    return;
  }
  ++solved_;
  pause_ = 0;
  if (!reaches_end_) demand_ = {0, 0};  // to be replaced at once
}

}  // namespace trunnion::motion
