// SPDX-License-Identifier: Apache-2.0
// Whether the setpoints at hand are enough, and how many of them a stop takes.
#include <algorithm>
#include <cmath>

#include "drive_core.hpp"

namespace trunnion::drive {

// Setpoints of every axis at `cycle`; axes no channel moves then keep the point of the path they are at.
void DriveCore::target_of(std::uint64_t cycle, std::vector<double>& out) {
  out = target_;
  streams_.setpoints(cycle, axes_, slaves_, out);
}

// Periods it takes to stop from the fastest speed of the next `cycles` cycles with every axis within its
// acceleration.
double DriveCore::stop_periods(std::uint64_t cycles) {
  double periods = 0;
  before_ = target_;
  for (std::uint64_t c = next_; c < next_ + cycles; ++c) {
    target_of(c, scratch_);
    for (std::size_t i = 0; i < axes_.size(); ++i)
      periods = std::max(periods, std::abs(scratch_[i] - before_[i]) / (limits_[i].acceleration * dt_ * dt_));
    std::swap(before_, scratch_);
  }
  return periods;
}

bool DriveCore::enough(const StreamSupply& s) const {
  return s.cycles > 0 && (s.ends || s.cycles > reserve_);
}

bool DriveCore::prefilled(const StreamSupply& s) const {
  return s.ends || s.cycles + streams_.ahead(lead_) >= prefill_;
}

bool DriveCore::waiting() const { return mode_ == Mode::FOLLOWING && any_active() && !enough(supply()); }

bool DriveCore::can_step(bool give_up) const {
  switch (mode_) {
    case Mode::BRAKING:
    case Mode::RETURNING:
    case Mode::HOMING:
      return true;
    case Mode::HELD:
      return streams_.resume_demanded() && prefilled(supply());
    case Mode::OFF:
      return hardware_->running_out() || row_.spindles_controlled || spindles_run_down();
    case Mode::FOLLOWING:
      break;
  }
  if (!any_active()) return settle_ > 0 || needs_time();
  const auto s = supply();
  return enough(s) || (give_up && reserve_ > 0);
}

}  // namespace trunnion::drive
