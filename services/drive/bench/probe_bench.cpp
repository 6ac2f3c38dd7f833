// SPDX-License-Identifier: Apache-2.0
// One period of the touch probe on a five-axis machine with a trunnion table.
#include <benchmark/benchmark.h>

#include "probe_input.hpp"
#include "truth/random_machine.hpp"

namespace trunnion::drive {
namespace {

struct NoRows : EncoderRowSink {
  void skip_edge(std::uint64_t, const idl::stream::SkipEdge&) override {}
  void encoder_row(const EncoderRow&) override {}
};

void probe(benchmark::State& state, bool on, bool worn) {
  machine::MachineOutline machine;
  machine.design.table_1 = geometry::RotaryAxis{truth::Vec3(-1, 0, 0), truth::Vec3(0, 0.1, 0), 0};
  machine.design.table_2 = geometry::RotaryAxis{truth::Vec3(0, 0, -1), truth::Vec3(-200, -190, -516), 2};
  for (const std::size_t i : {0u, 1u, 2u}) machine.axes[i] = {true, -400, 400};
  const auto errors = worn ? truth::draw_machine(truth::grades()[1], 7, machine) : truth::GeometryTruth{};
  touch_probe::TouchProbeTruth truth;
  truth.lobing = 0.001;
  ProbeInput input({machine.design,
                    std::get<truth::TrueGeometry>(truth::TrueGeometry::make(machine.design, errors)),
                    truth,
                    {touch_probe::SphereGauge{truth::Vec3(0, 0, -500), 12.5, -truth::Vec3::UnitZ(), 5, 60}}});
  machine::Parameters p;
  const char* const names[] = {"X", "Y", "Z", "A", "C"};
  const std::uint32_t letters[] = {1, 2, 3, 4, 6};
  for (std::uint32_t a = 0; a < 5; ++a) {
    p.values[40000 + letters[a]] = {static_cast<double>(a), ""};
    p.values[100000 + a * 1000] = {0, names[a]};
    if (a > 2) p.values[100001 + a * 1000] = {3, ""};
  }
  input.configure(p, machine::drive_axes(p));
  std::vector<SimulatedAxis> servos(5);
  const std::vector<SimulatedSpindle> spindles(1);
  SetpointRow row;
  row.axes.resize(5);
  row.probe_on = on;
  NoRows rows;
  double x = 0;
  while (state.KeepRunning()) {
    x = x < 50 ? x + 0.01 : 0;
    for (auto& servo : servos) servo.place(x);
    input.step(row, 0.001, servos, spindles, rows);
  }
}
BENCHMARK_CAPTURE(probe, off, false, true);
BENCHMARK_CAPTURE(probe, on_ideal_machine, true, false);
BENCHMARK_CAPTURE(probe, on_worn_machine, true, true);

}  // namespace
}  // namespace trunnion::drive
