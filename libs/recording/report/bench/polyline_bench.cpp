// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>

#include "report/polyline.hpp"

namespace trunnion::report {
namespace {

// A million pieces of a rosette, asked in order as a run asks.
void nearest_along_a_million_pieces(benchmark::State& state) {
  const auto at = [](double t) {
    return Vec3(100 * std::cos(t) * std::cos(7.01 * t), 100 * std::sin(t) * std::cos(7.01 * t),
                std::sin(3 * t));
  };
  Polyline path;
  constexpr int count = 1000000;
  path.start(at(0));
  for (int i = 1; i <= count; ++i) path.add({at(i * 2e-4), 1, false});
  path.build();
  std::size_t guess = 0;
  double t = 0;
  for (auto _ : state) {
    const auto near = path.nearest(at(t) + Vec3(1e-3, -1e-3, 1e-3), guess);
    guess = near.piece;
    t = t > 199 ? 0 : t + 1.3e-4;
    benchmark::DoNotOptimize(near.distance);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(nearest_along_a_million_pieces);

}  // namespace
}  // namespace trunnion::report
