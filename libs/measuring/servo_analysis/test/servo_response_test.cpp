// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/servo_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trunnion::servo_analysis {
namespace {

// Hv with a position loop, by Runge and Kutta of fourth order in steps of 1/20 of a sample: another way than
// that of the library.
template <class Setpoint, class Slope>
AxisTrace motion(const ServoResponse& r, double seconds, Setpoint&& setpoint, Slope&& slope) {
  AxisTrace t;
  t.interval = 0.0005;
  const double square = r.natural_frequency * r.natural_frequency;
  struct State {
    double q = 0, rate = 0, position = 0;
  };
  const auto speed = [&](const State& s) { return square * (s.q + r.zero_time * s.rate); };
  const auto command = [&](const State& s, double time) {
    return r.position_gain * (setpoint(time) - s.position) + r.feedforward * slope(time);
  };
  const auto derivative = [&](const State& s, double time) {
    return State{s.rate, command(s, time) - 2 * r.damping * r.natural_frequency * s.rate - square * s.q,
                 speed(s)};
  };
  const auto moved = [](const State& s, const State& d, double h) {
    return State{s.q + h * d.q, s.rate + h * d.rate, s.position + h * d.position};
  };
  State s;
  const auto n = static_cast<std::size_t>(seconds / t.interval);
  for (std::size_t i = 0; i < n; ++i) {
    const double time = static_cast<double>(i) * t.interval;
    t.setpoint.push_back(setpoint(time)), t.feedback.push_back(s.position);
    t.speed_set.push_back(command(s, time)), t.speed.push_back(speed(s));
    for (auto* v : {&t.torque, &t.excitation, &t.motor, &t.load}) v->push_back(0);
    const double h = t.interval / 20;
    for (int k = 0; k < 20; ++k) {
      const double now = time + k * h;
      const auto a = derivative(s, now), b = derivative(moved(s, a, h / 2), now + h / 2);
      const auto c = derivative(moved(s, b, h / 2), now + h / 2), d = derivative(moved(s, c, h), now + h);
      s = moved(s,
                {(a.q + 2 * b.q + 2 * c.q + d.q) / 6, (a.rate + 2 * b.rate + 2 * c.rate + d.rate) / 6,
                 (a.position + 2 * b.position + 2 * c.position + d.position) / 6},
                h);
    }
  }
  return t;
}

TEST(ServoResponse, OfOneZeroAndTwoPolesIsFoundInAMotionToAndFro) {
  const ServoResponse truth{150, 0.6, 0.006, 40, 0.5, 0};
  // 1 mm/s within 20 ms, back with the same speed after 0.9 s, still after 1.9 s.
  const std::pair<double, double> changes[] = {{0.1, 50},  {0.12, -50}, {1, -50},
                                               {1.04, 50}, {2, 50},     {2.02, -50}};
  const auto trace = motion(
      truth, 2.5,
      [&](double time) {
        double sum = 0;
        for (const auto& [at, jump] : changes) sum += time > at ? jump * (time - at) * (time - at) / 2 : 0;
        return sum;
      },
      [&](double time) {
        double sum = 0;
        for (const auto& [at, jump] : changes) sum += time > at ? jump * (time - at) : 0;
        return sum;
      });
  const auto found = fit_servo_response(trace);
  // Between two samples of 0.5 ms the setpoint of the speed is not quite linear.
  EXPECT_NEAR(found.natural_frequency, truth.natural_frequency, 0.01 * truth.natural_frequency);
  EXPECT_NEAR(found.damping, truth.damping, 0.01 * truth.damping);
  EXPECT_NEAR(found.zero_time, truth.zero_time, 0.01 * truth.zero_time);
  EXPECT_NEAR(found.position_gain, truth.position_gain, 0.01 * truth.position_gain);
  EXPECT_NEAR(found.feedforward, truth.feedforward, 0.01);
  EXPECT_GT(found.fit, 98.27) << "the fit of the experiment of Qian and Bi";
  const auto predicted = predicted_positions(found, trace.setpoint, trace.interval);
  double largest = 0;
  for (std::size_t i = 0; i < predicted.size(); ++i)
    largest = std::max(largest, std::abs(predicted[i] - trace.feedback[i]));
  // The lag is (1 - kv) v / Kv = 12.5 um.
  EXPECT_LT(largest, 0.02 * 12.5e-3);
}

TEST(ServoResponse, LagsAtTheStartAndThenOvershootsWhereItIsUnderdamped) {
  const ServoResponse soft{60, 0.2, 0.002, 20, 0, 0};
  // dL = 0.01 mm, T = 8 s: at a speed of 7.9 um/s the lag is v / Kv = 0.39 um.
  const double omega = 2 * 3.14159265358979 / 8;
  const auto trace = motion(
      soft, 4, [&](double time) { return 0.01 * std::sin(omega * time); },
      [&](double time) { return 0.01 * omega * std::cos(omega * time); });
  const auto predicted = predicted_positions(soft, trace.setpoint, trace.interval);
  double largest = 0, lag = 0, ahead = 0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    largest = std::max(largest, std::abs(predicted[i] - trace.feedback[i]));
    lag = std::max(lag, trace.setpoint[i] - predicted[i]);
    ahead = std::max(ahead, trace.speed[i] - trace.speed_set[i]);
  }
  EXPECT_LT(largest, 2e-6);
  EXPECT_NEAR(lag, 0.39e-3, 0.25 * 0.39e-3) << "it swings about its final value";
  EXPECT_GT(ahead, 1e-3) << "the speed swings beyond its setpoint";
}

TEST(ServoResponse, NeedsAnAxisThatMoves) {
  AxisTrace still;
  still.setpoint = still.feedback = still.speed_set = still.speed = still.torque = still.excitation =
      std::vector<double>(100, 0.0);
  EXPECT_THROW(fit_servo_response(still), std::runtime_error);
  EXPECT_THROW(fit_servo_response({}), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::servo_analysis
