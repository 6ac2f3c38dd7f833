// SPDX-License-Identifier: Apache-2.0
// Position loop over the load encoder: sign, pulses, dual loop, damping, difference of the encoders.
#include <gtest/gtest.h>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "servo_analysis/frequency_response.hpp"
#include "simulated_bench.hpp"
#include "two_axes.hpp"

namespace trunnion::drive {
namespace {

struct FullClosed {
  FullClosed() {
    parameters.values[parameter::full_closed_loop.number(0)] = {1, ""};
    truth.mechanics.emplace();
    truth.mechanics->locked_frequency = 60, truth.mechanics->damping_ratio = 0.04;
    truth.mechanics->coulomb = truth.mechanics->breakaway = 0.03;
    truth.load.emplace();
  }
  void set(std::uint32_t number, double value) { parameters.values[number] = {value, ""}; }
  SimulatedBench bench() const { return {parameters, {{"X", truth}}}; }
  machine::Parameters parameters = two_axes();
  truth::DriveTruth truth;
};

double following_error(SimulatedBench& bench) {
  DriveStatus status;
  bench.hardware().status(status);
  return std::abs(status.axes[0].following_error);
}

double difference(SimulatedBench& bench) {
  DriveStatus status;
  bench.hardware().status(status);
  return std::abs(status.axes[0].encoder_difference);
}

TEST(FullClosedLoop, AScaleMountedTheWrongWayRoundIsCuredByItsSign) {
  FullClosed axis;
  axis.truth.load->inverted = true;
  auto wrong = axis.bench();
  wrong.by(1, 10, 4000);
  EXPECT_GT(following_error(wrong), 1) << "it runs away";
  axis.set(parameter::load_encoder_reversed.number(0), 1);
  axis.set(parameter::position_gain.number(0), 20);
  auto cured = axis.bench();
  cured.by(1, 10, 4000);
  cured.rest(0.5);
  EXPECT_LT(following_error(cured), 0.001);
}

TEST(FullClosedLoop, TheDifferenceOfTheEncodersStopsTheAxisBeforeItRunsAway) {
  FullClosed axis;
  axis.truth.load->inverted = true;
  axis.set(parameter::encoder_difference_limit.number(0), 0.5);
  axis.set(parameter::following_error_limit.number(0), 0);
  DriveCore core(
      std::make_unique<SimulatedHardware>(std::map<std::string, truth::DriveTruth>{{"X", axis.truth}}));
  core.configure(axis.parameters, false);
  core.set_enables({1, 1}, false);
  core.request({0, 1, idl::stream::StreamRequestKind::NEW_EPOCH, 1});
  // To X1 in 400 cycles.
  std::vector<DriveEvent> events;
  const std::uint64_t start = core.next();
  for (std::uint64_t first = start; first < start + 400 && events.empty(); first += 8) {
    idl::stream::AxisBatch batch;
    batch.epoch = 1, batch.first = first, batch.count = 8, batch.revision = 1, batch.axes = {0, 1};
    batch.starts = first == start, batch.ends = first + 8 == start + 400;
    for (std::uint64_t n = first + 1; n <= first + 8; ++n)
      batch.setpoints.insert(batch.setpoints.end(), {static_cast<double>(n - start) / 400, 0});
    core.put(batch);
    for (int i = 0; i < 8; ++i) core.step();
    events = core.take_events();
  }
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].alarm->number, alarm::encoder_difference.number);
  EXPECT_EQ(events[0].text.substr(0, 44), "Axis X: motor and load encoder differ by 0.5");
}

TEST(FullClosedLoop, InSemiClosedLoopAWrongSignIsSeenAndDoesNoHarm) {
  FullClosed axis;
  axis.truth.load->inverted = true;
  axis.set(parameter::full_closed_loop.number(0), 0);
  auto bench = axis.bench();
  bench.by(2, 10, 4000);
  EXPECT_LT(following_error(bench), 0.01);
  // The motor has moved by 2 mm, the scale counts 2 mm backwards.
  EXPECT_NEAR(difference(bench), 4, 0.02);
}

TEST(FullClosedLoop, PulsesPerRevolutionGiveTheTravel) {
  FullClosed axis;
  axis.truth.load->resolution = 1e-4;  // 100000 pulses for the 10 mm of a revolution
  axis.set(parameter::position_gain.number(0), 20);
  axis.set(parameter::load_encoder_pulses.number(0), 100000);
  auto right = axis.bench();
  right.by(5, 10, 4000);
  right.rest(0.5);
  EXPECT_LT(difference(right), 0.005);
  axis.set(parameter::load_encoder_pulses.number(0), 50000);  // every pulse counts for twice its length
  auto wrong = axis.bench();
  wrong.by(5, 10, 4000);
  wrong.rest(0.5);
  EXPECT_NEAR(difference(wrong), 2.5, 0.01) << "the axis moves by half";
}

TEST(FullClosedLoop, AMotorThatTurnsTheOtherWayDoesNotTurnTheScaleRound) {
  FullClosed axis;
  axis.truth.load->resolution = 1e-4;
  axis.set(parameter::position_gain.number(0), 20);
  axis.set(parameter::load_encoder_pulses.number(0), 100000);
  axis.set(parameter::travel_per_revolution.number(0), -10000);
  auto bench = axis.bench();
  bench.by(5, 10, 4000);
  bench.rest(0.5);
  EXPECT_LT(difference(bench), 0.005);
  EXPECT_LT(following_error(bench), 0.001);
}

