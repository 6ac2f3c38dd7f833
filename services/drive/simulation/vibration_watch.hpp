// SPDX-License-Identifier: Apache-2.0
// Finds a vibration of an axis in its following error: strokes that alternate.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace trunnion::drive {

class VibrationWatch {
 public:
  /// `limit` mm or deg: half of a stroke that is the end, 0 = none. Strokes count when they have a fifth of
  /// it or more and none took longer than half a period of 15 Hz. Five in a row that do not decay are a
  /// vibration: what a reversal or an acceleration has excited decays. So is a third one at 0.6 of the limit,
  /// before it is complete.
  void start(double limit) {
    *this = {};
    limit_ = limit;
  }
  /// The error after another `h` s. True when a vibration is found.
  bool step(double error, double h) {
    if (!(limit_ > 0)) return false;
    time_ += h;
    if (!begun_) low_ = high_ = error, begun_ = true;
    low_ = std::min(low_, error), high_ = std::max(high_, error);
    const double turn = limit_ / 10;  // smaller movements are no reversal
    if (direction_ >= 0 && error < high_ - turn) return stroke(high_, error, -1);
    if (direction_ <= 0 && error > low_ + turn) return stroke(low_, error, 1);
    return alternating_ >= 2 && time_ <= longest && std::abs(error - extreme_) / 2 >= limit_ * 0.6;
  }
  /// Half of the largest of three or more alternating strokes, mm or deg.
  double largest() const { return largest_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("limit", self.limit_), visit("time", self.time_), visit("begun", self.begun_);
    visit("low", self.low_), visit("high", self.high_), visit("direction", self.direction_);
    visit("extreme", self.extreme_), visit("strokes", self.strokes_);
    visit("alternating", self.alternating_), visit("before", self.before_), visit("largest", self.largest_);
  }

 private:
  static constexpr double longest = 0.5 / 15;  // s

  // The error has turned at `turned` and moves in `direction` now.
  bool stroke(double turned, double error, int direction) {
    const double half = std::abs(turned - extreme_) / 2;
    const bool alternates = direction_ != 0 && time_ <= longest && half >= limit_ / 5;
    alternating_ = alternates ? alternating_ + 1 : 0;
    strokes_ = alternates && half >= 0.98 * before_[1] ? strokes_ + 1 : 0;
    before_ = {half, before_[0]};
    if (alternating_ >= 3) largest_ = std::max(largest_, half);
    extreme_ = turned, direction_ = direction, time_ = 0;
    low_ = high_ = error;
    return strokes_ >= 5;
  }

  double limit_ = 0, time_ = 0, low_ = 0, high_ = 0, extreme_ = 0, largest_ = 0;
  int direction_ = 0, strokes_ = 0, alternating_ = 0;
  std::array<double, 2> before_{};  // the two strokes before, halves
  bool begun_ = false;
};

}  // namespace trunnion::drive
