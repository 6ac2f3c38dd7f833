// SPDX-License-Identifier: Apache-2.0
// Spreads a step of a correction over time.
#pragma once

#include <array>

namespace trunnion::compensation {

/// What remains of past steps, passed through three first-order low passes in a row: position, velocity and
/// acceleration of the corrected setpoint stay continuous, the jerk after a step d is at most d / (time
/// constant)^3. Linear: steps that follow each other add up.
class SmoothTransition {
 public:
  static constexpr std::size_t state_count = 3;

  /// A step by `amount` occurs now: the sum of it and value() stays what it was.
  void absorb(double amount) {
    for (double& rest : rest_) rest -= amount;
  }
  /// One cycle; `share` is cycle time / (time constant + cycle time).
  void step(double share) {
    double before = 0;
    for (double& rest : rest_) {
      rest += share * (before - rest);
      before = rest;
    }
  }
  /// To be added to the value that has stepped.
  double value() const { return rest_.back(); }
  void clear() { rest_.fill(0); }

  std::array<double, state_count>& rest() { return rest_; }
  const std::array<double, state_count>& rest() const { return rest_; }

 private:
  std::array<double, state_count> rest_{};
};

}  // namespace trunnion::compensation
