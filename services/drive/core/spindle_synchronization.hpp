// SPDX-License-Identifier: Apache-2.0
// The control of a spindle that follows another one, its master: the speed that keeps it at the angle of the
// master (docs/spindles.md).
#pragma once

#include <cstdint>
#include <limits>

#include "contracts/types.hpp"
#include "drive_hardware.hpp"
#include "machine/parameters.hpp"
#include "spindle_ramp.hpp"

namespace trunnion::drive {

/// Of the slave.
struct SynchronizationSettings {
  double gain = 500;           ///< K0, 1/min for each rev of error: 10a975
  double integral_time = 500;  ///< Ti, ms: 10a976
  double phase_lead = 0;       ///< F: 10a977; 0 = none
  double window = 1;           ///< deg: 10a974
  double speed_window = 5;     ///< % of the master's speed, at least 5 1/min: 10a970
  RampSettings ramp;
};
/// Of the spindle with a logical number.
SynchronizationSettings synchronization_settings(const machine::Parameters& parameters,
                                                 std::uint16_t spindle);

/// s: Tbv, the time constant of the slave's speed loop at `speed` (1/min, of either sign). It is 1 / (2 K0)
/// up to the base speed and grows above it as the acceleration falls; constant without a base speed.
double speed_loop_lag(const SynchronizationSettings& settings, double speed);

/// How the slave is to follow.
struct SynchronizationOrder {
  bool reverse = false;  ///< the other way round
  double angle = 0;      ///< rev: the slave is at (master + angle), with reverse at -(master + angle)
  idl::plc::IntegralAction integral = idl::plc::IntegralAction::INTEGRAL_NONE;
  double highest = std::numeric_limits<double>::infinity();  ///< 1/min: it runs up to no more than that
};

struct MasterMotion {
  double reference = 0;  ///< 1/min: the speed its drive is given now
  double speed = 0;      ///< 1/min, measured
  double angle = 0;      ///< rev, measured, turns counted
};

/// The slave first takes the speed of its master within its own acceleration. Then the loop is closed, on
/// the nearest turn, and counts turns from there.
class SpindleSynchronization {
 public:
  /// `period` s. Not cyclic.
  void configure(const SynchronizationSettings& settings, double period);
  /// In place of that of the settings, until the next configure().
  void use_ramp(const RampSettings& ramp) { settings_.ramp = ramp; }
  /// From the speed that the slave has, 1/min.
  void begin(double speed);
  void end();
  /// One period: the speed reference of the slave, 1/min. Call it between begin() and end().
  double step(const SynchronizationOrder& order, const MasterMotion& master, const SpindleStatus& slave);

  bool active() const { return active_; }
  /// It has had the speed of its master and counts turns: a part may hold both.
  bool closed() const { return closed_; }
  /// The loop is closed, and the error is within the window.
  bool synchronized() const;
  /// Once, when a spindle that was synchronized is more than half a turn off.
  bool take_lost();
  /// rev: where the slave should be less where it is; the nearest turn while the loop is open.
  double error() const { return error_; }
  /// 1/min, of the integral action.
  double correction() const { return integral_; }
  /// 1/min: what step() gave.
  double reference() const { return reference_; }

  /// No fields, configure() sets them: settings_, period_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("active", self.active_), visit("closed", self.closed_), visit("limited", self.limited_);
    visit("was_synchronized", self.was_synchronized_), visit("lost", self.lost_);
    visit("reference", self.reference_), visit("turns", self.turns_), visit("angle", self.angle_);
    visit("error", self.error_), visit("lagging", self.lagging_), visit("integral", self.integral_);
    visit("control", self.control_);
  }

 private:
  void run_up(double wanted);
  void count_turns_from(double deviation, double wanted);
  double within_braking(double error, double speed) const;
  double lead(double error, double speed);
  void integrate(idl::plc::IntegralAction action);
  void control(double wanted, idl::plc::IntegralAction action);

  SynchronizationSettings settings_;
  double period_ = 0.001;
  bool active_ = false, closed_ = false;
  bool limited_ = false;           // the control wanted to change faster than the spindle can
  bool was_synchronized_ = false;  // since the loop was closed or its angle was changed
  bool lost_ = false;
  double reference_ = 0;               // 1/min
  double turns_ = 0, angle_ = 0;       // whole turns left out of the error; ordered angle that they belong to
  double error_ = 0, lagging_ = 0;     // rev; the error behind the delay of the phase lead
  double integral_ = 0, control_ = 0;  // 1/min; everything that is added to the master's reference
};

}  // namespace trunnion::drive