// Largest error of the feedback in the last 0.2 s at constant speed: of a loop that vibrates it is large.
double roughness(const FullClosed& axis) {
  auto bench = axis.bench();
  idl::servo::TestRequest request;
  request.axes = {0}, request.decimation = 8;
  bench.start(request);
  auto at = bench.positions();
  for (int i = 0; i < 1000; ++i) at[0] += 0.02, bench.to(at);
  bench.finish();
  const auto& t = bench.traces()[0];
  double low = 1e9, high = -1e9;
  for (std::size_t i = 800; i < 1000; ++i) {
    const double e = t.setpoint[i] - t.load[i];
    low = std::min(low, e), high = std::max(high, e);
  }
  return high - low;
}

TEST(FullClosedLoop, TheDualLoopIsStillWhereTheScaleAloneVibrates) {
  FullClosed axis;
  // With a stiff motor the load damps 2 * 0.04 * 377 = 30 1/s.
  axis.set(parameter::speed_gain.number(0), 2000);
  axis.set(parameter::position_gain.number(0), 60);
  EXPECT_GT(roughness(axis), 0.05);
  axis.set(parameter::dual_loop_time.number(0), 10);
  EXPECT_LT(roughness(axis), 0.002);
  // At rest the load is where it should be, in spite of a screw error of 0.5 mm/m.
  axis.truth.mechanics->screw.terms.polynomials.push_back({0, 1000, {0, 0.5}});
  auto bench = axis.bench();
  bench.by(50, 50, 4000);
  EXPECT_LT(following_error(bench), 0.01);
  bench.rest(1);
  // Without the scale 25 um would be left; the Coulomb friction holds a part of 0.03 of the torque.
  EXPECT_NEAR(difference(bench), 0.025, 0.003);
  EXPECT_LT(following_error(bench), 0.001);
}

TEST(FullClosedLoop, DampingCalmsTheLoad) {
  // Largest response of the spring's stretch to the torque of a soft drive.
  const auto peak = [](double gain) {
    FullClosed axis;
    axis.truth.mechanics->coulomb = axis.truth.mechanics->breakaway = 0;
    axis.set(parameter::full_closed_loop.number(0), 0);
    axis.set(parameter::speed_gain.number(0), 20);
    axis.set(parameter::position_gain.number(0), 2);
    axis.set(parameter::damping_gain.number(0), gain);
    auto bench = axis.bench();
    idl::servo::TestRequest request;
    request.axes = {0}, request.signal = idl::servo::TestSignal::TORQUE_CHIRP;
    request.amplitude = 0.05, request.first_frequency = 1, request.last_frequency = 200, request.period = 1;
    bench.start(request);
    bench.rest(4);
    bench.finish();
    const auto& t = bench.traces()[0];
    std::vector<double> stretch(t.size());
    for (std::size_t i = 0; i < t.size(); ++i) stretch[i] = t.motor[i] - t.load[i];
    return servo_analysis::resonance_peak(
        servo_analysis::frequency_response(t.excitation, stretch, t.interval, {16000, 8000, 2, 50, 150}));
  };
  // Two equal masses of 0.5: their vibration of 60 sqrt(2) = 85 Hz is damped with 2 * 0.0566 * 533 = 60 1/s,
  // and by the motor alone with 200 / 0.5 = 400 1/s more. The drive's gain of 20 adds a little to both.
  const double ratio = peak(200) / peak(0);
  EXPECT_NEAR(ratio, (60.0 + 20) / (60 + 20 + 400), 0.05);
}

TEST(FullClosedLoop, AnAxisWithoutTruthHasALoadEncoderToo) {
  auto p = two_axes();
  p.values[parameter::full_closed_loop.number(0)] = {1, ""};
  p.values[parameter::mechanical_backlash.number(0)] = {0.02, ""};
  SimulatedBench bench(p, {});
  bench.by(10, 10, 4000);
  bench.by(-5, 10, 4000);
  bench.rest(1);
  EXPECT_LT(following_error(bench), 0.001) << "of the load, behind the backlash";
}

TEST(FrictionCompensation, MakesTheReversalBetter) {
  auto p = two_axes();
  std::map<std::string, truth::DriveTruth> truth;
  truth["X"].mechanics.emplace();
  truth["X"].mechanics->locked_frequency = 150;
  truth["X"].mechanics->coulomb = truth["X"].mechanics->breakaway = 0.05;
  const auto jump = [&](double compensation) {
    p.values[parameter::friction_compensation.number(0)] = {compensation, ""};
    SimulatedBench bench(p, truth);
    idl::servo::TestRequest request;
    request.axes = {0}, request.decimation = 8;
    bench.start(request);
    bench.circle(20, 447.0 / 60);
    bench.finish();
    return servo_analysis::reversal_jump(bench.traces()[0], 0.4);
  };
  EXPECT_LT(jump(0.05), 0.4 * jump(0));
}

}  // namespace
}  // namespace trunnion::drive
