// SPDX-License-Identifier: Apache-2.0
// Tests of servo loops in the simulated drive: excitation, samples, values on trial, their end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "bus/json.hpp"
#include "servo_analysis/frequency_response.hpp"
#include "simulated_bench.hpp"
#include "two_axes.hpp"

namespace trunnion::drive {
namespace {

using idl::servo::TestPhase;
using idl::servo::TestRequest;
using idl::servo::TestSignal;
using Complex = std::complex<double>;

constexpr double h = 0.000125;

truth::DriveTruth two_masses(double frequency = 90) {
  truth::DriveTruth truth;
  truth.mechanics.emplace();
  truth.mechanics->load_share = 0.5, truth.mechanics->locked_frequency = frequency;
  truth.mechanics->damping_ratio = 0.04;
  return truth;
}

machine::Parameters parameters_with(std::initializer_list<std::pair<std::uint32_t, double>> values) {
  auto p = two_axes();
  p.values[parameter::coulomb_friction.number(0)] = {0, ""};
  p.values[parameter::viscous_friction.number(0)] = {0, ""};
  for (const auto& [number, value] : values) p.values[number] = {value, ""};
  return p;
}

TestRequest of_axis_0(TestSignal signal = TestSignal::NONE) {
  TestRequest r;
  r.axes = {0};
  r.signal = signal;
  r.decimation = 1;
  return r;
}

// One period of the speed loop as a linear system: motor and load (positions, speeds), torque, integral; the
// input is the setpoint of the speed loop. The order of the steps is that of the drive.
struct OpenLoops {
  Complex speed;     // speed over difference of setpoint and speed
  Complex position;  // kv * position over setpoint of the speed loop
};
OpenLoops open_loops(const machine::Parameters& p, const truth::MechanicsTruth& m, double f) {
  const double kp = p.get(parameter::speed_gain, 0), ti = p.get(parameter::speed_integral_time, 0) / 1000,
               tau = p.get(parameter::current_time_constant, 0) / 1000;
  const double inertia = (1 + p.get(parameter::load_inertia_ratio, 0)) / 2;
  const double load = inertia * m.load_share, motor = inertia - load;
  const double w = 2 * std::numbers::pi * m.locked_frequency, k = load * w * w,
               d = 2 * m.damping_ratio * load * w;
  const Complex z = std::polar(1.0, 2 * std::numbers::pi * f * h);
  // x' = x + h A x with the speeds taken new for the positions (symplectic).
  Eigen::Matrix4d A = Eigen::Matrix4d::Identity();  // motor, load, motor speed, load speed
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  A.row(2) += h / motor * Eigen::RowVector4d(-k, k, -d, d);
  A.row(3) += h / load * Eigen::RowVector4d(k, -k, d, -d);
  b[2] = h / motor;
  A.row(0) += h * A.row(2), A.row(1) += h * A.row(3);
  b[0] = h * b[2];
  const Eigen::Matrix4cd system = z * Eigen::Matrix4cd::Identity() - A.cast<Complex>();
  const Eigen::Vector4cd plant = system.partialPivLu().solve(b.cast<Complex>());
  const Complex controller = kp + kp / ti * h / (z - 1.0), a = h / tau;
  const Complex speed = controller * (a / (1.0 - (1.0 - a) / z)) * plant[2];
  // Around the closed speed loop, with the position that belongs to the speed in the same state.
  const double kv = p.get(parameter::position_gain, 0);
  return {speed, kv * speed / (1.0 + speed) * plant[0] / plant[2]};
}

TEST(ServoTest, TheFrequencyResponseOfTwoMassesIsTheClosedFormFrom1To300Hz) {
  const auto p = parameters_with({});
  SimulatedBench bench(p, {{"X", two_masses()}});
  auto request = of_axis_0(TestSignal::SPEED_CHIRP);
  request.amplitude = 3, request.first_frequency = 1, request.last_frequency = 320, request.period = 1;
  bench.start(request);
  bench.rest(5);
  bench.finish();
  const auto& trace = bench.traces()[0];
  ASSERT_EQ(trace.size(), 40000u);
  // The vibration of 127 Hz with a damping of 0.057 has died away after 2 s.
  const auto r = servo_analysis::loop_responses(trace, {16000, 8000, 3, 1, 300});
  for (const auto& point : r.speed_open) {
    const Complex right = open_loops(p, *two_masses().mechanics, point.frequency).speed;
    EXPECT_NEAR(std::abs(point.value / right), 1, 0.01) << point.frequency << " Hz";
    EXPECT_LT(std::abs(std::arg(point.value / right)) * 180 / std::numbers::pi, 1)
        << point.frequency << " Hz";
  }
}

// The position loop over the same two masses, with the encoder on the motor. Its steps of 1e-5 mm are below
// 1e-2 of the motion at 300 Hz.
TEST(ServoTest, ThePositionLoopIsItsClosedFormFrom1To300Hz) {
  for (const double kv : {30.0, 90.0}) {
    const auto p = parameters_with({{parameter::position_gain.number(0), kv}});
    SimulatedBench bench(p, {{"X", two_masses()}});
    auto request = of_axis_0(TestSignal::SPEED_CHIRP);
    request.amplitude = 3, request.first_frequency = 1, request.last_frequency = 320, request.period = 1;
    bench.start(request);
    bench.rest(5);
    bench.finish();
    const auto r = servo_analysis::loop_responses(bench.traces()[0], {16000, 8000, 3, 1, 300});
    ASSERT_EQ(r.position_open.size(), 300u);
    for (std::size_t i = 0; i < r.position_open.size(); ++i) {
      const double f = r.position_open[i].frequency;
      const Complex open = open_loops(p, *two_masses().mechanics, f).position;
      for (const auto& [found, right] :
           {std::pair{r.position_open[i].value, open}, {r.position_closed[i].value, open / (1.0 + open)}}) {
        EXPECT_NEAR(std::abs(found / right), 1, 0.01) << kv << ", " << f << " Hz";
        EXPECT_LT(std::abs(std::arg(found / right)) * 180 / std::numbers::pi, 1) << kv << ", " << f << " Hz";
      }
    }
  }
}

TEST(ServoTest, ATorqueStepIsAddedInEverySecondHalfOfItsPeriod) {
  SimulatedBench bench(parameters_with({}), {});
  auto request = of_axis_0(TestSignal::TORQUE_STEP);
  request.amplitude = 0.1, request.period = 0.02, request.duration = 0.1;
  bench.start(request);
  bench.rest(0.2);
  EXPECT_EQ(bench.phase(), TestPhase::COMPLETED) << "after its duration";
  const auto& t = bench.traces()[0];
  ASSERT_EQ(t.size(), 800u);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_EQ(t.excitation[i], i % 160 < 80 ? 0 : 0.1) << i;
  // The current loop of 0.4 ms takes 0.125 / 0.4 of the step in its first period.
  EXPECT_NEAR(t.torque[80], 0.1 * 0.125 / 0.4, 1e-9);
}

TEST(ServoTest, SamplesOfAMotionPauseAtRest) {
  SimulatedBench bench(parameters_with({}), {});
  auto request = of_axis_0();
  request.in_motion = true, request.decimation = 8;
  bench.start(request);
  bench.rest(0.1);
  bench.rest(0.05, true);
  bench.rest(0.1);
  bench.finish();
  EXPECT_EQ(bench.traces()[0].size(), 50u);
  EXPECT_EQ(bench.phase(), TestPhase::ENDED_BY_CLIENT);
}

TEST(ServoTest, ValuesOnTrialAreInForceUntilTheTestEnds) {
  // Without feed-forward the axis follows by speed / gain: 10 mm/s and 60 or 30 1/s.
  const auto p = parameters_with(
      {{parameter::velocity_feedforward.number(0), 0}, {parameter::acceleration_feedforward.number(0), 0}});
  SimulatedBench bench(p, {});
  const auto lag = [&] {
    auto at = bench.positions();
    for (int i = 0; i < 400; ++i) at[0] += 0.01, bench.to(at);
    DriveStatus status;
    bench.hardware().status(status);
    return status.axes[0].following_error;
  };
  EXPECT_NEAR(lag(), 10.0 / 60, 1e-4);
  auto request = of_axis_0();
  request.trial = {{parameter::position_gain.number(0), 30, 60}};
  bench.start(request);
  EXPECT_NEAR(lag(), 10.0 / 30, 1e-4);
  bench.finish();
  EXPECT_NEAR(lag(), 10.0 / 60, 1e-4);
}

TEST(ServoTest, FeedForwardHidesALowPositionGainAndWithoutItSpeedOverErrorIsTheGain) {
  const auto p = parameters_with({{parameter::position_gain.number(0), 5}});
  SimulatedBench bench(p, {});
  const auto figures = [&](double share) {
    auto request = of_axis_0();
    request.decimation = 2;
    request.trial = {{parameter::velocity_feedforward.number(0), share, share},
                     {parameter::acceleration_feedforward.number(0), share, share}};
    bench.start(request);
    // 300 mm/min for 1.8 s: 1.2 s settle the loop.
    bench.by(9, 5, 4000);
    bench.finish();
    const auto f = servo_analysis::motion_figures(bench.traces()[0], servo_analysis::settling_time(5));
    bench.rest(3);
    return f;
  };
  // The manual's 0.2 mm at 1000 mm/min are 0.06 mm at 300 mm/min: a gain of 83 1/s, and this one is 5.
  EXPECT_LT(std::abs(figures(1).following_error), 0.06);
  const auto without = figures(0);
  EXPECT_NEAR(without.velocity_gain, 5, 0.02);
  EXPECT_NEAR(without.following_error, 1, 0.004);
}

TEST(ServoTest, AVibrationEndsTheTrialBelowItsLimit) {
  auto p = parameters_with({{parameter::full_closed_loop.number(0), 1}});
  auto truth = two_masses(60);
  truth.load.emplace();
  SimulatedBench bench(p, {{"X", truth}});
  auto request = of_axis_0();
  request.vibration_limit = 0.02;
  // With a stiff motor the load damps a gain of 2 * 0.04 * 377 = 30 1/s: the position loop over the scale is
  // unstable.
  request.trial = {{parameter::position_gain.number(0), 100, 10},
                   {parameter::speed_gain.number(0), 2000, 600}};
  bench.start(request);
  bench.by(5, 1000.0 / 60, 4000);
  bench.rest(1);
  bench.finish();
  EXPECT_EQ(bench.phase(), TestPhase::ENDED_BY_VIBRATION);
  EXPECT_GT(bench.vibration(), 0.02 / 5);
  EXPECT_LE(bench.vibration(), 0.02);
  // The fallback: what is left has died away.
  DriveStatus status;
  bench.hardware().status(status);
  EXPECT_LT(std::abs(status.axes[0].following_error), 0.001);
}

TEST(ServoTest, WhatItCannotDoIsRefusedInOneLine) {
  SimulatedBench bench(parameters_with({}), {});
  const auto refusal = [&](auto&& change) {
    auto r = of_axis_0();
    r.duration = 1, r.number = 3;
    change(r);
    return bench.hardware().tester()->request(r);
  };
  EXPECT_EQ(refusal([](auto& r) { r.axes = {}; }), "no axis is given");
  EXPECT_THAT(refusal([](auto& r) { r.axes = {7}; }), testing::HasSubstr("number 7"));
  EXPECT_THAT(refusal([](auto& r) { r.axes = {0, 0}; }), testing::HasSubstr("given twice"));
  EXPECT_EQ(refusal([](auto& r) { r.duration = 601; }), "duration 601 is not within 0 .. 600 s");
  EXPECT_THAT(refusal([](auto& r) { r.duration = std::nan(""); }), testing::StartsWith("duration"));
  EXPECT_THAT(refusal([](auto& r) { r.decimation = 0; }), testing::StartsWith("decimation 0"));
  EXPECT_THAT(refusal([](auto& r) { r.signal = TestSignal::TORQUE_STEP, r.amplitude = 1.5, r.period = 1; }),
              testing::StartsWith("amplitude 1.5 is not within -1 .. 1 of the rated torque"));
  EXPECT_THAT(refusal([](auto& r) {
                r.signal = TestSignal::SPEED_CHIRP, r.amplitude = 1, r.period = 1, r.last_frequency = 4001;
              }),
              testing::StartsWith("frequency 4001"));
  // A value beyond its limits, a parameter of another axis, one that acts after a restart, no servo
  // parameter.
  EXPECT_THAT(refusal([](auto& r) { r.trial = {{100900, 2000, 60}}; }), testing::HasSubstr("100900"));
  EXPECT_THAT(refusal([](auto& r) { r.trial = {{100900, 60, 2000}}; }), testing::HasSubstr("100900"));
  for (const std::uint32_t number : {101900u, 100930u, 100036u, 700000u, 0u})
    EXPECT_THAT(refusal([&](auto& r) {
                  r.trial = {{number, 1, 1}};
                }),
                testing::HasSubstr("is no servo parameter"));
  EXPECT_EQ(refusal([](auto& r) { r.end = true; }), "no test of this client is running");
  EXPECT_EQ(refusal([](auto&) {}), "");
  EXPECT_EQ(refusal([](auto&) {}), "") << "the same request renews it";
  EXPECT_THAT(refusal([](auto& r) { r.number = 9; }), testing::StartsWith("another test is running"));
  EXPECT_EQ(refusal([](auto& r) { r.end = true, r.client = 5; }), "no test of this client is running");
}

TEST(ServoTest, ADriveContinuesInTheMiddleOfATestWithTheSameBits) {
  const auto p = parameters_with(
      {{parameter::notch_frequency.number(0), 200}, {parameter::torque_filter_time.number(0), 0.5}});
  SimulatedBench first(p, {{"X", two_masses()}}), second(p, {{"X", two_masses()}});
  auto request = of_axis_0(TestSignal::TORQUE_CHIRP);
  request.amplitude = 0.05, request.first_frequency = 5, request.last_frequency = 100, request.period = 0.3;
  request.trial = {{parameter::speed_gain.number(0), 400, 300}};
  first.start(request);
  first.rest(0.1004);
  second.hardware().continue_from(bus::Json::parse(bus::text_of(first.hardware().explicit_state())));
  const std::size_t before = first.traces()[0].size();
  first.rest(0.2), second.rest(0.2);
  first.finish(), second.finish();
  const auto &a = first.traces()[0].speed, &b = second.traces()[0].speed;
  ASSERT_EQ(a.size(), before + b.size());
  for (std::size_t i = 0; i < b.size(); ++i) ASSERT_EQ(a[before + i], b[i]) << i;
}

TEST(ServoTest, ARenewalThatArrivesAfterTheEndStartsNothing) {
  SimulatedBench bench(parameters_with({}), {});
  auto request = of_axis_0(TestSignal::TORQUE_STEP);
  request.amplitude = 0.1, request.period = 0.02, request.duration = 0.1, request.number = 7,
  request.client = 5;
  auto* tester = bench.hardware().tester();
  EXPECT_EQ(tester->request(request), "");
  bench.rest(0.2);
  EXPECT_FALSE(tester->running());
  EXPECT_EQ(tester->request(request), "");
  EXPECT_FALSE(tester->running());
}

TEST(ServoTest, ParametersThatChangeEndIt) {
  SimulatedBench bench(parameters_with({}), {});
  bench.start(of_axis_0());
  bench.hardware().configure(bench.parameters(), machine::drive_axes(bench.parameters()), {}, 0.001);
  bench.rest(0.001);
  EXPECT_EQ(bench.phase(), TestPhase::ENDED_BY_STOP);
}

TEST(VibrationWatch, CountsStrokesThatDoNotDecay) {
  const auto ended = [](double decay, double frequency, double amplitude) {
    VibrationWatch watch;
    watch.start(0.01);
    for (int i = 0; i < 8000; ++i) {
      const double t = i * h;
      if (watch.step(amplitude * std::exp(decay * t) * std::sin(2 * std::numbers::pi * frequency * t), h))
        return true;
    }
    return false;
  };
  EXPECT_TRUE(ended(0, 100, 0.003)) << "a vibration that lasts";
  EXPECT_TRUE(ended(20, 100, 0.0001)) << "one that grows";
  EXPECT_FALSE(ended(-20, 100, 0.005)) << "what an acceleration has excited decays";
  EXPECT_FALSE(ended(0, 100, 0.001)) << "below a fifth of the limit";
  EXPECT_FALSE(ended(0, 5, 0.5)) << "a motion";
}

TEST(NotchFilter, IsTheAnalogueFilterBelowAQuarterOfTheSamplingRate) {
  const auto n = NotchFilter::at(400, 100, h);
  const auto response = [&](double f) {
    const Complex q = std::polar(1.0, -2 * std::numbers::pi * f * h);
    return (n.b0 + n.b1 * q + n.b2 * q * q) / (1.0 + n.a1 * q + n.a2 * q * q);
  };
  EXPECT_NEAR(std::abs(response(400)), 0, 1e-12);
  EXPECT_NEAR(std::abs(response(0)), 1, 1e-12);
  // 0.707 at 400 (sqrt(1 + u^2) +- u) with u = 1 / 8: 353.1 and 453.1 Hz; the bilinear transform moves them
  // by 2 %.
  EXPECT_NEAR(std::abs(response(353.1)), std::sqrt(0.5), 0.02);
  EXPECT_NEAR(std::abs(response(453.1)), std::sqrt(0.5), 0.02);
  EXPECT_FALSE(NotchFilter::at(0, 100, h).on);
  EXPECT_FALSE(NotchFilter::at(4000, 100, h).on) << "half of the sampling rate";
}

}  // namespace
}  // namespace trunnion::drive
