// SPDX-License-Identifier: Apache-2.0
#include "homing_cycle.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::drive {
namespace {
// Periods at rest after which the axis has followed, also behind a queue of setpoint rows.
constexpr std::uint32_t settling = 500;
}  // namespace

void HomingCycle::start(const Settings& settings, double position) {
  *this = {};
  settings_ = settings;
  position_ = start_ = position;
  state_ = State::moving;
  phase_ = Phase::leave_fast;
}

void HomingCycle::abort(Failure failure) {
  if (!aborted_) failure_ = failure;
  aborted_ = true;
  phase_ = Phase::settle;
}

double HomingCycle::demand() const {
  switch (phase_) {
    case Phase::leave_fast:
      return -settings_.direction * settings_.search;
    case Phase::search:
      return settings_.direction * settings_.search;
    case Phase::leave:
      return -settings_.direction * settings_.creep;
    case Phase::creep:
    case Phase::mark:
      return settings_.direction * settings_.creep;
    case Phase::settle:
      break;
  }
  return 0;
}

void HomingCycle::next_phase(const Signals& signals) {
  switch (phase_) {
    case Phase::leave_fast:
      if (!signals.any_switch) phase_ = Phase::search;
      break;
    case Phase::search:
      if (signals.all_switches) phase_ = Phase::leave;
      break;
    case Phase::leave:
      if (!signals.any_switch) phase_ = Phase::creep;
      break;
    case Phase::creep:
      if (signals.all_switches) phase_ = settings_.index ? Phase::mark : Phase::settle;
      break;
    case Phase::mark:
      if (signals.all_marks) phase_ = Phase::settle;
      break;
    case Phase::settle:
      break;
  }
}

double HomingCycle::step_together(const Signals& signals, double dt) {
  next_phase(signals);
  ++periods_;
  if (std::abs(position_ - start_) > settings_.travel) abort(Failure::travel);
  if (settings_.seconds > 0 && periods_ * dt > settings_.seconds) abort(Failure::time);
  const double change = settings_.acceleration * dt;
  velocity_ += std::clamp(demand() - velocity_, -change, change);
  position_ += velocity_ * dt;
  at_rest_ = phase_ == Phase::settle && velocity_ == 0 ? at_rest_ + 1 : 0;
  if (at_rest_ >= (aborted_ ? 1 : settling)) state_ = aborted_ ? State::failed : State::done;
  return position_;
}

}  // namespace trunnion::drive
