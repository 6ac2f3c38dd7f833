// SPDX-License-Identifier: Apache-2.0
// What a batch costs its writer so that it can be recorded, beside what it costs anyway: its encoding.
#include <benchmark/benchmark.h>

#include "bus/bus.hpp"
#include "contracts/types.hpp"

namespace trunnion::bus {
namespace {

// As the channel writes them in virtual time: 16 setpoints, and its state.
idl::stream::PathBatch batch() {
  idl::stream::PathBatch batch;
  batch.count = 16;
  batch.setpoints.assign(16 * 9, 1.5);
  batch.lines.assign(16, 1);
  batch.states.resize(1);
  batch.states[0].values.assign(40, 2.5);
  return batch;
}

void encoding(benchmark::State& state) {
  const auto value = batch();
  Bytes bytes;
  for ([[maybe_unused]] auto _ : state) {
    encode(value, bytes);
    benchmark::DoNotOptimize(bytes.data());
  }
}
BENCHMARK(encoding);

void encoding_and_keeping(benchmark::State& state) {
  const auto value = batch();
  const auto history = SharedHistory::make();
  Bytes bytes;
  for ([[maybe_unused]] auto _ : state) {
    encode(value, bytes);
    history->write(8, bytes);
  }
}
BENCHMARK(encoding_and_keeping);

}  // namespace
}  // namespace trunnion::bus
