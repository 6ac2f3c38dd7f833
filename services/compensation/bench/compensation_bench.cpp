// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "../test/one_channel.hpp"

namespace trunnion::compensation {
namespace {

constexpr int letters[] = {0, 1, 2, 3, 5};

machine::Parameters five_axes(bool tables, bool volumetric) {
  auto p = axes({0, 1, 2, 3, 5});
  Set set{p};
  p.revision = 1;
  set(40425, 35), set(40426, -1), set(40431, -1), set(40433, 0.1), set(40435, -200), set(40437, -516);
  if (volumetric) set(40951, 2);
  for (const int letter : letters) {
    const auto base = 300000u + 1000u * static_cast<std::uint32_t>(letter);
    const auto other = letter == 0 ? 1 : 0;
    if (tables) {
      set(base, 2), set(base + 1, 0.01), set(base + 3, 0.02), set(base + 110, 1), set(base + 111, 0.01);
      set(base + 5, 3), set(base + 8, 2), set(base + 9, 10), set(base + 10, 0);
      set(base + 13, 2), set(base + 14, 10), set(base + 15, 1);
      set(base + 20, 2), set(base + 22, 50), set(base + 23, 20);
      for (const auto at : {30u, 40u}) set(base + at, 1), set(base + at + 1, other), set(base + at + 3, 0.01);
      for (const auto at : {50u, 65u})
        set(base + at, other), set(base + at + 1, 2), set(base + at + 3, 50), set(base + at + 4, 20);
      for (const auto at : {80u, 95u})
        set(base + at, other), set(base + at + 1, letter), set(base + at + 3, 2), set(base + at + 5, 50),
            set(base + at + 6, 20);
    }
    if (volumetric) set(base + 900, -400), set(base + 901, 20), set(base + 902, 40), set(base + 903, 2);
  }
  for (std::uint32_t i = 0; i < 1000; ++i) set(700000 + i, 1e-3 * ((i * 37) % 11));
  return p;
}

void cycle(benchmark::State& state, bool tables, bool volumetric) {
  Channel channel(five_axes(tables, volumetric));
  std::vector<double> rows;
  for (int i = 0; i < 16; ++i)
    for (const int letter : letters) rows.push_back(10.0 * letter + 0.05 * i);
  for (auto _ : state) benchmark::DoNotOptimize(channel.run(rows, 5).data());
  state.SetItemsProcessed(state.iterations() * 16);
}
BENCHMARK_CAPTURE(cycle, nothing, false, false);
BENCHMARK_CAPTURE(cycle, every_table, true, false);
BENCHMARK_CAPTURE(cycle, volumetric, false, true);
BENCHMARK_CAPTURE(cycle, every_table_and_volumetric, true, true);

}  // namespace
}  // namespace trunnion::compensation
