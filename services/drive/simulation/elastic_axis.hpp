// SPDX-License-Identifier: Apache-2.0
// One servo axis as truth.yaml describes it: the control loops of ServoAxis, two masses, encoders of motor
// and load.
#pragma once

#include <optional>

#include "servo_loop.hpp"
#include "truth/encoder.hpp"
#include "truth/two_mass.hpp"

namespace trunnion::drive {

struct AxisSetpoint;

class ElasticAxis {
 public:
  void configure(const truth::DriveTruth& truth, const ServoParameters& parameters);
  /// Is at rest there: the encoder of the position loop, if it is absolute, reads `position`.
  void place(double position);
  /// As ServoAxis::step().
  void step(const AxisSetpoint& setpoint, double dt);
  void hold();
  /// From now on the readings are greater by `shift`; the axis stays where it is and has its reference.
  void set_reference(double shift);

  double encoder() const;  ///< of the position loop, in machine coordinates
  double load() const { return plant_.load(); }
  double velocity() const { return plant_.motor_speed(); }
  double torque() const { return loop_.torque() / p_.rated_torque; }
  double command() const { return command_; }
  bool homed() const { return homed_; }
  const truth::Encoder& motor_encoder() const { return motor_; }
  const truth::Encoder& load_encoder() const { return load_; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("loop", self.loop_), visit("plant", self.plant_);
    visit("motor_encoder", self.motor_), visit("load_encoder", self.load_);
    visit("command", self.command_), visit("offset", self.offset_), visit("homed", self.homed_);
  }

 private:
  static constexpr int substeps = 8;
  const truth::Encoder& feedback() const { return truth_.load_feedback ? load_ : motor_; }
  void read();

  ServoParameters p_;
  truth::DriveTruth truth_;
  truth::TwoMass plant_;
  truth::Encoder motor_, load_;
  ServoLoop loop_;
  double command_ = 0, offset_ = 0;
  bool homed_ = true;
};

}  // namespace trunnion::drive
