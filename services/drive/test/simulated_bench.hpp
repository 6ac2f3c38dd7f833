// SPDX-License-Identifier: Apache-2.0
// Axes of the simulated hardware that move without a cluster, with the servo tests of the drive.
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>

#include "machine/parameter_constants.hpp"
#include "servo_analysis/axis_tuning.hpp"
#include "simulated_hardware.hpp"

namespace trunnion::drive {

/// The columns of a sample of idl/servo.idl.
inline void append(servo_analysis::AxisTrace& t, const double* v) {
  t.setpoint.push_back(v[0]), t.feedback.push_back(v[1]), t.speed_set.push_back(v[2]),
      t.speed.push_back(v[3]);
  t.torque.push_back(v[4]), t.excitation.push_back(v[5]), t.motor.push_back(v[6]), t.load.push_back(v[7]);
}

/// Setpoints of simulated hardware with X and Y (logical axes 0, 1); nothing here is random.
class SimulatedBench {
 public:
  SimulatedBench(const machine::Parameters& parameters, std::map<std::string, truth::DriveTruth> truth)
      : parameters_(parameters), hardware_(std::move(truth)) {
    const auto axes = machine::drive_axes(parameters);
    hardware_.configure(parameters, axes, {}, 0.001);
    row_.axes.resize(axes.size());
    row_.enable = row_.controlled = true;
    for (std::size_t i = 0; i < axes.size(); ++i) traces_.emplace_back();
    hardware_.status(status_);
    for (std::size_t i = 0; i < axes.size(); ++i) row_.axes[i].position = status_.axes[i].hold_position;
  }

  void start(idl::servo::TestRequest request) {
    request.number = ++number_;
    if (request.duration == 0) request.duration = 600;
    if (request.decimation == 0) request.decimation = 1;
    for (auto& t : traces_) t = {}, t.interval = 0.000125 * request.decimation;
    const auto refused = hardware_.tester()->request(request);
    if (!refused.empty()) throw std::runtime_error(refused);
    phase_ = idl::servo::TestPhase::RUNNING, vibration_ = 0;
  }
  void finish() {
    idl::servo::TestRequest end;
    end.end = true;
    if (hardware_.tester()->running()) hardware_.tester()->request(end);
    take();
  }
  /// One period with every axis at its position, mm.
  void to(const std::vector<double>& positions, bool moving = true) {
    ++row_.number;
    row_.moving = moving;
    for (std::size_t i = 0; i < row_.axes.size(); ++i) {
      auto& a = row_.axes[i];
      const double v = (positions[i] - a.position) / 0.001;
      a = {positions[i], v, (v - a.velocity) / 0.001};
    }
    hardware_.exchange(row_, status_, none_);
    if (hardware_.tester()->ready()) take();
  }
  void rest(double seconds, bool moving = false) {
    std::vector<double> here;
    for (const auto& a : row_.axes) here.push_back(a.position);
    for (int i = 0; i < seconds * 1000; ++i) to(here, moving);
  }
  /// Axis 0 from where it is by `distance` with a raised cosine as the acceleration, then 50 ms of rest.
  void by(double distance, double speed, double acceleration) {
    const double from = row_.axes[0].position, way = std::abs(distance);
    speed = std::min(speed, way / 0.1);
    // The mean of a raised cosine is half of its peak; the peak of its derivative is pi times the peak over
    // the time.
    const double jerk = parameters_.get(parameter::maximum_jerk, 0);
    const double rise = std::max(2 * speed / acceleration, std::sqrt(2 * M_PI * speed / jerk));
    const double total = way / speed + rise;
    auto at = positions();
    for (int i = 1;; ++i) {
      const double t = std::min(i * 0.001, total);
      const auto risen = [&](double time) {  // way of the acceleration after `time`
        if (time >= rise) return speed * (time - rise / 2);
        const double w = 2 * M_PI / rise;
        return speed / rise * (time * time / 2 + (std::cos(w * time) - 1) / (w * w));
      };
      const double done = t < total - rise ? risen(t) : way - risen(total - t);
      at[0] = from + std::copysign(done, distance);
      to(at);
      if (t >= total) break;
    }
    for (int i = 0; i < 50; ++i) to(at);
  }
  /// Axis 0 on two turns of a circle from where it reverses; the speed rises and falls within half a second.
  void circle(double radius, double speed) {
    const double from = row_.axes[0].position, omega = speed / radius, rise = 0.5;
    const double total = 4 * M_PI / omega + rise;
    auto at = positions();
    for (int i = 1; i * 0.001 <= total; ++i) {
      const double t = i * 0.001, end = total - t;
      const double angle = t < rise     ? omega * t * t / rise / 2
                           : end < rise ? 4 * M_PI - omega * end * end / rise / 2
                                        : omega * (t - rise / 2);
      at[0] = from + radius * (1 - std::cos(angle));
      to(at);
    }
    for (int i = 0; i < 500; ++i) to(at);
  }
  std::vector<double> positions() const {
    std::vector<double> all;
    for (const auto& a : row_.axes) all.push_back(a.position);
    return all;
  }
  const std::vector<servo_analysis::AxisTrace>& traces() const { return traces_; }
  idl::servo::TestPhase phase() const { return phase_; }
  double vibration() const { return vibration_; }
  SimulatedHardware& hardware() { return hardware_; }
  const machine::Parameters& parameters() const { return parameters_; }

