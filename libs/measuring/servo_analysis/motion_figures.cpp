// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/motion_figures.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::servo_analysis {
namespace {

std::size_t samples_of(double time, double interval) {
  return static_cast<std::size_t>(std::max(1.0, std::round(time / interval)));
}

}  // namespace

std::vector<ConstantPhase> constant_phases(const AxisTrace& t, double shortest) {
  std::vector<ConstantPhase> phases;
  const std::size_t least = samples_of(shortest, t.interval);
  // Rounding of setpoints up to 1e5 in steps of a sample.
  const double rounding = 1e-9 / t.interval;
  std::size_t begin = 0;
  double speed = 0;
  const auto finish = [&](std::size_t end) {
    if (end - begin >= least && std::abs(speed) > 2 * rounding) phases.push_back({begin, end, speed});
  };
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double v = (t.setpoint[i + 1] - t.setpoint[i]) / t.interval;
    if (i > begin && std::abs(v - speed) <= 5e-3 * std::abs(speed) + rounding) continue;
    finish(i);
    begin = i, speed = v;
  }
  if (t.size() > 1) finish(t.size());
  for (auto& p : phases)
    p.speed = (t.setpoint[p.end - 1] - t.setpoint[p.begin]) /
              (static_cast<double>(p.end - 1 - p.begin) * t.interval);
  return phases;
}

MotionFigures motion_figures(const AxisTrace& t, double settling) {
  MotionFigures f;
  const std::size_t settle = samples_of(settling, t.interval), two = samples_of(0.002, t.interval);
  for (std::size_t i = 0; i < t.size(); ++i)
    f.following_peak = std::max(f.following_peak, std::abs(t.setpoint[i] - t.feedback[i]));
  for (std::size_t i = 0; i + two < t.size(); ++i) {
    const double a = (t.speed[i + two] - t.speed[i]) / (static_cast<double>(two) * t.interval);
    f.acceleration_peak = std::max(f.acceleration_peak, a);
    f.deceleration_peak = std::max(f.deceleration_peak, -a);
  }
  double error = 0;
  std::size_t counted = 0;
  for (const auto& p : constant_phases(t, settling + 0.02)) {
    ++f.phases;
    f.speed = std::max(f.speed, std::abs(p.speed));
    const double sign = p.speed > 0 ? 1 : -1;
    // Of the command at the same moment: it is not quite constant.
    const auto excess = [&](std::size_t i) {
      const std::size_t k = std::min(i, p.end - 2);
      return sign * (t.speed[i] - (t.setpoint[k + 1] - t.setpoint[k]) / t.interval);
    };
    for (std::size_t i = p.begin; i < p.end; ++i) f.overshoot = std::max(f.overshoot, excess(i));
    double mean = 0;
    const std::size_t from = p.begin + settle;
    for (std::size_t i = from; i < p.end; ++i) {
      mean += excess(i);
      error += sign * (t.setpoint[i] - t.feedback[i]);
    }
    counted += p.end - from;
    mean /= static_cast<double>(p.end - from);
    for (std::size_t i = from; i < p.end; ++i) f.ripple = std::max(f.ripple, std::abs(excess(i) - mean));
  }
  if (counted > 0) f.following_error = error / static_cast<double>(counted);
  if (std::abs(f.following_error) > 1e-9) f.velocity_gain = f.speed / f.following_error;
  return f;
}

double settling_time(double position_gain) {
  return std::max(0.1, 6 / position_gain);  // exp(-6) is 0.25 %
}

double bearable_share(double speed, double position_gain, double limit) {
  if (!(speed > 0) || !(limit > 0)) return 1;
  return std::min(1.0, position_gain * limit / 2 / speed);
}

double reversal_jump(const AxisTrace& t, double window) {
  const std::size_t n = samples_of(window, t.interval);
  double jump = 0, direction = 0;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double step = t.setpoint[i + 1] - t.setpoint[i];
    if (std::abs(step) < 1e-12) continue;
    const double now = step > 0 ? 1 : -1;
    if (direction * now < 0 && i >= n && i + n < t.size()) {
      const auto span = [&](std::size_t from) {
        double low = 1e300, high = -1e300;
        for (std::size_t k = from; k < from + n; ++k) {
          const double e = t.feedback[k] - t.setpoint[k];
          low = std::min(low, e), high = std::max(high, e);
        }
        return high - low;
      };
      jump = std::max(jump, span(i) - span(i - n));
    }
    direction = now;
  }
  return jump;
}

}  // namespace trunnion::servo_analysis
