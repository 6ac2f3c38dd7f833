// Canonical commands in, one setpoint per cycle out.
#pragma once

#include "geometry/chain.hpp"
#include "language/canonical.hpp"
#include "motion/interpolator.hpp"
#include "motion/limits.hpp"
#include "motion/speed_planner.hpp"

namespace trunnion::motion {

/// What one cycle commands, and where in the program that is.
struct Setpoint {
  AxisValues position{};        ///< in the frame given to start(): machine axes, or tool tip and rotary axes
  AxisValues distance_to_go{};  ///< to the end of the command, per axis
  std::uint32_t line = 0;       ///< of the command being executed, 0 before the first
  std::uint32_t sequence = 0;
  double fraction = 0;  ///< of that command completed by the path point, 0..1; T/2 ahead of `position`
  double feed = 0;      ///< speed of X Y Z in that frame, mm/s
  double path_speed =
      0;  ///< speed of the path point before smoothing, mm/s (deg/s when only rotary axes move)
  bool rapid = false;
  bool dwelling = false;  ///< standing between segments: dwell or exact stop
  bool at_rest = true;    ///< everything pushed is done and the smoothing has settled
};

/// One channel's motion: geometry, speed and interpolation in a row. Deterministic: the setpoints depend only
/// on the calls and the cycle in which they were made. After construction nothing allocates.
class Trajectory {
 public:
  /// `chain` is what Transformation::rtcp goes through; it must outlive the trajectory. nullptr: no
  /// transformation. `cycle_seconds` above 0.
  Trajectory(const Limits& limits, const geometry::Chain* chain, double cycle_seconds);

  /// Stand still at `position` in the frame of `transformation`, with `tool_length` in mm. Drops everything
  /// pushed. A change of frame or tool length is: finish, wait for at_rest, start with the same place in the
  /// new frame.
  void start(const AxisValues& position, language::Transformation transformation, double tool_length);

  /// Room for at least one more command.
  bool can_accept() const { return planner_.can_accept(); }

  /// Appends a rapid, line, arc or dwell in the frame given to start(). Motion begins as soon as enough is
  /// known. False, and nothing changed, when there is no room, the kind is another, or the numbers make no
  /// move (not finite, feed or sweep not above 0). A move without length is accepted and does nothing.
  /// per_revolution feeds must have been converted to mm/min.
  bool push(const language::Command& command);

  /// Appends what is left of a command of which `fraction` (0..1) is done, from the end of what was pushed: a
  /// line from there to the target, an arc with the remaining sweep, a dwell of the remaining time.
  bool push_from(const language::Command& command, double fraction);

  /// Nothing follows yet: lets the motion run to the end of the last command and stop there. Commands may
  /// be pushed afterwards; they start behind that stop.
  void finish() { planner_.finish(); }

  /// Brakes on the path and drops what is left. When at_rest, position() is where it stopped.
  void abort() { planner_.abort(); }

  /// The next cycle. Overrides 0..1.5 (rapid 0..1), 0 or `hold` brake to a standstill on the path.
  Setpoint step(double feed_override, double rapid_override, bool hold);

  bool at_rest() const;
  /// Last setpoint's position.
  const AxisValues& position() const { return output_; }
  /// End of everything pushed.
  const AxisValues& end_position() const { return end_; }
  /// Path point before smoothing, where an abort would be measured from.
  const AxisValues& path_position() const { return path_; }

 private:
  bool push_move(const language::Command& command, double fraction);

  double cycle_;
  const geometry::Chain* chain_;
  const geometry::Chain* active_chain_ = nullptr;
  double tool_length_ = 0;
  CornerRules rules_;
  SpeedPlanner planner_;
  Interpolator interpolator_;
  AxisValues end_{}, path_{}, output_{};
  std::uint32_t line_ = 0, sequence_ = 0;
  bool stop_next_ = false;
  int settled_cycles_ = 0;
  double fraction_ = 0;
};

}  // namespace trunnion::motion
