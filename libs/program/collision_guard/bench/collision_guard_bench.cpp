// SPDX-License-Identifier: Apache-2.0
// What the check of the bodies costs the planner: both in turn in one run, so that the ratio does not depend
// on what else the computer does.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "analysis/file_source.hpp"
#include "analysis/program_run.hpp"
#include "collision_guard/collision_guard.hpp"
#include "parameter_store/machine_tables.hpp"

namespace trunnion::collision_guard {
namespace {

const std::string machines = MACHINES_DIRECTORY;

void planner(benchmark::State& state, const std::string& bodies, const char* program) {
  using clock = std::chrono::steady_clock;
  const std::string directory = machines + "/ac-table";
  const auto tables = tool_tables::load_machine_tables(directory);
  channel_setup::ChannelSetup machine(tables);
  CollisionGuard guard(machine, CollisionMode::stop, {"bodies.yaml", bodies});
  guard.configure(tables.parameters, 0);
  std::vector<double> ratios;
  std::uint64_t blocks = 0;
  while (state.KeepRunning()) {
    const auto seconds = [&](program_execution::MoveGuard* with) {
      analysis::FileSource text(directory + "/programs/" + program);
      const auto begin = clock::now();
      const auto result =
          analysis::run_program(text, machine, machine.reference_position(), {}, {}, 100000000, with);
      if (!result.good) state.SkipWithError(result.alarm.c_str());
      blocks = result.blocks;
      return std::chrono::duration<double>(clock::now() - begin).count();
    };
    const double without = seconds(nullptr);
    ratios.push_back(seconds(&guard) / without);
  }
  std::sort(ratios.begin(), ratios.end());
  if (!ratios.empty()) state.counters["time_ratio"] = ratios[ratios.size() / 2];
  state.counters["blocks"] = static_cast<double>(blocks);
  state.counters["distances"] = static_cast<double>(guard.distances());
}

const std::string delivered = *load_bodies_text(machines + "/ac-table").text;
// 24 clamps in a ring around the part, over which the tool passes.
std::string with_clamps() {
  std::string text = delivered;
  char line[200];
  for (int i = 0; i < 24; ++i) {
    const double angle = i * std::numbers::pi / 12;
    std::snprintf(
        line, sizeof line,
        "  - {name: clamp %d, on: workpiece, box: {size_mm: [20, 20, 15]}, position_mm: [%.3f, %.3f, "
        "-392.5]}\n",
        i, 130 * std::cos(angle), 130 * std::sin(angle));
    text += line;
  }
  return text;
}
BENCHMARK_CAPTURE(planner, cone, delivered, "nas979_cone.nc")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(planner, cone_24_clamps, with_clamps(), "nas979_cone.nc")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(planner, s_piece_24_clamps, with_clamps(), "s_piece.nc")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trunnion::collision_guard
