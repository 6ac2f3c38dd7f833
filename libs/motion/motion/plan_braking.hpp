// SPDX-License-Identifier: Apache-2.0
// Braking along a plan of the speed: the plan is followed at a rate that falls from 1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/axis_limits.hpp"
#include "motion/speed_plan.hpp"
#include "motion/speed_stage.hpp"

namespace trunnion::motion {

/// The motion at a cycle is the plan's motion q at the plan's time T, which passes at the rate r = dT/dt from
/// 0 to 1. So an axis has the acceleration r^2 q'' + r' q' and the jerk r^3 q''' + 3 r r' q'' + r'' q'
/// (primes of q by T, of r by t). Both limits are linear in r'', which is constant for half a cycle. A
/// constant rate keeps every limit that the plan keeps. So each cycle brakes as much as leaves a proved
/// return to a constant rate, and where no braking leaves one, the return proved before is followed. Nothing
/// allocates after construction.
class PlanBraking {
 public:
  PlanBraking();

  void clear() { active_ = false; }
  bool active() const { return active_; }
  /// Begins at the state of `stage` on the piece `plan.current()`, at the rate 1.
  void start(const SpeedPlan& plan, const SpeedStage& stage);
  /// The next cycle of `cycle` seconds: brakes, or without `brake` returns to a constant rate. Moves `plan`
  /// along. The return value is the motion along the path at the end of the cycle.
  PathState step(SpeedPlan& plan, const SpeedStage& stage, double cycle, bool brake);
  double rate() const { return now_.rate; }
  bool constant() const { return now_.slope == 0; }
  /// Time on the plan that the last cycle has taken, s.
  double plan_time() const { return passed_; }

 private:
  static constexpr std::size_t ring = 1024, most_steps = 256;
  /// Of one axis on the plan: speed and acceleration as shares of the limits of acceleration and jerk (s),
  /// jerk.
  struct AxisSample {
    double speed_a = 0, acceleration_a = 0, speed_j = 0, acceleration_j = 0, jerk_j = 0;
  };
  struct Sample {
    double time = 0;  ///< on the plan, s from the start
    std::array<AxisSample, LimitCell::most_axes> axes;
    int count = 0;
  };
  struct Rate {
    double time = 0;  ///< on the plan
    double rate = 1, slope = 0;
  };
  void sample(const SpeedPiece& piece, const LimitCell& cell);
  void fill(const SpeedPlan& plan, const CellRing& cells, double until);
  bool range(const Rate& at, double half, std::uint64_t& first, Range& bend) const;
  bool proves(double share, double half, const SpeedPlan& plan, const SpeedStage& stage);
  static Rate after(const Rate& at, double bend, double time);

  bool active_ = false;
  Rate now_;
  PathState on_plan_;
  double passed_ = 0;
  std::vector<Sample> samples_;           // of the plan, in a ring
  std::uint64_t first_ = 0, filled_ = 0;  // the last one that has been passed, and all so far
  struct {
    double time = 0;
    PathState state;
    std::size_t piece = 0;
    std::uint64_t cell = 0;
  } fill_;                              // the next one
  std::vector<double> return_, tried_;  // r'' of each half cycle until the rate is constant
  std::size_t returned_ = 0;            // of them done
};

}  // namespace trunnion::motion
