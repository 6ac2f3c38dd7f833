// SPDX-License-Identifier: Apache-2.0
#include "spindle_synchronization.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

using idl::plc::IntegralAction;

SynchronizationSettings synchronization_settings(const machine::Parameters& parameters,
                                                 std::uint16_t spindle) {
  return {parameters.get(parameter::synchronization_gain, spindle),
          parameters.get(parameter::synchronization_integral_time, spindle),
          parameters.get(parameter::synchronization_phase_lead, spindle),
          parameters.get(parameter::synchronization_window, spindle),
          parameters.get(parameter::speed_window, spindle),
          ramp_settings(parameters, spindle)};
}

namespace {

constexpr double degrees_of_turn = 360, seconds_in_minute = 60, milliseconds_in_second = 1000;
constexpr double least_speed_match = 5;        // 1/min
constexpr double lost_error = 0.5;             // rev
constexpr double most_integrated = 0.25;       // rev: a larger error is still being approached
constexpr double approach_acceleration = 0.5;  // share of the slave's, with which it can brake an error off

double stepped_towards(double from, double to, double most) {
  return std::abs(to - from) <= most ? to : from + std::copysign(most, to - from);
}

// 1/min in a period of `period` s: 6 deg/s are 1 1/min.
double reference_step(const RampSettings& ramp, double speed, double period) {
  return acceleration_at(ramp, speed) / 6 * period;
}

}  // namespace

double speed_loop_lag(const SynchronizationSettings& settings, double speed) {
  const double base_lag = 0.5 / (settings.gain / seconds_in_minute);
  const double at = std::abs(speed), base = settings.ramp.base_speed, power = settings.ramp.power_speed;
  if (base <= 0 || at <= base) return base_lag;
  return power < base || at <= power ? base_lag * (at / base) : base_lag * (at / base) * (at / power);
}

void SpindleSynchronization::configure(const SynchronizationSettings& settings, double period) {
  settings_ = settings;
  period_ = period;
}

void SpindleSynchronization::begin(double speed) {
  end();
  active_ = true;
  reference_ = speed;
}

void SpindleSynchronization::end() {
  active_ = closed_ = limited_ = was_synchronized_ = lost_ = false;
  reference_ = turns_ = angle_ = error_ = lagging_ = integral_ = control_ = 0;
}

double SpindleSynchronization::step(const SynchronizationOrder& order, const MasterMotion& master,
                                    const SpindleStatus& slave) {
  const double sign = order.reverse ? -1 : 1;
  const double wanted = sign * master.reference;
  const double deviation = sign * (master.angle + order.angle) - slave.angle;
  if (!closed_) {
    run_up(std::clamp(wanted, -order.highest, order.highest));
    count_turns_from(deviation, wanted);
    angle_ = order.angle;
    const double tolerance =
        std::max(least_speed_match, settings_.speed_window / 100 * std::abs(master.speed));
    closed_ = reference_ == wanted && std::abs(slave.speed - sign * master.speed) <= tolerance;
    return reference_;
  }
  if (order.angle != angle_) {  // another angle: by the shorter way
    count_turns_from(deviation, wanted);
    angle_ = order.angle;
    was_synchronized_ = false;
  }
  error_ = deviation - turns_;
  control(wanted, order.integral);
  reference_ = wanted + control_;
  if (synchronized()) was_synchronized_ = true;
  if (was_synchronized_ && std::abs(error_) > lost_error) was_synchronized_ = false, lost_ = true;
  return reference_;
}

void SpindleSynchronization::run_up(double wanted) {
  reference_ = stepped_towards(reference_, wanted, reference_step(settings_.ramp, reference_, period_));
}

void SpindleSynchronization::count_turns_from(double deviation, double wanted) {
  turns_ = std::round(deviation);
  error_ = deviation - turns_;
  lagging_ = within_braking(error_, wanted);
}

// Of a large error only as much as leads to a speed from which the slave still brakes before its angle.
double SpindleSynchronization::within_braking(double error, double speed) const {
  const double deceleration =
      approach_acceleration * acceleration_at(settings_.ramp, speed) / degrees_of_turn;
  const double fastest = std::sqrt(2 * deceleration * std::abs(error));  // rev/s
  return std::copysign(std::min(std::abs(error), fastest * seconds_in_minute / settings_.gain), error);
}

// (1 + Tbv p) / (1 + T p) with T = Tbv0 / F is Tbv / T at once and the rest behind a delay of T, which is
// discrete by backward Euler: no pole of it is negative, however short T is.
double SpindleSynchronization::lead(double error, double speed) {
  if (settings_.phase_lead <= 0) return error;
  const double delay = speed_loop_lag(settings_, 0) / settings_.phase_lead;
  const double at_once = speed_loop_lag(settings_, speed) / delay;
  lagging_ = (delay * lagging_ + period_ * error) / (delay + period_);
  return at_once * error + (1 - at_once) * lagging_;
}

// Backward Euler. What the spindle cannot follow is not integrated; more than the gain gives for half a turn
// is no steady error any longer.
void SpindleSynchronization::integrate(IntegralAction action) {
  if (action == IntegralAction::INTEGRAL_NONE) integral_ = 0;
  if (action != IntegralAction::INTEGRAL_ACTIVE || limited_ || std::abs(error_) > most_integrated) return;
  const double most = settings_.gain * lost_error;
  integral_ += settings_.gain * error_ * (period_ * milliseconds_in_second / settings_.integral_time);
  integral_ = std::clamp(integral_, -most, most);
}

void SpindleSynchronization::control(double wanted, IntegralAction action) {
  const double led = lead(within_braking(error_, wanted), wanted);
  integrate(action);
  const double demand = settings_.gain * led + integral_;
  control_ = stepped_towards(control_, demand, reference_step(settings_.ramp, reference_, period_));
  limited_ = control_ != demand;
}

bool SpindleSynchronization::synchronized() const {
  return closed_ && std::abs(error_) <= settings_.window / degrees_of_turn;
}

bool SpindleSynchronization::take_lost() { return std::exchange(lost_, false); }

}  // namespace trunnion::drive
