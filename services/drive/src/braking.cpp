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
  rate_step_ = rate_step();
  dip_periods_ = 0;
  if (reserve_ == 0 && mode_ == Mode::FOLLOWING && phase_ == 0 && supply().cycles == 0) rate_ = 0;  // at rest
  if (mode_ == Mode::RETURNING) rate_ = 0;
  mode_ = Mode::BRAKING;
  forget_resumes();
}

// The change of rate that accelerates the fastest axis of the setpoints at hand by its limit.
double DriveCore::rate_step() { return 1 / std::max(2.0, stop_periods(std::min(supply().cycles, lead_))); }

// At full rate but between two cycles: falls back by what is too much, with a dip of the rate that changes it
// by s in every period down to 1 - m s and back, which takes s m^2 of a cycle.
void DriveCore::return_to_whole_cycles() {
  if (dip_periods_ == 0) {
    dip_depth_ = static_cast<std::uint32_t>(std::max(1.0, std::ceil(std::sqrt(phase_ / rate_step()))));
    dip_step_ = phase_ / (static_cast<double>(dip_depth_) * dip_depth_);
    dip_periods_ = 2 * dip_depth_ - 1;
  }
  --dip_periods_;
  if (dip_periods_ == 0) {  // what is left of the phase is this period's loss, but for rounding
    rate_ = 1, phase_ = 0;
    advance(1);
    return;
  }
  rate_ = 1 - dip_step_ * std::min(dip_periods_ + 1, 2 * dip_depth_ - 1 - dip_periods_);
  advance(rate_);
}

// Another part of the controller has found a reason to stop: along the path, as for a missing setpoint.
void DriveCore::stop() {
  if (mode_ == Mode::HOMING) abort_homing();
  if (mode_ == Mode::FOLLOWING && any_active()) begin_braking();
}

void DriveCore::brake() {
  rate_ -= rate_step_;
  if (rate_ <= 0) {
    stopped();
    return;
  }
  if (supply().cycles > 0 && !off_path_) {
    advance(rate_);
    return;
  }
  // Out of setpoints: continue along the tangent. The path is left at its last known point.
  off_path_ = true;
  phase_ = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) command_[i] += rate_ * velocity_[i];
  for (auto& spindle : spindles_) spindle.lead_on(rate_);
}

void DriveCore::stopped() {
  rate_ = 0, reserve_ = 0;
  if (!enabled_) {
    mode_ = Mode::OFF;
  } else {
    mode_ = any_active() ? Mode::HELD : Mode::FOLLOWING;
    if (!any_active()) rate_ = 1, phase_ = 0;
  }
}

// The start of one channel moves no axis of another: who stands there has a key of his own.
bool DriveCore::resume_demanded() const {
  return any_active() && std::all_of(channels_.begin(), channels_.end(),
                                     [](const auto& c) { return c.second.resume || !c.second.active; });
}

void DriveCore::forget_resumes() {
  for (auto& [number, channel] : channels_) channel.resume = false;
}

void DriveCore::resume() {
  forget_resumes();
  resumed_ = true;
  bool away = off_path_;
  for (std::size_t i = 0; i < axes_.size() && phase_ == 0; ++i)
    away = away || std::abs(command_[i] - target_[i]) > on_path_distance;
  if (away) {
    plan_return(target_);
    return;
  }
  rate_ = 0;
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
  rate_ = phase_ == 0 && rate_ == 1 ? 1 : 0;
}

}  // namespace trunnion::drive
