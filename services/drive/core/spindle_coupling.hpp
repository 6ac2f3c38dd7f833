// SPDX-License-Identifier: Apache-2.0
// The setpoint of one spindle: the speed the PLC demands, or an angle of the stream (tapping). Whether the
// spindle follows it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "drive_hardware.hpp"

namespace trunnion::drive {

/// Angles are revolutions, clockwise positive, turns counted; speeds 1/min.
class SpindleCoupling {
 public:
  /// `limit` of the following error, deg; 0 = none. Not cyclic.
  void configure(double limit) { limit_ = limit; }
  double limit() const { return limit_; }

  void demand_speed(double speed) { setpoint_.speed = speed; }

  /// The setpoint of the cycle that is executed, counted from where the spindle was at the first one:
  /// `angle`.
  void couple(double revolutions, double angle);
  void release() { setpoint_.coupled = false; }
  /// A share `phase` of the distance from that setpoint to the one of the next cycle.
  void lead(double phase, double next_revolutions);
  /// Continues at the speed of the last setpoint for `cycles`, when there is no next one.
  void lead_on(double cycles) { setpoint_.angle += cycles * change_; }

  const SpindleSetpoint& setpoint() const { return setpoint_; }
  /// rev from the setpoint of the cycle before to that of the cycle that is executed, while coupled.
  double change() const { return change_; }

  /// One period whose setpoint is in the row `number`; the row `in_force` counts, not the newest of a queue.
  /// Whether the spindle, which is at `angle`, begins to leave the path by more than the limit, or has not
  /// come back to it. While the drive brakes and resumes (not `whole`) the axes change their speed faster
  /// than a spindle can: then it has time to come back.
  bool does_not_follow(std::uint64_t number, std::uint64_t in_force, double angle, bool whole);
  /// deg by which it was behind its setpoint then; 0 while it follows none.
  double following_error() const { return error_; }

  /// No field, configure() sets it: limit_. No field, a row of a simulation is in force in its own period:
  /// rows_. No field, every period sets it: error_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("setpoint", self.setpoint_);
    visit("origin", self.origin_);
    visit("target", self.target_);
    visit("change", self.change_);
    // Written where there is something: other recordings have no such state.
    if (!std::is_const_v<Self> || self.returning_ > 0) visit("returning", self.returning_);
  }

 private:
  struct Row {
    std::uint64_t number = 0;
    bool coupled = false;
    double angle = 0;
  };
  static constexpr std::size_t most_rows = 64;  // more than hardware has in its queue
  /// Null when the spindle did not follow the path in it.
  const Row* row(std::uint64_t number) const;
  /// rev from `angle` to where the spindle should be; nothing while it follows no path.
  std::optional<double> deviation(std::uint64_t in_force, double angle) const;

  SpindleSetpoint setpoint_;
  double origin_ = 0, target_ = 0, change_ = 0;
  double limit_ = 0, error_ = 0;
  // Periods since the drive has braked or resumed, from 1, until the spindle is back; 0 = it is.
  std::uint32_t returning_ = 0;
  std::array<Row, most_rows> rows_{};
};

}  // namespace trunnion::drive
