// SPDX-License-Identifier: Apache-2.0
// An axis of the simulation: a ServoAxis, or an ElasticAxis where truth.yaml has the drive of the axis.
#pragma once

#include <optional>
#include <type_traits>

#include "elastic_axis.hpp"
#include "servo_axis.hpp"

namespace trunnion::drive {

class SimulatedAxis {
 public:
  /// `truth` is null where the axis has no drive in truth.yaml; in full closed loop it has a load encoder all
  /// the same.
  void configure(const ServoParameters& parameters, const truth::DriveTruth* truth = nullptr) {
    servo_.configure(parameters);
    if (truth == nullptr && !parameters.full_closed_loop) {
      elastic_.reset();
    } else {
      if (!elastic_) elastic_.emplace();
      elastic_->configure(truth != nullptr ? *truth : truth::DriveTruth{}, parameters);
    }
  }
  /// The compensation of its gantry begins with the position error of the period before.
  void keep_position_error(bool kept) { keeps_position_error_ = kept; }
  void place(double position) { elastic_ ? elastic_->place(position) : servo_.place(position); }
  /// `test`: of this axis, or null.
  void step(const AxisSetpoint& setpoint, double dt, LoopTest* test = nullptr) {
    elastic_ ? elastic_->step(setpoint, dt, test) : servo_.step(setpoint, dt, test);
  }
  void begin(const AxisSetpoint& setpoint, double dt, LoopTest* test) {
    elastic_ ? elastic_->begin(setpoint, dt, test) : servo_.begin(setpoint, dt, test);
  }
  void substep(int i, const PartnerInput& partner) {
    elastic_ ? elastic_->substep(i, partner) : servo_.substep(i, partner);
  }
  void end() { elastic_ ? elastic_->end() : servo_.end(); }
  void run_out(RunOut way, double h, double force) {
    elastic_ ? elastic_->run_out(way, h, force) : servo_.run_out(way, h, force);
  }
  void preload(double force) { elastic_ ? elastic_->preload(force) : servo_.preload(force); }
  void hold() { elastic_ ? elastic_->hold() : servo_.hold(); }
  void set_reference(double shift) {
    elastic_ ? elastic_->set_reference(shift) : servo_.place(servo_.command() + shift);
  }

  double encoder() const { return elastic_ ? elastic_->encoder() : servo_.encoder(); }
  double load() const { return elastic_ ? elastic_->load() : servo_.load(); }
  double velocity() const { return elastic_ ? elastic_->velocity() : servo_.velocity(); }
  double torque() const { return elastic_ ? elastic_->torque() : servo_.torque(); }
  double command() const { return elastic_ ? elastic_->command() : servo_.command(); }
  double torque_command() const { return elastic_ ? elastic_->torque_command() : servo_.torque_command(); }
  double position_error() const { return elastic_ ? elastic_->position_error() : servo_.position_error(); }
  double load_speed() const { return elastic_ ? elastic_->load_speed() : servo_.load_speed(); }
  double beam_position() const { return elastic_ ? elastic_->beam_position() : servo_.beam_position(); }
  std::uint64_t marks() const { return elastic_ ? elastic_->marks() : 0; }
  double mark_latch() const { return elastic_ ? elastic_->mark_latch() : 0; }
  std::optional<double> scale_shift() const {
    return elastic_ ? elastic_->scale_shift() : std::optional<double>();
  }
  double encoder_difference() const { return elastic_ ? elastic_->encoder_difference() : 0; }
  bool homed() const { return !elastic_ || elastic_->homed(); }

  /// No field, configure() of the hardware sets it: keeps_position_error_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    if (self.elastic_)
      visit("elastic", *self.elastic_);
    else
      ServoAxis::fields(self.servo_, visit);
    double error = self.position_error();
    if (!std::is_const_v<Self> || self.keeps_position_error_) visit("position_error", error);
    if constexpr (!std::is_const_v<Self>)
      self.elastic_ ? self.elastic_->set_position_error(error) : self.servo_.set_position_error(error);
  }

 private:
  ServoAxis servo_;
  std::optional<ElasticAxis> elastic_;
  bool keeps_position_error_ = false;
};

}  // namespace trunnion::drive
