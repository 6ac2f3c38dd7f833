// SPDX-License-Identifier: Apache-2.0
// The interpolation stage: from a place on the path to the setpoints of the axes in that cycle.
#pragma once

#include <optional>

#include "motion/blended_path.hpp"
#include "motion/speed_stage.hpp"

namespace trunnion::motion {

/// What one cycle commands, and where in the program that is.
struct Setpoint {
  AxisValues position{};        ///< in the frame of the path: machine axes, or tool tip and rotary axes
  AxisValues distance_to_go{};  ///< to the end of the command, per axis
  std::uint32_t line = 0;       ///< of the command being executed, 0 before the first
  std::uint32_t sequence = 0;
  double fraction = 0;          ///< of that command completed, 0..1
  double feed = 0;              ///< speed of X Y Z in that frame, mm/s
  double path_speed = 0;        ///< mm/s (deg/s when only rotary axes move)
  double programmed_speed = 0;  ///< of the path at override 1, likewise; 0: none, as of a rapid
  bool rapid = false;
  bool dwelling = false;  ///< at standstill between segments: dwell or exact stop
  bool at_rest = true;    ///< everything pushed is done
};

/// Where a speed stage has brought the motion to in one cycle.
struct PathPlace {
  std::uint64_t block = 0;
  double s = 0;          ///< path coordinate on that block
  double speed = 0;      ///< of the path, unit/s
  bool started = false;  ///< the path has been entered: before, the axes stay at rest
  bool waiting = false;  ///< at standstill at the start of the block until its wait is over
};

/// Keeps from earlier cycles the last position (for the speed of X Y Z), the command it was on, and the rest
/// of a motion into a stop that the next section has not waited for. The same for motion forwards and
/// backwards. Deterministic and free of allocation.
class Interpolation {
 public:
  /// `cycle_seconds` above 0.
  explicit Interpolation(double cycle_seconds) : cycle_(cycle_seconds) {}

  /// At rest at `position`, before any command.
  void start(const AxisValues& position);

  /// A cycle passes: the tail comes nearer to its stop, and at it is over.
  void pass_cycle();
  /// The motion into the stop at the end of `block` is over `tail.time` seconds from now.
  void begin_tail(const Tail& tail, std::uint64_t block) { tail_ = {tail, block}; }
  void drop_tail() { tail_.reset(); }
  /// A tail is still added to what the place commands.
  bool overlapping() const { return tail_.has_value(); }

  /// What the cycle commands: position and progress at `place`, whose block `path` still has, and the rest of
  /// the tail. The caller sets `at_rest`.
  Setpoint follow(const BlendedPath& path, const PathPlace& place);
  /// The same without a path: the axes stay at rest.
  Setpoint stay();

  /// Last setpoint's position.
  const AxisValues& position() const { return position_; }

 private:
  struct RunningTail {
    Tail motion;
    std::uint64_t block = 0;
  };

  double cycle_;
  AxisValues position_{};
  std::uint32_t line_ = 0, sequence_ = 0;
  double fraction_ = 0;
  std::optional<RunningTail> tail_;
};

}  // namespace trunnion::motion
