#include "spindle.hpp"

#include <algorithm>

namespace trunnion::drive {
namespace {
constexpr double seconds_per_minute = 60;
}

void Spindle::configure(double acceleration, double period) {
  period_ = period;
  step_ = acceleration / 6 * period;  // deg/s2 to 1/min per period
}

void Spindle::couple(double revolutions) {
  if (!coupled_) origin_ = target_ = angle_ - revolutions;
  const double target = origin_ + revolutions;
  change_ = coupled_ ? target - target_ : 0;
  target_ = command_ = target;
  coupled_ = true;
}

void Spindle::lead(double phase, double next_revolutions) {
  command_ = target_ + phase * (origin_ + next_revolutions - target_);
}

void Spindle::step(bool powered) {
  double wanted = powered ? order_ : 0;
  if (coupled_ && powered) wanted = (command_ - angle_) / period_ * seconds_per_minute;
  speed_ += std::clamp(wanted - speed_, -step_, step_);
  angle_ += speed_ / seconds_per_minute * period_;
}

}  // namespace trunnion::drive
