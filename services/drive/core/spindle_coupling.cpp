// SPDX-License-Identifier: Apache-2.0
#include "spindle_coupling.hpp"

namespace trunnion::drive {

void SpindleCoupling::couple(double revolutions, double angle) {
  if (!setpoint_.coupled) origin_ = target_ = angle - revolutions;
  const double target = origin_ + revolutions;
  change_ = setpoint_.coupled ? target - target_ : 0;
  target_ = setpoint_.angle = target;
  setpoint_.coupled = true;
}

void SpindleCoupling::lead(double phase, double next_revolutions) {
  setpoint_.angle = target_ + phase * (origin_ + next_revolutions - target_);
}

}  // namespace trunnion::drive
