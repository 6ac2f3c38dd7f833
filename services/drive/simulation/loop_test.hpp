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
    run_.motor_watch.start(request.vibration_limit);
    run_.load_watch.start(request.vibration_limit);
  }
  /// Until the next call excitation and samples are on, or off.
  void activate(bool active) { run_.active = active; }
  void fall_back() { run_.fallen_back = true; }
  const ServoParameters& parameters() const { return run_.fallen_back ? fallback_ : trial_; }

  /// Of the next period of the speed loop, in the unit of `signal`.
  double excitation() const {
    using idl::servo::TestSignal;
    if (!run_.active || signal_ == TestSignal::NONE || run_.fallen_back) return 0;
    const std::uint64_t place = run_.count % period_;
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
    const bool motor = run_.motor_watch.step(s.setpoint - s.motor, h_);
    const bool load = run_.load_watch.step(s.setpoint - s.load, h_);
    run_.vibrates = run_.vibrates || motor || load;
    if (!run_.active) return;
    if (run_.count++ % decimation_ != 0) return;
    run_.values.insert(run_.values.end(), {s.setpoint, s.feedback, s.speed_set, s.speed, s.torque,
                                           s.excitation, s.motor, s.load});
  }
  /// Continues as `other`, whose fields() were read.
  void take_state(const LoopTest& other) { run_ = other.run_; }
  bool vibrates() const { return run_.vibrates; }
  double vibration() const { return std::max(run_.motor_watch.largest(), run_.load_watch.largest()); }
  std::vector<double>& values() { return run_.values; }
  const std::vector<double>& values() const { return run_.values; }

  /// No fields, start() sets them again: trial_, fallback_, signal_, amplitude_, first_, last_, h_,
  /// period_, decimation_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    Run::fields(self.run_, visit);
  }

 private:
  /// What changes while the test runs.
  struct Run {
    std::uint64_t count = 0;
    bool active = false, fallen_back = false, vibrates = false;
    std::vector<double> values;
    VibrationWatch motor_watch, load_watch;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("count", self.count), visit("active", self.active), visit("fallen_back", self.fallen_back);
      visit("vibrates", self.vibrates), visit("values", self.values);
      visit("motor_watch", self.motor_watch), visit("load_watch", self.load_watch);
    }
  };
  ServoParameters trial_, fallback_;
  idl::servo::TestSignal signal_ = idl::servo::TestSignal::NONE;
  double amplitude_ = 0, first_ = 0, last_ = 0, h_ = 1;
  std::uint64_t period_ = 2, decimation_ = 1;
  Run run_;
};

}  // namespace trunnion::drive
