// SPDX-License-Identifier: Apache-2.0
// An axis of the simulation: a ServoAxis, or an ElasticAxis where truth.yaml has the drive of the axis.
#pragma once

#include <optional>

#include "elastic_axis.hpp"
#include "servo_axis.hpp"

namespace trunnion::drive {

class SimulatedAxis {
 public:
  /// `truth` is null where the axis has no drive in truth.yaml.
  void configure(const ServoParameters& parameters, const truth::DriveTruth* truth = nullptr) {
    servo_.configure(parameters);
    if (truth == nullptr) {
      elastic_.reset();
    } else {
      if (!elastic_) elastic_.emplace();
      elastic_->configure(*truth, parameters);
    }
  }
  void place(double position) { elastic_ ? elastic_->place(position) : servo_.place(position); }
  void step(const AxisSetpoint& setpoint, double dt) {
    elastic_ ? elastic_->step(setpoint, dt) : servo_.step(setpoint, dt);
  }
  void hold() { elastic_ ? elastic_->hold() : servo_.hold(); }
  void set_reference(double shift) {
    elastic_ ? elastic_->set_reference(shift) : servo_.place(servo_.command() + shift);
  }

  double encoder() const { return elastic_ ? elastic_->encoder() : servo_.encoder(); }
  double load() const { return elastic_ ? elastic_->load() : servo_.load(); }
  double velocity() const { return elastic_ ? elastic_->velocity() : servo_.velocity(); }
  double torque() const { return elastic_ ? elastic_->torque() : servo_.torque(); }
  double command() const { return elastic_ ? elastic_->command() : servo_.command(); }
  bool homed() const { return !elastic_ || elastic_->homed(); }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    if (self.elastic_)
      visit("elastic", *self.elastic_);
    else
      ServoAxis::fields(self.servo_, visit);
  }

 private:
  ServoAxis servo_;
  std::optional<ElasticAxis> elastic_;
};

}  // namespace trunnion::drive
