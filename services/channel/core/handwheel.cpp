// SPDX-License-Identifier: Apache-2.0
#include "handwheel.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::channel {
namespace {

std::size_t window(double cycles) {
  return static_cast<std::size_t>(
      std::clamp(std::ceil(cycles), 1.0, static_cast<double>(AxisFollower::longest_window)));
}

}  // namespace

void AxisFollower::Window::fill(double value) {
  std::fill(values_.begin(), values_.end(), value);
  sum_ = value * static_cast<double>(values_.size());
  next_ = 0;
}

double AxisFollower::Window::average(double value) {
  sum_ += value - values_[next_];
  values_[next_] = value;
  next_ = (next_ + 1) % values_.size();
  return sum_ / static_cast<double>(values_.size());
}

// The ramp's velocity may change by twice itself at once, at a reversal: spread over a window of n cycles
// that is an acceleration of 2 v / (n T), and likewise for the acceleration and the jerk.
void AxisFollower::configure(double velocity, double acceleration, double jerk, double cycle_seconds) {
  const double longest = static_cast<double>(longest_window) * cycle_seconds / 2;
  const double reachable = std::min(acceleration, jerk * longest);
  const double v = std::min(velocity, reachable * longest);
  first_.configure(window(2 * v / (reachable * cycle_seconds)));
  second_.configure(window(2 * reachable / (jerk * cycle_seconds)));
  step_ = v * cycle_seconds;
  start(0);
}

void AxisFollower::start(double position) {
  target_ = ramp_ = position_ = position;
  first_.fill(position);
  second_.fill(position);
  settled_ = windows();
}

double AxisFollower::step() {
  if (at_rest()) return position_;
  const double rest = target_ - ramp_;
  if (std::abs(rest) <= step_) {
    settled_ = rest == 0 ? settled_ + 1 : 0;
    ramp_ = target_;
  } else {
    settled_ = 0;
    ramp_ += rest > 0 ? step_ : -step_;
  }
  position_ = second_.average(first_.average(ramp_));
  if (settled_ >= windows()) start(target_);  // sums of rounded numbers end a little beside it
  return position_;
}

void Handwheel::configure(const motion::Limits& limits, const AxisValues& velocity, double share,
                          double cycle_seconds) {
  for (std::size_t i = 0; i < followers_.size(); ++i) {
    const auto& axis = limits.axes[i];
    followers_[i].configure(share * std::min(velocity[i], axis.velocity), share * axis.acceleration,
                            share * axis.jerk, cycle_seconds);
  }
  start({});
}

void Handwheel::start(const AxisValues& position) {
  for (std::size_t i = 0; i < followers_.size(); ++i) followers_[i].start(position[i]);
  position_ = target_ = position;
}

void Handwheel::stop() {
  for (std::size_t i = 0; i < followers_.size(); ++i) {
    followers_[i].stop();
    target_[i] = followers_[i].target();
  }
}

double Handwheel::turn(std::size_t axis, double distance, double low, double high) {
  const double from = target_[axis];
  // An axis that is outside already may only come back.
  const double to = std::clamp(from + distance, std::min(low, from), std::max(high, from));
  target_[axis] = to;
  followers_[axis].set_target(to);
  return to - from;
}

const AxisValues& Handwheel::step() {
  for (std::size_t i = 0; i < followers_.size(); ++i) position_[i] = followers_[i].step();
  return position_;
}

bool Handwheel::at_rest() const {
  return std::all_of(followers_.begin(), followers_.end(), [](const auto& f) { return f.at_rest(); });
}

}  // namespace trunnion::channel
