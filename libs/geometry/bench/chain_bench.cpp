#include <benchmark/benchmark.h>

#include "geometry/chain.hpp"

namespace trunnion::geometry {
namespace {

Chain ac_table() {
  ChainParameters p;
  p.table_1 = RotaryAxis{Vec3(-1, 0, 0), Vec3(0, 0.1, 0), 0};
  p.table_2 = RotaryAxis{Vec3(0, 0, -1), Vec3(-200, -190, -516), 2};
  return std::get<Chain>(Chain::make(p));
}

void machine_from_tip(benchmark::State& state) {
  const Chain chain = ac_table();
  Angles angles{12, 0, 34};
  for (auto _ : state) {
    angles[2] += 0.01;
    benchmark::DoNotOptimize(chain.machine_from_tip(Vec3(1, 2, 3), angles, 100));
  }
}
BENCHMARK(machine_from_tip);

void jacobian(benchmark::State& state) {
  const Chain chain = ac_table();
  Angles angles{12, 0, 34};
  for (auto _ : state) {
    angles[2] += 0.01;
    benchmark::DoNotOptimize(chain.jacobian(Vec3(1, 2, 3), angles, 100));
  }
}
BENCHMARK(jacobian);

}  // namespace
}  // namespace trunnion::geometry
