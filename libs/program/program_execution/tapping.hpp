// SPDX-License-Identifier: Apache-2.0
// Rigid tapping: the spindle follows the tool's path into the hole and out of it through the same stream of
// setpoints, so that both keep the lead through every acceleration, reversal and stop on the path.
#pragma once

#include <cstddef>

#include "language/canonical.hpp"
#include "motion/limits.hpp"

namespace trunnion::program_execution {

using language::AxisValues;

class Tapping {
 public:
  /// Of the spindle: as far as the override goes, a tap keeps to the acceleration that the spindle has.
  static constexpr double highest_override = 1.5;

  /// The first stroke of a hole, of kind tap, begins at `start`. Its direction is that into the hole, in X Y
  /// Z, or in U V W when those rest. The spindle turns at most at `highest_speed`, 1/min; 0 = no limit.
  void begin(const AxisValues& start, const language::Command& stroke, double highest_speed = 0);
  void end() { active_ = false, axis_ = 0; }
  bool active() const { return active_; }
  /// The tapping axis, as Command::number of the stroke; 0 when none is active.
  std::uint32_t axis() const { return axis_; }
  double highest_speed() const { return highest_speed_; }
  /// 1/min that the spindle may reach in the hole that begins with `stroke`, with every override; `highest`
  /// is its limit, 0 = none.
  static double fastest(const language::Command& stroke, double highest);
  /// The spindle's angle that belongs to `position`: revolutions since begin(), clockwise positive.
  double revolutions(const AxisValues& position) const;
  /// `limits` within which the spindle, of `acceleration` degrees/s^2, can follow.
  motion::Limits limits(motion::Limits limits, double acceleration) const;
  /// The override of a hole: `wanted`, or less so that the spindle, whose fastest stroke is at `speed`, does
  /// not turn faster than `highest`; 1/min, 0 = no limit.
  static double override_of(double wanted, double speed, double highest);
  /// A stroke as the line the axes make: at lead times the speed of the spindle, to an exact stop.
  static language::Command line(language::Command stroke);

 private:
  bool active_ = false;
  std::uint32_t axis_ = 0;
  AxisValues start_{};
  std::size_t first_ = language::X;  // of the three axes that direction_ is along, X or U
  language::Vector3 direction_{};
  double lead_ = 1;  // mm per revolution, negative for a left-hand thread
  double highest_speed_ = 0;
  bool along_axis_ = false;
};

}  // namespace trunnion::program_execution
