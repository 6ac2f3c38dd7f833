// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "truth/random_machine.hpp"

namespace trunnion::truth {
namespace {

geometry::ChainParameters ac_table() {
  geometry::ChainParameters p;
  p.table_1 = geometry::RotaryAxis{Vec3(-1, 0, 0), Vec3(0, 0.1, 0), 0};
  p.table_2 = geometry::RotaryAxis{Vec3(0, 0, -1), Vec3(-200, -190, -516), 2};
  return p;
}

void pose(benchmark::State& state, bool ideal) {
  machine::MachineOutline machine;
  machine.design = ac_table();
  for (const std::size_t i : {0u, 1u, 2u}) machine.axes[i] = {true, -400, 400};
  const auto truth = ideal ? GeometryTruth{} : draw_machine(grades()[1], 7, machine);
  const auto geometry = std::get<TrueGeometry>(TrueGeometry::make(machine.design, truth));
  MachinePose p;
  p.positions = {12, 23, 34, 45, 0, 56, 0, 0, 0};
  while (state.KeepRunning()) {
    for (double& x : p.positions) x += 0.01;
    benchmark::DoNotOptimize(geometry.pose(p));
  }
}
BENCHMARK_CAPTURE(pose, chain, true);
BENCHMARK_CAPTURE(pose, worn_trunnion, false);

}  // namespace
}  // namespace trunnion::truth
