// SPDX-License-Identifier: Apache-2.0
// What a test does in the loops of one axis: excitation, parameters on trial, samples, watch for vibration.
#pragma once

#include <array>
#include <vector>

#include "contracts/types.hpp"
#include "geometry/angle.hpp"
#include "servo_parameters.hpp"
#include "vibration_watch.hpp"

namespace trunnion::drive {

/// Values of one period of the speed loop, as idl/servo.idl lists them: mm or deg, per second, share of the
/// rated torque.
struct LoopSample {
  double setpoint = 0, feedback = 0, speed_set = 0, speed = 0, torque = 0, excitation = 0, motor = 0,
         load = 0;
};
inline constexpr std::size_t sample_values = 8;

class LoopTest {
 public:
  /// `trial` and `fallback`: of the axis; `h` s: a period of the speed loop.
  void start(const idl::servo::TestRequest& request, const ServoParameters& trial,
             const ServoParameters& fallback, bool excited, double h) {
    *this = {};
    trial_ = trial, fallback_ = fallback;
    if (excited) signal_ = request.signal;
    amplitude_ = request.amplitude, first_ = request.first_frequency, last_ = request.last_frequency;
    period_ = std::max<std::uint64_t>(2, static_cast<std::uint64_t>(std::llround(request.period / h)));
    decimation_ = request.decimation, h_ = h;
    motor_watch_.start(request.vibration_limit);
    load_watch_.start(request.vibration_limit);
  }
  /// Until the next call excitation and samples are on, or off.
  void activate(bool active) { active_ = active; }
  void fall_back() { fallen_back_ = true; }
  const ServoParameters& parameters() const { return fallen_back_ ? fallback_ : trial_; }

  /// Of the next period of the speed loop, in the unit of `signal`.
  double excitation() const {
    using idl::servo::TestSignal;
    if (!active_ || signal_ == TestSignal::NONE || fallen_back_) return 0;
    const std::uint64_t place = count_ % period_;
    if (signal_ == TestSignal::SPEED_STEP || signal_ == TestSignal::TORQUE_STEP)
      return place >= period_ / 2 ? amplitude_ : 0;
    const double t = static_cast<double>(place) * h_, whole = static_cast<double>(period_) * h_;
    const double turns = first_ * t + (last_ - first_) * t * (t / whole) / 2;
    return amplitude_ * geometry::sine_cosine(360 * (turns - std::floor(turns))).sine;
  }
  bool of_speed() const {
    return signal_ == idl::servo::TestSignal::SPEED_CHIRP || signal_ == idl::servo::TestSignal::SPEED_STEP;
  }
  void sample(const LoopSample& s) {
    const bool motor = motor_watch_.step(s.setpoint - s.motor, h_);
    const bool load = load_watch_.step(s.setpoint - s.load, h_);
    vibrates_ = vibrates_ || motor || load;
    if (!active_) return;
    if (count_++ % decimation_ != 0) return;
    values_.insert(values_.end(),
                   {s.setpoint, s.feedback, s.speed_set, s.speed, s.torque, s.excitation, s.motor, s.load});
  }
  /// Continues as `other`, whose fields() were read.
  void take_state(const LoopTest& other) {
    count_ = other.count_, active_ = other.active_, fallen_back_ = other.fallen_back_;
    vibrates_ = other.vibrates_, values_ = other.values_;
    motor_watch_ = other.motor_watch_, load_watch_ = other.load_watch_;
  }
  bool vibrates() const { return vibrates_; }
  double vibration() const { return std::max(motor_watch_.largest(), load_watch_.largest()); }
  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }

  /// No fields, start() sets them again: trial_, fallback_, signal_, amplitude_, first_, last_, h_,
  /// period_, decimation_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("count", self.count_), visit("active", self.active_), visit("fallen_back", self.fallen_back_);
    visit("vibrates", self.vibrates_), visit("values", self.values_);
    visit("motor_watch", self.motor_watch_), visit("load_watch", self.load_watch_);
  }

 private:
  ServoParameters trial_, fallback_;
  idl::servo::TestSignal signal_ = idl::servo::TestSignal::NONE;
  double amplitude_ = 0, first_ = 0, last_ = 0, h_ = 1;
  std::uint64_t period_ = 2, decimation_ = 1, count_ = 0;
  bool active_ = false, fallen_back_ = false, vibrates_ = false;
  VibrationWatch motor_watch_, load_watch_;
  std::vector<double> values_;
};

}  // namespace trunnion::drive
