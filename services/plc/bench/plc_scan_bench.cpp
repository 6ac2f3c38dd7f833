// SPDX-License-Identifier: Apache-2.0
// The delivered AC machine's logic, with everything the PLC does around its tasks: a scan in which nothing
// changes, one in which an input changes, and tool changes with the simulated devices.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "machine/parameters.hpp"
#include "plc_core.hpp"
#include "program_files.hpp"

namespace trunnion::plc {
namespace {

struct AcMachine {
  AcMachine() {
    machine::Parameters parameters;
    parameters.values[100000] = {0, "X"};
    parameters.values[110000] = {0, "S"}, parameters.values[110001] = {10, ""};
    core.configure(parameters, true);
    load_programs(TRUNNION_MACHINES "/ac-table/plc", core, true);
    feedback();
  }
  void feedback() {
    idl::stream::Feedback batch;
    batch.tick = tick;
    batch.channels.resize(1);
    batch.enabled = {1};
    batch.spindle_speed = {core.memory().spindle_command[0]};
    const auto& orient = core.outputs().spindle_orient;
    batch.spindle_oriented = {static_cast<std::uint8_t>(!orient.empty() && orient[0] != 0 ? 1 : 0)};
    core.set_feedback(batch);
    core.advance(tick);
  }
  /// Until the function is finished; false when the PLC waits for nothing any longer.
  bool finish(idl::channel::AuxiliaryKind kind, std::uint32_t code) {
    core.set_request({0, ++number, kind, code, 0, false, 0});
    core.advance(tick);
    for (;;) {
      const auto done = core.take_done();
      if (!done.empty()) return !done.back().failed;
      const auto until = core.outputs().run_until_tick;
      if (until <= tick) return false;
      tick = std::min(until, tick + 10);
      feedback();
    }
  }
  PlcCore core;
  std::uint64_t tick = 1;
  std::uint32_t number = 0;
};

benchmark::Counter seconds_of_one(double count) {
  return {count, benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
}

/// Ten scans of 1 ms, so that one of them has the main task; the counter is of one scan.
void scan_of_the_ac_machine(benchmark::State& state) {
  AcMachine machine;
  for (auto _ : state) machine.core.advance(machine.tick += 10);
  state.counters["scan"] = seconds_of_one(static_cast<double>(state.iterations()) * 10);
}
BENCHMARK(scan_of_the_ac_machine);

/// The key of single block is pressed or released: scans of all tasks at the same time until the image is
/// stable.
void changed_input_of_the_ac_machine(benchmark::State& state) {
  AcMachine machine;
  idl::plc::PanelRequest panel;
  panel.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
  panel.address = 101;
  for (auto _ : state) {
    panel.value ^= 1;
    machine.core.panel(panel);
    machine.core.advance(machine.tick);
  }
  state.counters["change"] = seconds_of_one(static_cast<double>(state.iterations()));
}
BENCHMARK(changed_input_of_the_ac_machine);

/// T and M6 in turn with two tools; the counter is of one millisecond of the PLC's time.
void tool_change_of_the_ac_machine(benchmark::State& state) {
  using enum idl::channel::AuxiliaryKind;
  AcMachine machine;
  const auto begin = machine.core.memory().scans;
  std::uint32_t tool = 1;
  for (auto _ : state) {
    tool = 6 - tool;
    if (!machine.finish(T, tool) || !machine.finish(M, 6)) return state.SkipWithError("no tool change");
  }
  state.counters["millisecond"] = seconds_of_one(static_cast<double>(machine.core.memory().scans - begin));
}
BENCHMARK(tool_change_of_the_ac_machine)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trunnion::plc
