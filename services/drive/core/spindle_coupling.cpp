// SPDX-License-Identifier: Apache-2.0
#include "spindle_coupling.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::drive {
namespace {

constexpr double turn_degrees = 360;
constexpr std::uint64_t most_late = 3;         // periods
constexpr std::uint32_t most_returning = 250;  // periods behind a stop on the path

}  // namespace

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

// Hardware that samples once a period has the angle of one before, and a loop of its own is later still: the
// spindle may be where it should have been some periods ago.
std::optional<double> SpindleCoupling::deviation(std::uint64_t in_force, double angle) const {
  const Row* newest = row(in_force);
  if (newest == nullptr) return std::nullopt;
  double low = newest->angle, high = low;
  for (std::uint64_t late = 1; late <= most_late && late <= in_force; ++late) {
    const Row* before = row(in_force - late);
    if (before == nullptr) break;
    low = std::min(low, before->angle);
    high = std::max(high, before->angle);
  }
  return std::clamp(angle, low, high) - angle;
}

bool SpindleCoupling::does_not_follow(std::uint64_t number, std::uint64_t in_force, double angle,
                                      bool whole) {
  rows_[number % most_rows] = {number, setpoint_.coupled, setpoint_.angle};
  const auto away = deviation(in_force, angle);
  error_ = turn_degrees * away.value_or(0);
  if (!whole && away && limit_ > 0) {
    returning_ = 1;
    return false;
  }
  if (!away || limit_ <= 0 || std::abs(error_) <= limit_) {
    returning_ = 0;
    return false;
  }
  if (returning_ > most_returning) return false;  // it has been told
  returning_ = returning_ == 0 ? most_returning + 1 : returning_ + 1;
  return returning_ > most_returning;
}

const SpindleCoupling::Row* SpindleCoupling::row(std::uint64_t number) const {
  const Row& found = rows_[number % most_rows];
  return found.number == number && found.coupled ? &found : nullptr;
}

}  // namespace trunnion::drive
