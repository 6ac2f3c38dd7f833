// SPDX-License-Identifier: Apache-2.0
// One cycle of the executor: five simulated axes in motion, with a batch every eighth time.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "drive_core.hpp"
#include "simulated_hardware.hpp"

namespace trunnion::drive {
namespace {

constexpr std::uint16_t axes = 5;
constexpr std::uint32_t batch_cycles = 8;

machine::Parameters five_axes() {
  machine::Parameters p;
  p.revision = 1;
  for (std::uint32_t a = 0; a < axes; ++a) {
    p.values[40001 + a] = {static_cast<double>(a), ""};
    p.values[100000 + a * 1000] = {0, "A" + std::to_string(a)};
    p.values[100034 + a * 1000] = {60000, ""};
    p.values[100036 + a * 1000] = {4000, ""};
  }
  return p;
}

// 10 mm to and fro with at most 0.1 mm in a cycle.
void fill(idl::stream::AxisBatch& batch, std::uint64_t first) {
  batch.axes.clear(), batch.setpoints.clear();
  batch.epoch = 1, batch.first = first, batch.count = batch_cycles, batch.starts = first == 0;
  batch.revision = 1;
  for (std::uint16_t a = 0; a < axes; ++a) batch.axes.push_back(a);
  for (std::uint64_t n = first; n < first + batch_cycles; ++n)
    batch.setpoints.insert(batch.setpoints.end(), axes, 10 * std::sin(0.01 * static_cast<double>(n)));
}

void cycle(benchmark::State& state) {
  DriveCore core(std::make_unique<SimulatedHardware>());
  core.configure(five_axes(), true);
  core.set_enables({1, 1, 1, 1, 1}, false);
  core.request({0, 1, idl::stream::StreamRequestKind::NEW_EPOCH, 1, 0});
  idl::stream::AxisBatch batch;
  idl::stream::Feedback feedback;
  std::uint64_t written = 0;
  while (state.KeepRunning()) {
    for (; written < core.next() + 64; written += batch_cycles) {
      fill(batch, written);
      core.put(batch);
    }
    core.step();
    if (core.rows() >= batch_cycles) core.fill(feedback);
  }
  if (core.mode() != Mode::FOLLOWING || !core.any_active()) state.SkipWithError("the axes do not move");
}
BENCHMARK(cycle);

}  // namespace
}  // namespace trunnion::drive
