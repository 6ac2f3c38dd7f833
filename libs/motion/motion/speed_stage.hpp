// SPDX-License-Identifier: Apache-2.0
// The speed stage: path speed, acceleration and jerk of every cycle, as fast as the cells ahead allow.
//
// Each cycle first follows the demanded transition: towards the programmed speed under the overrides, or to a
// standstill during a hold. It follows it only while every obstacle ahead (a slower cell, a stop, the end of
// the known path) remains reachable by the closed-form transition to its speed, and brakes for the rest of
// the cycle. A cycle is accepted only when it keeps the limits of every cell it runs over and when a stop
// that follows it has been proved to keep them too. Otherwise the stop proved in the cycle before is
// executed. So the limits hold for every sequence of overrides and do not depend on the demanded transition.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "motion/limit_cell.hpp"
#include "motion/pace.hpp"
#include "motion/phase_list.hpp"
#include "motion/transition.hpp"

namespace trunnion::motion {

/// Overrides of one cycle: 1 is as programmed. Values are clamped to 0..1.5 (rapid: 0..1); 0 holds.
struct Overrides {
  double feed = 1;
  double rapid = 1;
  bool hold = false;  ///< brake to a standstill on the path and stay there
};

/// The rest of a motion into a stop that the next stretch does not wait for: t seconds before its end it is
/// jerk t^3 / 6 away from it.
struct Tail {
  double end = 0;   ///< path coordinate of the stop
  double time = 0;  ///< s until it is reached
  double jerk = 0;
  std::uint64_t cell = 0;  ///< last cell of the stretch that ends
};

/// Deterministic and free of allocation in step().
class SpeedStage {
 public:
  explicit SpeedStage(double cycle_seconds) : cycle_(cycle_seconds) {}

  /// Forgets all cells; the next one starts at rest at the path coordinate 0.
  void clear();

  CellRing& cells() { return cells_; }
  const CellRing& cells() const { return cells_; }
  /// Cells were appended.
  void extended();
  /// The end of the cells is the end of the path.
  void set_finished(bool finished) { finished_ = finished; }
  bool finished() const { return finished_; }

  void step(const Overrides& overrides);

  /// Another plan has moved to `state`, forwards on the cells known and not over a stop.
  void place(const PathState& state);
  /// After place(): true when a stop from there is proved, so that step() may go on.
  bool take_over();
  /// A stop from `state` on the cells ahead is proved.
  bool stops_from(const PathState& state) const;

  const PathState& state() const { return state_; }
  bool at_standstill() const { return state_.v == 0 && state_.a == 0; }
  std::uint64_t current_cell() const { return current_; }
  /// Cells before this one will not be read again.
  std::uint64_t oldest_needed() const { return current_ > 4 ? current_ - 4 : 0; }
  /// The first cell has been entered.
  bool started() const { return entered_; }
  /// At standstill at a stop until its wait is over.
  bool waiting() const { return wait_ > 0; }
  /// Cycles left of a wait that end_wait() may end, 0 when there is none.
  int position_check_left() const { return wait_ > 0 && cells_[current_].position_check ? wait_ : 0; }
  void end_wait() { wait_ = 0; }
  void restart_wait() { wait_ = cells_[current_].wait_cycles; }
  /// At the end of the cells.
  bool at_end() const;
  /// A stop may overlap with the next stretch only while the one before is over.
  void allow_overlap(bool allowed) { overlap_allowed_ = allowed; }
  /// The tail that began in the last cycle, if any.
  std::optional<Tail> take_tail();
  /// Cycles in which the stop proved before was executed because no other cycle was accepted.
  std::uint64_t stopping_cycles() const { return stopping_; }

 private:
  /// The first place ahead that a state would reach too fast.
  struct Obstacle {
    bool found = false;
    double speed = 0;
    RampLimits ramp;
    std::uint64_t cell = 0;
    bool end = false;        // of what is known of the path
    bool momentary = false;  // only the acceleration has to be reduced
  };
  struct SpeedDemand {
    bool programmed = true;  // programmed speeds count, not only the limits of the cells
    double feed = 1, rapid = 1;
    double rounding = 0;  // mm by which a distance may be too short
  };
  struct Outcome {
    PathState state;
    std::uint64_t cell = 0;
    Obstacle obstacle;
  };

  /// A stop by way of a lower speed; 0: at once.
  struct StagedStop {
    double distance = 0, speed = 0;
  };

  static double stage_below(double speed) { return std::ldexp(1.0, std::ilogb(0.999 * speed)); }
  StagedStop staged_stop(const PathState& state, double highest, const RampLimits& ramp, std::uint64_t cell,
                         std::uint64_t last) const;
  double speed_of(const LimitCell& cell, const SpeedDemand& demand) const;
  RampLimits local_ramp(double speed, double reach) const;
  Transition demanded_transition(const SpeedDemand& demand, bool hold) const;
  Obstacle obstacle_ahead(const PathState& state, std::uint64_t cell, const SpeedDemand& demand) const;
  Outcome evaluate(const PathState& state, const SpeedDemand& demand) const;
  bool cruises(const Overrides& now, const SpeedDemand& demand);
  bool follow(const Transition& demanded, const SpeedDemand& demand, int depth);
  bool take_part(const Transition& demanded, const Obstacle& obstacle, double most, bool keep);
  void move(const Transition& demanded, const SpeedDemand& demand);
  bool accept(const PhaseList& action);
  bool find_stop(const PathState& state, std::uint64_t cell, PhaseList& stop) const;
  bool find_stop(const PathState& state, std::uint64_t cell, double stage, PhaseList& stop) const;
  double top_of(const LimitCell& cell, const SpeedDemand& demand) const;
  double stop_step(const PathState& state) const;
  bool needs_speed_profile(const SpeedDemand& demand) const;
  bool integrate_speed_profile(const SpeedDemand& demand, bool hold);
  void fill_cycle(PathState state, double time, double target, PhaseList& action) const;
  bool accept_curved(const PhaseList& action, const SpeedDemand& demand, Braked& why);
  bool find_curved_stop(const PathState& state, std::uint64_t cell, PhaseList& stop, Braked& why) const;
  std::optional<std::uint64_t> critical_cell(const PathState& state, std::uint64_t cell,
                                             const SpeedDemand& demand) const;
  bool start_gently(const SpeedDemand& demand);
  bool at_stop() const;
  void advance(const SpeedDemand& demand, bool hold);
  void follow_stop();
  void arrive();
  void begin_tail();

  double cycle_;
  CellRing cells_;
  PathState state_;
  std::uint64_t current_ = 0;
  bool entered_ = false, finished_ = false;
  int wait_ = 0;
  // While speed is constant: cells before clear_until_ allow clear_speed_ and braking from it with
  // clear_ramp_ takes clear_stop_ mm.
  std::uint64_t clear_until_ = 0;
  double clear_speed_ = 0, clear_stop_ = 0;
  RampLimits clear_ramp_;
  Overrides clear_overrides_;
  PhaseList stop_;         // the stop that is proved to keep all limits
  bool arriving_ = false;  // stop_ ends on a programmed stop: a search for a better one gains nothing
  std::optional<Obstacle> braking_for_;
  Overrides last_;
  bool overlap_allowed_ = true;
  std::optional<Tail> tail_;
  std::uint64_t stopping_ = 0;
};

}  // namespace trunnion::motion