 private:
  struct None : EncoderRowSink {
    void skip_edge(std::uint64_t, const idl::stream::SkipEdge&) override {}
    void encoder_row(const EncoderRow&) override {}
  };
  void take() {
    idl::servo::TestSamples samples;
    hardware_.tester()->fill(samples);
    phase_ = samples.phase;
    vibration_ = std::max(vibration_, samples.vibration);
    for (std::size_t k = 0; k + sample_values <= samples.values.size(); k += sample_values)
      append(traces_[(k / sample_values) % samples.axes.size()], &samples.values[k]);
  }

  machine::Parameters parameters_;
  SimulatedHardware hardware_;
  SetpointRow row_;
  DriveStatus status_;
  None none_;
  std::vector<servo_analysis::AxisTrace> traces_;
  std::uint64_t number_ = 0;
  idl::servo::TestPhase phase_ = idl::servo::TestPhase::COMPLETED;
  double vibration_ = 0;
};

/// Axis 0 of a bench, for the tuning.
class BenchAxis : public servo_analysis::AxisUnderTest {
 public:
  explicit BenchAxis(SimulatedBench& bench, std::uint16_t axis = 0) : bench_(bench), axis_(axis) {}
  servo_analysis::MotionResult move(const servo_analysis::ServoSettings& trial,
                                    const servo_analysis::ServoSettings& fallback, double limit,
                                    const servo_analysis::TestMotion& motion) override {
    idl::servo::TestRequest request;
    request.axes = {axis_};
    request.vibration_limit = limit;
    request.in_motion = true;
    request.decimation = motion.radius > 0 ? 8 : 2;
    const auto first = trial.values(axis_), second = fallback.values(axis_);
    for (std::size_t i = 0; i < first.size(); ++i)
      request.trial.push_back({first[i].number, first[i].value, second[i].value});
    bench_.start(request);
    const double a = bench_.parameters().get(parameter::maximum_acceleration, axis_);
    if (motion.radius > 0) bench_.circle(motion.radius, motion.feed / 60);
    for (int i = 0;
         motion.radius == 0 && i < motion.strokes && bench_.phase() == idl::servo::TestPhase::RUNNING; ++i)
      bench_.by(i % 2 == 0 ? motion.distance : -motion.distance, motion.feed / 60, a);
    if (bench_.positions()[0] != 0 && bench_.phase() != idl::servo::TestPhase::RUNNING)
      bench_.by(-bench_.positions()[0], motion.feed / 60, a);
    bench_.finish();
    bench_.rest(0.3);
    return {bench_.phase() == idl::servo::TestPhase::ENDED_BY_VIBRATION, bench_.vibration(),
            bench_.traces()[0]};
  }

 private:
  SimulatedBench& bench_;
  std::uint16_t axis_;
};

}  // namespace trunnion::drive
