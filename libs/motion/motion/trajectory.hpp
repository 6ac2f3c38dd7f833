// SPDX-License-Identifier: Apache-2.0
// Canonical commands in, one setpoint per cycle out.
#pragma once

#include <optional>

#include "canonical/canonical.hpp"
#include "geometry/chain.hpp"
#include "motion/blended_path.hpp"
#include "motion/cell_builder.hpp"
#include "motion/compressor.hpp"
#include "motion/interpolation.hpp"
#include "motion/limits.hpp"
#include "motion/move_taker.hpp"
#include "motion/planned_speed.hpp"
#include "motion/speed_stage.hpp"

namespace trunnion::motion {

/// One channel's motion: geometry, speed and interpolation in a row (docs/motion.md). Every machine axis
/// keeps its limits of velocity, acceleration and jerk under any overrides, and the path its tolerances.
/// Deterministic: the setpoints depend only on the calls and the cycle in which they were made. After
/// construction nothing allocates.
class Trajectory final : public MoveTaker {
 public:
  /// Executed blocks kept for retrace(): moves, or pieces of a short line, which seldom has more than one.
  static constexpr std::uint64_t history = 5000;

  /// `chain` is what Transformation::rtcp goes through; it must outlive the trajectory. nullptr: no
  /// transformation. `cycle_seconds` above 0.
  Trajectory(const Limits& limits, const geometry::Chain* chain, double cycle_seconds);

  /// At rest at `position` in the frame of `transformation`, with `tool_length` in mm. Drops everything
  /// pushed. A change of frame or tool length is: finish, wait for at_rest, start with the same place in the
  /// new frame.
  void start(const AxisValues& position, canonical::Transformation transformation,
             double tool_length) override;

  /// Other limits, from the next start() on.
  void set_limits(const Limits& limits);

  /// Room for at least one more command. Of a run of short lines some hundred are not yet on the path: the
  /// curve that replaces them depends on those behind them.
  bool can_accept() const override;

  /// Appends a rapid, line, arc or dwell in the frame given to start(). Motion begins as soon as enough is
  /// known. False, and nothing changed, when there is no room, or programmed_move() gives nothing. A move
  /// without length is accepted and does nothing. per_revolution feeds must have been converted to mm/min.
  bool push(const canonical::Command& command) override;

  /// Appends the rest of a command of which `fraction` (0..1) is done, from the end of what was pushed: a
  /// line from there to the target, an arc with the remaining sweep, a dwell of the remaining time.
  bool push_from(const canonical::Command& command, double fraction) override;

  /// Each move with PathControl::exact_stop that is pushed from now on is followed by a standstill of at most
  /// `cycles`, until end_position_check(); 0: it is not. start() sets 0.
  void set_position_check(int cycles) { position_check_ = cycles; }
  /// Cycles left of the standstill that the next step() continues, 0 when it is at none.
  int position_check_left() const { return retracing_ ? 0 : speed_.position_check_left(); }
  /// At such a standstill only: it is over, or lasts as long again.
  void end_position_check() { speed_.end_wait(); }
  void restart_position_check() { speed_.restart_wait(); }

  /// Nothing follows yet: lets the motion run to the end of the last command and stop there. Commands may
  /// be pushed afterwards; they start behind that stop.
  void finish() override;

  /// Brakes on the path and drops what is left. When at_rest, position() is where it stopped.
  void abort();

  /// Backwards along the executed path from the next standstill on, which step() brakes for; off: forwards
  /// again in the same way. Goes back over stops without their waits to the oldest block kept, at least
  /// `history` of them when the path since start() is that long, and stops there. Within all limits, at the
  /// programmed feeds under the overrides; setpoints name the moves they are on. While it is on the
  /// trajectory is never at rest; abort() ends it.
  void retrace(bool on) { retrace_wanted_ = on; }
  /// At standstill at the oldest move kept.
  bool retraced_to_start() const { return retracing_ && back_complete_ && back_.at_end(); }

  /// The next cycle. Overrides 0..1.5 (rapid 0..1), 0 or `hold` brake to a standstill on the path.
  Setpoint step(double feed_override, double rapid_override, bool hold);

  /// Everything pushed is done and the motion is not going back.
  bool at_rest() const;
  /// Last setpoint's position.
  const AxisValues& position() const { return interpolation_.position(); }
  /// End of everything pushed.
  const AxisValues& end_position() const override { return end_; }
  /// See SpeedStage::stopping_cycles.
  std::uint64_t stopping_cycles() const { return speed_.stopping_cycles(); }

 private:
  bool push_move(const canonical::Command& command, double fraction);
  void push_position_check(const canonical::Command& command);
  bool joins_to_last(const PathSegment& segment) const;
  void append(PathBlock block);
  void take_blocks();
  void flush();
  void plan();
  void restart_path();
  bool done() const;
  void reverse();
  void plan_back();
  const SpeedStage& moving() const { return retracing_ ? back_ : speed_; }
  std::uint64_t current_block() const;
  double current_s() const;

  BlendRules rules_of(const canonical::Command& command) const;
  void change_mode(const canonical::Command& command);

  double cycle_;
  ModeLimits limits_;
  const geometry::Chain* chain_;
  const geometry::Chain* active_chain_ = nullptr;
  double tool_length_ = 0;
  Compressor compressor_;  ///< blocks on their way to the path
  BlendedPath path_;
  CellBuilder builder_, back_builder_;
  SpeedStage speed_, back_;  ///< forwards, and backwards over the same path
  PlannedSpeed planned_;     ///< instead of speed_ on dense curves
  Interpolation interpolation_;
  AxisValues end_{}, joined_{};
  std::optional<PathBlock> pending_;  ///< a move too short to be worth a segment, until more follows
  std::uint8_t mode_ = 0;             ///< of the newest move
  BlendRules rules_;                  ///< and its tolerances
  bool curve_continues_ = false;      ///< the newest move was a piece of a curve
  bool stop_next_ = true, exact_next_ = true, aborting_ = false;
  int position_check_ = 0;  ///< cycles
  bool retrace_wanted_ = false, retracing_ = false, back_complete_ = false;
};

}  // namespace trunnion::motion
