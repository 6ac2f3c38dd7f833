// SPDX-License-Identifier: Apache-2.0
// One period of 1 ms of one simulated axis.
#include <benchmark/benchmark.h>

#include "simulated_axis.hpp"

namespace trunnion::drive {
namespace {

void period(benchmark::State& state, const truth::DriveTruth* truth) {
  SimulatedAxis axis;
  ServoParameters parameters;
  parameters.full_closed_loop = truth != nullptr && truth->load.has_value();
  axis.configure(parameters, truth);
  axis.place(0);
  AxisSetpoint setpoint{0, 50, 0};
  while (state.KeepRunning()) {
    setpoint.position += 0.05;
    axis.step(setpoint, 0.001);
    benchmark::DoNotOptimize(axis.load());
  }
}

truth::DriveTruth elastic(bool faults) {
  truth::DriveTruth truth;
  truth.mechanics.emplace();
  truth.mechanics->coulomb = 0.05, truth.mechanics->breakaway = 0.08, truth.mechanics->backlash = 0.01;
  if (!faults) return truth;
  truth.mechanics->cogging = 0.01;
  truth.mechanics->screw.terms.harmonics.push_back({10, 0.002, 0});
  truth.load.emplace();
  truth.load->kind = truth::EncoderKind::distance_coded;
  truth.load->first_mark = -1000;
  truth.load->signal_period = 0.02, truth.load->sine_offset = 0.01;
  return truth;
}

const truth::DriveTruth simple = elastic(false), full = elastic(true);
BENCHMARK_CAPTURE(period, servo_axis, nullptr);
BENCHMARK_CAPTURE(period, two_masses, &simple);
BENCHMARK_CAPTURE(period, two_masses_with_a_faulty_scale, &full);

}  // namespace
}  // namespace trunnion::drive
