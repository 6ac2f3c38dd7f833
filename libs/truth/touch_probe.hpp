// SPDX-License-Identifier: Apache-2.0
// A touch-trigger probe in the spindle, whose ball is the tip of the tool.
#pragma once

#include <optional>

#include "truth/random_source.hpp"
#include "truth/solid.hpp"

namespace trunnion::truth {

struct TouchProbeTruth {
  double ball_radius = 3;    ///< mm
  double pre_travel = 0;     ///< mm that the ball moves on, against the surface, before the contact opens
  double lobing = 0;         ///< mm: amplitude by which the pre-travel changes three times around the probe
  double lobing_phase = 0;   ///< deg: direction of the largest pre-travel from +X
  double repeatability = 0;  ///< mm: standard deviation of the pre-travel
  double delay = 0;          ///< s from the contact's opening to its edge
  std::uint64_t seed = 1;
};

/// Pre-travel for a surface whose outward normal is `normal`, without the noise, mm. The lobes of the three
/// contacts act across the probe: along its axis (Z) there are none.
double pre_travel(const TouchProbeTruth& probe, const Vec3& normal);

class TouchProbe {
 public:
  explicit TouchProbe(const TouchProbeTruth& truth) : truth_(truth), random_(truth.seed) {}

  struct Edge {
    double share =
        0;  ///< of the motion from `from` to `to`, of the moment of the edge; above 1: in a later motion
    Vec3 contact = Vec3::Zero();  ///< tip when the ball touches the surface
  };
  /// The tip moves evenly from `from` to `to` in `duration` s (above zero). The ball must not begin inside of
  /// the surface. Nothing when it does not open the contact. Every touch draws one random number.
  std::optional<Edge> move(const Solid& solid, const Vec3& from, const Vec3& to, double duration);

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("random", self.random_);
  }

 private:
  TouchProbeTruth truth_;
  RandomSource random_;
};

}  // namespace trunnion::truth
