// SPDX-License-Identifier: Apache-2.0
// One servo axis as truth.yaml describes it: the control loops of ServoAxis, two masses, encoders of motor
// and load.
#pragma once

#include <optional>

#include "drive_hardware.hpp"
#include "loop_test.hpp"
#include "partner_input.hpp"
#include "servo_loop.hpp"
#include "truth/encoder.hpp"
#include "truth/two_mass.hpp"

namespace trunnion::drive {

class ElasticAxis {
 public:
  void configure(const truth::DriveTruth& truth, const ServoParameters& parameters);
  /// Is at rest there: the encoder of the position loop, if it is absolute, reads `position`.
  void place(double position);
  /// As ServoAxis::step().
  void step(const AxisSetpoint& setpoint, double dt, LoopTest* test = nullptr) {
    begin(setpoint, dt, test);
    for (int i = 0; i < servo_substeps; ++i) substep(i, {});
    end();
  }
  void begin(const AxisSetpoint& setpoint, double dt, LoopTest* test);
  void substep(int i, const PartnerInput& partner);
  void end();
  void run_out(RunOut way, double h, double force);
  void preload(double force) { loop_.preload(p_, plant_.holding_torque() - force); }
  void hold();
  /// From now on the readings are greater by `shift`; the axis stays where it is and has its reference.
  void set_reference(double shift);

  /// Feedback of the position loop in machine coordinates: of the encoder that closes it, or of both (dual
  /// loop).
  double encoder() const;
  /// Difference between the encoders of motor and load since place(), mm or deg; 0 without a load encoder.
  double encoder_difference() const;
  double load() const { return plant_.load(); }
  double velocity() const { return plant_.motor_speed(); }
  double torque() const { return loop_.torque() / p_.rated_torque; }
  double command() const { return command_; }
  double torque_command() const { return loop_.torque(); }
  double position_error() const { return position_error_; }
  void set_position_error(double error) { position_error_ = error; }
  double load_speed() const { return plant_.load_speed(); }
  double beam_position() const { return plant_.load(); }
  bool homed() const { return homed_; }
  std::uint64_t marks() const { return feedback_encoder().marks(); }
  /// Machine position at the newest mark.
  double mark_latch() const { return feedback_factor() * feedback_encoder().mark_latch() + offset_; }
  /// By how much the scale reads more than encoder(); nothing before two marks were passed.
  std::optional<double> scale_shift() const {
    const auto shift = feedback_encoder().reference();
    if (!shift) return std::nullopt;
    return feedback_factor() * (feedback_encoder().reading() + *shift) - encoder();
  }
  const truth::Encoder& motor_encoder() const { return motor_; }
  const truth::Encoder& load_encoder() const { return load_; }

  /// No fields, configure() sets them: p_, truth_, load_factor_. No fields, a period sets them and ends
  /// with them: dual_loop_time_, setpoint_, h_, start_velocity_, test_. No field, SimulatedAxis has it
  /// where it counts: position_error_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("loop", self.loop_), visit("plant", self.plant_);
    visit("motor_encoder", self.motor_), visit("load_encoder", self.load_);
    visit("slip", self.slip_), visit("difference", self.difference_);
    visit("command", self.command_), visit("offset", self.offset_), visit("homed", self.homed_);
  }

 private:
  bool full_closed() const { return p_.full_closed_loop; }
  const truth::Encoder& feedback_encoder() const { return full_closed() ? load_ : motor_; }
  double feedback_factor() const { return full_closed() ? load_factor_ : 1; }
  double load_reading() const { return load_factor_ * load_.reading(); }
  void read();

  ServoParameters p_;
  truth::DriveTruth truth_;
  truth::TwoMass plant_;
  truth::Encoder motor_, load_;
  ServoLoop loop_;
  double dual_loop_time_ = 0;         // s, in force
  double load_factor_ = 1;            // mm or deg per unit of the load encoder, with its sign
  double slip_ = 0, difference_ = 0;  // of the dual loop; of the encoders at place()
  double command_ = 0, offset_ = 0;
  bool homed_ = true;
  AxisSetpoint setpoint_;  // of the period that runs, as what follows
  double h_ = 0, start_velocity_ = 0, position_error_ = 0;
  LoopTest* test_ = nullptr;
};

}  // namespace trunnion::drive
