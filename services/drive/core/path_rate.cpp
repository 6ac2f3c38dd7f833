// SPDX-License-Identifier: Apache-2.0
#include "path_rate.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::drive {

double PathRate::next(double step) {
  if (dip_periods_ == 0) {
    if (rate_ < 1) return rate_ = std::min(1.0, rate_ + step);
    begin_dip(step);
  }
  --dip_periods_;
  if (dip_periods_ == 0) {  // what is left of the phase is this period's loss, but for rounding
    run_whole();
    return 1;
  }
  rate_ = 1 - dip_step_ * std::min(dip_periods_ + 1, 2 * dip_depth_ - 1 - dip_periods_);
  return rate_;
}

// At full rate but between two cycles: falls back by what is too much, with a dip of the rate that changes it
// by s in every period down to 1 - m s and back, which takes s m^2 of a cycle.
void PathRate::begin_dip(double step) {
  dip_depth_ = static_cast<std::uint32_t>(std::max(1.0, std::ceil(std::sqrt(phase_ / step))));
  dip_step_ = phase_ / (static_cast<double>(dip_depth_) * dip_depth_);
  dip_periods_ = 2 * dip_depth_ - 1;
}

}  // namespace trunnion::drive
