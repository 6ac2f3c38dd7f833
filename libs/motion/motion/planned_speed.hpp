// SPDX-License-Identifier: Apache-2.0
// Moves along dense curves by plans of the speed optimiser, window after window.
#pragma once

#include <cstdint>

#include "motion/plan_braking.hpp"
#include "motion/speed_optimizer.hpp"
#include "motion/speed_plan.hpp"
#include "motion/speed_stage.hpp"

namespace trunnion::motion {

/// A plan in force always ends at a creeping speed from which the speed stage stops, so following it to its
/// end is the proved stop of every cycle. It is replaced from a place ahead on: when the path goes on, or
/// when an override changes. During a hold it is followed at a falling rate (PlanBraking). The stage takes
/// the motion back as soon as it proves a stop of its own: during a hold, near the end of a section, and
/// where no dense curve is near. Work is spread over cycles by count, so setpoints depend on the calls alone.
class PlannedSpeed {
 public:
  explicit PlannedSpeed(double cycle_seconds) : cycle_(cycle_seconds) {}

  void clear();
  bool active() const { return !plan_.empty(); }

  /// Moves `stage` one cycle on. False: the stage has to do it itself.
  bool step(SpeedStage& stage, const Overrides& overrides);

  /// After a cycle of the stage's own: begins a plan where a dense curve is near.
  void begin(SpeedStage& stage, const Overrides& overrides);

  /// Windows solved and not solved since construction.
  std::uint64_t solved() const { return solved_; }
  std::uint64_t failed() const { return failed_; }

 private:
  struct Demand {
    double feed = 1, rapid = 1;
    bool brake = false;
    bool operator==(const Demand&) const = default;
  };
  static Demand demand_of(const Overrides& overrides, const LimitCell& cell);
  bool is_near(const SpeedStage& stage, bool any_curve) const;
  void work(const SpeedStage& stage);
  void launch(const SpeedStage& stage, const Demand& demand);
  bool take(const SpeedStage& stage, std::size_t index);
  void slow_down(SpeedStage& stage, bool brake);
  void end(bool at_end);

  double cycle_;
  SpeedOptimizer optimizer_;
  SpeedPlan plan_;
  PlanBraking braking_;
  Demand demand_, asked_;                      // of the plan in force, of the one being made
  std::size_t start_ = 0;                      // piece that the one being made begins at
  std::uint64_t known_ = 0, asked_known_ = 0;  // cells that were known
  double left_ = 0;                            // s until the end of the plan
  bool reaches_end_ = false, drawn_ = false;
  int pause_ = 0;               // cycles until another attempt
  double blocked_to_ = -1e300;  // no plan before this coordinate, or the next standstill
  std::uint64_t solved_ = 0, failed_ = 0;
};

}  // namespace trunnion::motion
