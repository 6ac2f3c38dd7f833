// SPDX-License-Identifier: Apache-2.0
// One servo axis: position P, speed PI, current lag, motor and load inertia, friction, limits, encoder.
// Everything is in units of the load: mm or deg, and torque as the acceleration it gives the nominal inertia.
#pragma once

#include "drive_hardware.hpp"
#include "loop_test.hpp"
#include "partner_input.hpp"
#include "servo_loop.hpp"

namespace trunnion::drive {

class ServoAxis {
 public:
  void configure(const ServoParameters& parameters) { p_ = parameters; }
  /// Is at rest at `position`, as an absolute encoder finds it.
  void place(double position);
  /// One period of `dt` seconds: the command moves from where it was to the position of `setpoint`, with its
  /// acceleration. `test`: of this axis, or null.
  void step(const AxisSetpoint& setpoint, double dt, LoopTest* test = nullptr) {
    begin(setpoint, dt, test);
    for (int i = 0; i < servo_substeps; ++i) substep(i, {});
    end();
  }
  /// The same in parts, for axes that act on each other: one period of the speed loop each.
  void begin(const AxisSetpoint& setpoint, double dt, LoopTest* test);
  void substep(int i, const PartnerInput& partner);
  void end();
  /// One period of the speed loop of `h` s without control, until it is at rest.
  void run_out(RunOut way, double h, double force);
  /// At rest: the torque holds `force` of the beam.
  void preload(double force) { loop_.preload(p_, -force); }
  /// Drives off: the brake holds the axis where it is.
  void hold();

  double encoder() const { return encoder_; }                         ///< quantized motor position, mm or deg
  double load() const { return load_; }                               ///< true position behind the backlash
  double velocity() const { return velocity_; }                       ///< mm/s or deg/s
  double torque() const { return loop_.torque() / p_.rated_torque; }  ///< share of the rated torque
  double command() const { return command_; }
  double torque_command() const { return loop_.torque(); }
  double position_error() const { return position_error_; }  ///< in the newest period of the speed loop
  void set_position_error(double error) { position_error_ = error; }
  double load_speed() const { return velocity_; }
  double beam_position() const { return position_; }

  /// No field, configure() sets it: p_. No fields, a period sets them: setpoint_, h_, start_velocity_,
  /// test_. No field, SimulatedAxis has it where it counts: position_error_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("command", self.command_);
    visit("position", self.position_);
    visit("velocity", self.velocity_);
    ServoLoop::fields(self.loop_, visit);
    visit("encoder", self.encoder_);
    visit("load", self.load_);
  }

 private:
  double friction() const;
  void read();

  ServoParameters p_;
  ServoLoop loop_;
  double command_ = 0, position_ = 0, velocity_ = 0;
  AxisSetpoint setpoint_;  // of the period that runs, as the rest of this line
  double h_ = 0, start_velocity_ = 0, position_error_ = 0;
  LoopTest* test_ = nullptr;
  double encoder_ = 0, load_ = 0;
};

}  // namespace trunnion::drive
