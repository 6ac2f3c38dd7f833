// SPDX-License-Identifier: Apache-2.0
// What a frame costs its writer so that it can be recorded, beside what it costs anyway: its encoding.
#include <benchmark/benchmark.h>

#include "bus/bus.hpp"
#include "contracts/types.hpp"

namespace trunnion::bus {
namespace {

// As the channel writes them in virtual time: 16 setpoints, and its state.
idl::stream::PathFrame frame() {
  idl::stream::PathFrame frame;
  frame.count = 16;
  frame.setpoints.assign(16 * 9, 1.5);
  frame.lines.assign(16, 1);
  frame.states.resize(1);
  frame.states[0].values.assign(40, 2.5);
  return frame;
}

void encoding(benchmark::State& state) {
  const auto value = frame();
  Bytes bytes;
  for ([[maybe_unused]] auto _ : state) {
    encode(value, bytes);
    benchmark::DoNotOptimize(bytes.data());
  }
}
BENCHMARK(encoding);

void encoding_and_keeping(benchmark::State& state) {
  const auto value = frame();
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
