// SPDX-License-Identifier: Apache-2.0
// Leaving the path and returning to it: braking, holding, resuming.
//
// Acceleration. With A' = acceleration * dt^2 the largest second difference the path uses itself, and a rate
// that goes from r1 to r2 between two periods, the second difference of an axis is
//   [y(s + r2) - y(s)] - [y(s) - y(s - r1)] = {y(s + r2) - 2 y(s) + y(s - r2)} + {y(s - r1) - y(s - r2)}.
// Between cycles the path is linear, so the first brace is a sum of the path's second differences weighted by
// a tent of half width r2 around s, which at whole distances adds up to at most r2 for r2 <= 1: at most A'
// r2. The second is |r1 - r2| times a velocity, which rate_step() keeps at A'. Leaving or joining the path
// therefore asks at most twice the limit of an axis, and that only where the path uses all of the limit.
#include <algorithm>
#include <cmath>

#include "drive_core.hpp"

namespace trunnion::drive {

void DriveCore::begin_braking() {
  rate_.begin_braking(rate_step());
  const bool at_rest =
      reserve_ == 0 && mode_ == Mode::FOLLOWING && rate_.phase() == 0 && supply().cycles == 0;
  if (at_rest || mode_ == Mode::RETURNING) rate_.hold();
  mode_ = Mode::BRAKING;
  streams_.forget_resumes();
}

// The change of rate that accelerates the fastest axis of the setpoints at hand by its limit.
double DriveCore::rate_step() { return 1 / std::max(2.0, stop_periods(std::min(supply().cycles, lead_))); }

// Another part of the controller has found a reason to stop: along the path, as for a missing setpoint.
void DriveCore::stop() {
  if (mode_ == Mode::HOMING) homing_.abort();
  streams_.refuse_waiting();
  if (mode_ == Mode::FOLLOWING && any_active()) begin_braking();
}

void DriveCore::brake() {
  if (!rate_.brake()) {
    stopped();
    return;
  }
  if (supply().cycles > 0 && !off_path_) {
    advance(rate_.rate());
    return;
  }
  // Out of setpoints: continue along the tangent. The path is left at its last known point.
  off_path_ = true;
  rate_.forget_phase();
  for (std::size_t i = 0; i < axes_.size(); ++i) command_[i] += rate_.rate() * velocity_[i];
  spindles_.lead_on(rate_.rate());
}

void DriveCore::stopped() {
  rate_.hold();
  reserve_ = 0;
  if (!enable_.demanded()) {
    mode_ = Mode::OFF;
  } else {
    mode_ = any_active() ? Mode::HELD : Mode::FOLLOWING;
    if (!any_active()) rate_.run_whole();
  }
}

void DriveCore::resume() {
  streams_.forget_resumes();
  resumed_ = true;
  bool away = off_path_;
  for (std::size_t i = 0; i < axes_.size() && rate_.phase() == 0; ++i)
    away = away || std::abs(command_[i] - target_[i]) > on_path_distance;
  if (away) {
    plan_return(target_);
    return;
  }
  rate_.hold();
  mode_ = Mode::FOLLOWING;
}

void DriveCore::plan_return(const std::vector<double>& target) {
  double seconds = dt_;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double d = std::abs(target[i] - command_[i]);
    seconds = std::max(seconds, quintic_seconds(d, limits_[i].velocity, limits_[i].acceleration));
  }
  return_.start(command_, target, seconds, dt_);
  off_path_ = false;
  after_alignment_ = Mode::OFF;
  mode_ = Mode::RETURNING;
}

void DriveCore::step_return() {
  if (!return_.step(command_)) return;
  if (after_alignment_ != Mode::OFF) return end_alignment();
  target_ = command_;
  mode_ = Mode::FOLLOWING;
  if (!rate_.whole()) rate_.hold();
}

}  // namespace trunnion::drive
