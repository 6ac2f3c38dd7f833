// SPDX-License-Identifier: Apache-2.0
// One scan of the delivered AC machine's logic, with everything the PLC does around its tasks.
#include <benchmark/benchmark.h>

#include "machine/parameters.hpp"
#include "plc_core.hpp"
#include "program_files.hpp"

namespace trunnion::plc {
namespace {

/// Ten scans of 1 ms, so that one of them has the main task; the counter is of one scan.
void scan_of_the_ac_machine(benchmark::State& state) {
  machine::Parameters parameters;
  parameters.values[100000] = {0, "X"};
  PlcCore core;
  core.configure(parameters, true);
  load_programs(TRUNNION_MACHINES "/ac-table/plc", core, true);
  std::uint64_t tick = 1;
  core.advance(tick);
  for (auto _ : state) core.advance(tick += 10);
  state.counters["scan"] = benchmark::Counter(static_cast<double>(state.iterations()) * 10,
                                              benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(scan_of_the_ac_machine);

}  // namespace
}  // namespace trunnion::plc
