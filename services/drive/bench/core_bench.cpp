// SPDX-License-Identifier: Apache-2.0
// One cycle of the executor: five simulated axes in motion, with a frame every eighth time.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "drive_core.hpp"
#include "simulated_hardware.hpp"

namespace trunnion::drive {
namespace {

constexpr std::uint16_t axes = 5;
constexpr std::uint32_t frame_cycles = 8;

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
void fill(idl::stream::AxisFrame& frame, std::uint64_t first) {
  frame.axes.clear(), frame.setpoints.clear();
  frame.epoch = 1, frame.first = first, frame.count = frame_cycles, frame.starts = first == 0;
  frame.revision = 1;
  for (std::uint16_t a = 0; a < axes; ++a) frame.axes.push_back(a);
  for (std::uint64_t n = first; n < first + frame_cycles; ++n)
    frame.setpoints.insert(frame.setpoints.end(), axes, 10 * std::sin(0.01 * static_cast<double>(n)));
}

void cycle(benchmark::State& state) {
  DriveCore core(std::make_unique<SimulatedHardware>());
  core.configure(five_axes(), true);
  core.set_enables({1, 1, 1, 1, 1}, false);
  core.request({0, 1, idl::stream::StreamRequestKind::NEW_EPOCH, 1, 0});
  idl::stream::AxisFrame frame;
  idl::stream::FeedbackFrame feedback;
  std::uint64_t written = 0;
  while (state.KeepRunning()) {
    for (; written < core.next() + 64; written += frame_cycles) {
      fill(frame, written);
      core.put(frame);
    }
    core.step();
    if (core.rows() >= frame_cycles) core.fill(feedback);
  }
  if (core.mode() != Mode::FOLLOWING || !core.any_active()) state.SkipWithError("the axes do not move");
}
BENCHMARK(cycle);

}  // namespace
}  // namespace trunnion::drive
