// SPDX-License-Identifier: Apache-2.0
// A move of axes from where they are to a point: all begin and end together, with a quintic profile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trunnion::drive {

/// mm or deg: axes nearer than this to a point need not be moved there.
inline constexpr double on_path_distance = 1e-6;

/// s that an axis needs for `distance`: the largest speed of the profile is 1.875 d/T, its largest
/// acceleration 5.774 d/T^2. Velocity and acceleration are limits, in the unit of the distance.
double quintic_seconds(double distance, double velocity, double acceleration);

/// Positions are mm or deg, one of each axis.
class ReturnMove {
 public:
  /// Not cyclic.
  void configure(std::size_t axes) {
    from_.assign(axes, 0.0);
    to_.assign(axes, 0.0);
  }
  /// Takes `seconds`, rounded up to whole periods of `period` s.
  void start(const std::vector<double>& from, const std::vector<double>& to, double seconds, double period);
  /// One period: the places of the axes at its end. True at the end of the move.
  bool step(std::vector<double>& place);

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("return_from", self.from_), visit("return_to", self.to_);
    visit("return_periods", self.periods_), visit("return_done", self.done_);
  }

 private:
  std::vector<double> from_, to_;
  std::uint32_t periods_ = 0, done_ = 0;
};

}  // namespace trunnion::drive
