// The speed stage: path speed, acceleration and jerk of every cycle, as fast as the cells ahead allow.
//
// A state (s, v, a) is safe when for every cell ahead the closed-form transition to its speed without acceleration
// fits into the distance to it, with the least ramp limits on the way, and the transition to a standstill fits
// before the end of the cells. From a safe state, braking keeps the state safe: the distance left shrinks exactly
// as the transition's own. Each cycle follows the wish (towards the programmed speed under the overrides, or to a
// standstill when held) for as long a part of the cycle as leaves a safe state, and brakes for the rest. So there is
// always a way to stop on the known path, whatever the overrides do, and limits are never traded for it.
#pragma once

#include <cstdint>
#include <optional>

#include "motion/limit_cell.hpp"
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

  const PathState& state() const { return state_; }
  bool standing() const { return state_.v == 0 && state_.a == 0; }
  std::uint64_t current_cell() const { return current_; }
  /// The first cell has been entered.
  bool started() const { return entered_; }
  /// Standing at a stop until its wait is over.
  bool waiting() const { return wait_ > 0; }
  /// At the end of the cells.
  bool at_end() const;
  /// A stop may overlap with the next stretch only while the one before is over.
  void allow_overlap(bool allowed) { overlap_allowed_ = allowed; }
  /// The tail that began in the last cycle, if any.
  std::optional<Tail> take_tail();
  /// Cycles in which no safe motion was found and the strongest braking was used instead. Always 0.
  std::uint64_t unsafe_cycles() const { return unsafe_; }

 private:
  /// The first thing ahead that a state would not be slow enough for.
  struct Obstacle {
    bool found = false;
    double speed = 0;
    RampLimits ramp;
    std::uint64_t cell = 0;
    bool end = false;  // of what is known of the path
  };
  struct Look {
    bool soft = true;  // programmed speeds count, not only limits
    double feed = 1, rapid = 1;
    double rounding = 0;  // mm by which a distance may be too short
  };
  struct Outcome {
    PathState state;
    std::uint64_t cell = 0;
    Obstacle obstacle;
  };

  double speed_of(const LimitCell& cell, const Look& look) const;
  RampLimits local_ramp(double speed, double reach) const;
  Transition wish(const Look& look, bool hold) const;
  Obstacle obstacle_ahead(const PathState& state, std::uint64_t cell, const Look& look) const;
  Outcome judge(const PathState& state, const Look& look) const;
  void move(const Transition& wished, const Look& look);
  bool follow(const Transition& wished, const Look& look, int depth);
  void accept(const Outcome& outcome);
  void arrive();
  void begin_tail();

  double cycle_;
  CellRing cells_;
  PathState state_;
  std::uint64_t current_ = 0;
  bool entered_ = false, finished_ = false;
  int wait_ = 0;
  std::optional<Obstacle> braking_for_;
  Overrides last_;
  bool overlap_allowed_ = true;
  std::optional<Tail> tail_;
  std::uint64_t unsafe_ = 0;
};

}  // namespace trunnion::motion
