// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "../test/machines.hpp"
#include "geometry/direction_path.hpp"

namespace trunnion::geometry {
namespace {

constexpr double step = 0.01;  // degrees, so that no pose is the one before

void machine_from_tip(benchmark::State& state, const ChainParameters& p) {
  const Chain chain = make(p);
  Angles angles{12, 23, 34};
  while (state.KeepRunning()) {
    for (double& a : angles) a += step;
    benchmark::DoNotOptimize(chain.machine_from_tip(Vec3(1, 2, 3), angles, 100));
  }
}
BENCHMARK_CAPTURE(machine_from_tip, ac_table, ac_table());
BENCHMARK_CAPTURE(machine_from_tip, cb_head, cb_head());
BENCHMARK_CAPTURE(machine_from_tip, nutating_b_head_c_table, nutating_b_head_c_table());
BENCHMARK_CAPTURE(machine_from_tip, slanted_linear_axes, slanted_linear_axes());
BENCHMARK_CAPTURE(machine_from_tip, six_rotary_axes, six_rotary_axes());
BENCHMARK_CAPTURE(machine_from_tip, linear_axes_on_a_turning_column, linear_axes_on_a_turning_column());

void tip_from_machine(benchmark::State& state) {
  const Chain chain = make(ac_table());
  Angles angles{12, 0, 34};
  while (state.KeepRunning()) {
    for (double& a : angles) a += step;
    benchmark::DoNotOptimize(chain.tip_from_machine(Vec3(1, 2, 3), angles, 100));
  }
}
BENCHMARK(tip_from_machine);

void jacobian(benchmark::State& state) {
  const Chain chain = make(ac_table());
  Angles angles{12, 0, 34};
  while (state.KeepRunning()) {
    for (double& a : angles) a += step;
    benchmark::DoNotOptimize(chain.jacobian(Vec3(1, 2, 3), angles, 100));
  }
}
BENCHMARK(jacobian);

void derivatives_of_order_three(benchmark::State& state) {
  const Chain chain = make(ac_table());
  TipMotion motion;
  motion.tip = {Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9), Vec3(1, 1, 1)};
  for (auto& order : motion.angles) order = {12, 0, 34};
  while (state.KeepRunning()) {
    motion.angles[0][2] += step;
    benchmark::DoNotOptimize(chain.machine_derivatives(motion, 100));
  }
}
BENCHMARK(derivatives_of_order_three);

void orientation(benchmark::State& state, const ChainParameters& p) {
  const Chain chain = make(p);
  const OrientationSolver solver(chain);
  OrientationRequest request;
  for (auto& t : request.travel) t = {-380, 380};
  Vec3 direction(0.1, -0.2, 0.9);
  while (state.KeepRunning()) {
    direction.x() += 1e-7;
    request.direction = direction;
    benchmark::DoNotOptimize(solver.best(request));
  }
}
BENCHMARK_CAPTURE(orientation, ac_table, ac_table());
BENCHMARK_CAPTURE(orientation, cb_head, cb_head());
BENCHMARK_CAPTURE(orientation, nutating_b_head_c_table, nutating_b_head_c_table());
BENCHMARK_CAPTURE(orientation, ac_table_with_b_head, ac_table_with_b_head());

void every_orientation(benchmark::State& state) {
  const Chain chain = make(cb_head());
  const OrientationSolver solver(chain);
  OrientationRequest request;
  request.direction = Vec3(0.1, -0.2, 0.9);
  for (auto& t : request.travel) t = {-380, 380};
  std::array<Orientation, OrientationSolver::most_solutions> out;
  OrientationAnswer answer;
  while (state.KeepRunning()) benchmark::DoNotOptimize(solver.all(request, out, answer));
}
BENCHMARK(every_orientation);

DirectionPathRequest past_the_pole() {
  DirectionPathRequest request;
  request.from = Vec3(0.0005, -0.4, 1);
  request.to = Vec3(0.0005, 0.4, 1);
  return request;
}

void direction_path(benchmark::State& state) {
  const OrientationSolver solver(make(ac_table()));
  const auto request = past_the_pole();
  while (state.KeepRunning()) benchmark::DoNotOptimize(DirectionPath::make(solver, request));
}
BENCHMARK(direction_path);

void derivatives_on_direction_path(benchmark::State& state) {
  const OrientationSolver solver(make(ac_table()));
  const auto path = std::get<DirectionPath>(DirectionPath::make(solver, past_the_pole()));
  double s = 0;
  while (state.KeepRunning()) {
    s = s > 0.3 ? 0 : s + 1e-6;
    benchmark::DoNotOptimize(path.derivatives(s));
  }
}
BENCHMARK(derivatives_on_direction_path);

}  // namespace
}  // namespace trunnion::geometry
