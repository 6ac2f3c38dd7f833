// SPDX-License-Identifier: Apache-2.0
// How fast cycles of the stream pass while the drive brakes on the path and resumes.
#pragma once

#include <cstdint>

namespace trunnion::drive {

/// rate() cycles pass in one period, phase() is how far the next cycle has begun.
class PathRate {
 public:
  double rate() const { return rate_; }
  double phase() const { return phase_; }
  /// One cycle passes in one period, and none has begun: the ordinary case.
  bool whole() const { return rate_ == 1 && phase_ == 0; }
  /// The rate returns to whole cycles, so next() needs no step.
  bool dips() const { return dip_periods_ > 0; }

  /// The phase stays as it is.
  void hold() { rate_ = 0; }
  void run() { rate_ = 1; }
  void run_whole() { rate_ = 1, phase_ = 0; }
  void forget_phase() { phase_ = 0; }

  /// From now on brake() makes the rate less by `step`.
  void begin_braking(double step) {
    step_ = step;
    dip_periods_ = 0;
  }
  /// One period; false when the rate has come to its end.
  bool brake() {
    rate_ -= step_;
    return rate_ > 0;
  }
  /// One period: the cycles that pass in it, on the way to whole(). `step` is the largest change of the rate.
  double next(double step);

  void pass(double cycles) { phase_ += cycles; }
  /// A cycle is passed and taken off the phase.
  bool due() const { return phase_ >= 1; }
  void take_cycle() { phase_ -= 1; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("rate", self.rate_), visit("rate_step", self.step_), visit("phase", self.phase_);
    visit("dip_step", self.dip_step_), visit("dip_depth", self.dip_depth_);
    visit("dip_periods", self.dip_periods_);
  }

 private:
  void begin_dip(double step);

  double rate_ = 1, step_ = 0, phase_ = 0;
  double dip_step_ = 0;
  std::uint32_t dip_depth_ = 0, dip_periods_ = 0;
};

}  // namespace trunnion::drive
