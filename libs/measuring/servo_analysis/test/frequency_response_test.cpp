// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/frequency_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trunnion::servo_analysis {
namespace {

using Complex = std::complex<double>;
constexpr double h = 0.000125, period = 1;
constexpr std::size_t samples = 8000;

double chirp(std::size_t i, double last) {
  const double t = static_cast<double>(i % samples) * h;
  return std::sin(2 * std::numbers::pi * (1 * t + (last - 1) * t * t / period / 2));
}

double degrees_between(Complex a, Complex b) { return std::abs(std::arg(a / b)) * 180 / std::numbers::pi; }

// Speed loop as the drive computes it: PI controller with kp and ti, first order current loop, an inertia of
// 1; the position loop with kv around it. Difference equations in the test, their z-transform as the closed
// form.
struct Loops {
  double kp = 600, ti = 0.012, tau = 0.0004, kv = 60;
  AxisTrace run(std::size_t n, double offset_speed) const {
    AxisTrace t;
    t.interval = h;
    double torque = 0, integral = 0, v = offset_speed, x = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double set_position = offset_speed * static_cast<double>(i) * h;
      const double excitation = 3 * chirp(i, 320);
      const double set = kv * (set_position - x) + offset_speed + excitation;
      const double demand = kp * (set - v) + integral;
      integral += kp / ti * (set - v) * h;
      torque += (demand - torque) * h / tau;
      t.setpoint.push_back(set_position), t.feedback.push_back(x), t.speed_set.push_back(set);
      t.speed.push_back(v), t.torque.push_back(torque), t.excitation.push_back(excitation);
      v += torque * h;
      x += v * h;
    }
    t.motor = t.load = t.feedback;
    return t;
  }
  Complex z(double f) const { return std::polar(1.0, 2 * std::numbers::pi * f * h); }
  Complex speed_open(double f) const {
    const Complex q = z(f), a = h / tau;
    return (kp + kp / ti * h / (q - 1.0)) * (a / (1.0 - (1.0 - a) / q)) * (h / (q - 1.0));
  }
  // x is the sum of the new speeds: X = V h z / (z - 1).
  Complex position_open(double f) const {
    const Complex q = z(f), l = speed_open(f);
    return kv * l / (1.0 + l) * h * q / (q - 1.0);
  }
};

TEST(FrequencyResponse, OfSpeedAndPositionLoopIsTheTransferFunctionFrom1To300Hz) {
  const Loops loops;
  const auto trace = loops.run(4 * samples, 10);
  const auto r = loop_responses(trace, {samples, samples, 3, 1, 300});
  ASSERT_EQ(r.speed_open.size(), 300u);
  for (std::size_t i = 0; i < r.speed_open.size(); ++i) {
    const double f = r.speed_open[i].frequency;
    const Complex l = loops.speed_open(f), p = loops.position_open(f);
    for (const auto& [found, right] : {std::pair{r.speed_open[i].value, l},
                                       {r.speed_closed[i].value, l / (1.0 + l)},
                                       {r.position_open[i].value, p},
                                       {r.position_closed[i].value, p / (1.0 + p)}}) {
      EXPECT_NEAR(std::abs(found / right), 1, 0.01) << f << " Hz";
      EXPECT_LT(degrees_between(found, right), 1) << f << " Hz";
    }
  }
}

TEST(FrequencyResponse, MarginsAreThoseOfAClosedForm) {
  // L = k / (s (1 + s T)^2): -180 deg at w = 1 / T, where |L| = k T / 2. With k T = 0.5 the gain margin is 4.
  const double T = 0.002, k = 250;
  Response open;
  for (double f = 1; f < 400; f += 0.5) {
    const Complex s(0, 2 * std::numbers::pi * f);
    open.push_back({f, k / (s * (1.0 + s * T) * (1.0 + s * T))});
  }
  const auto m = margins(open);
  EXPECT_NEAR(*m.gain_margin, 4, 0.01);
  EXPECT_NEAR(*m.phase_crossover, 1 / (2 * std::numbers::pi * T), 0.1);
  // |L| = 1: k = w (1 + w^2 T^2): w T (1 + (w T)^2) = 0.5 has the solution w T = 0.4239.
  EXPECT_NEAR(*m.crossover, 0.42385 / (2 * std::numbers::pi * T), 0.05);
  EXPECT_NEAR(*m.phase_margin, 90 - 2 * std::atan(0.42385) * 180 / std::numbers::pi, 0.2);
}

TEST(FrequencyResponse, BandwidthAndPeakOfASecondOrderLoop) {
  const double w0 = 2 * std::numbers::pi * 50, d = 0.3;
  Response closed;
  for (double f = 1; f < 300; f += 0.1) {
    const Complex s(0, 2 * std::numbers::pi * f);
    closed.push_back({f, w0 * w0 / (s * s + 2 * d * w0 * s + w0 * w0)});
  }
  EXPECT_NEAR(resonance_peak(closed), 1 / (2 * d * std::sqrt(1 - d * d)), 1e-3);
  const double u = 1 - 2 * d * d;
  EXPECT_NEAR(*bandwidth(closed), 50 * std::sqrt(u + std::sqrt(u * u + 1)), 0.1);
}

TEST(FrequencyResponse, AWindowWithoutDataOrLinesIsRefused) {
  const std::vector<double> signal(100, 1.0), none(100, 0.0);
  EXPECT_THROW(frequency_response(signal, signal, h, {0, 200, 1, 1, 4000}), std::runtime_error);
  EXPECT_THROW(frequency_response(signal, signal, h, {0, 100, 1, 1, 10}), std::runtime_error);
  EXPECT_THROW(frequency_response(none, signal, h, {0, 100, 1, 80, 400}), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::servo_analysis
