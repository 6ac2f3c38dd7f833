// SPDX-License-Identifier: Apache-2.0
// What runs in every period allocates nothing.
#include <gtest/gtest.h>

#include "probe_input.hpp"
#include "simulated_axis.hpp"
#include "testing_support/allocation_count.hpp"
#include "truth/random_machine.hpp"

namespace trunnion::drive {
namespace {

TEST(Allocation, APeriodOfAnElasticAxisAndThePoseOfTheToolAllocateNothing) {
  truth::DriveTruth drive;
  drive.mechanics.emplace();
  drive.mechanics->backlash = 0.01, drive.mechanics->cogging = 0.01;
  drive.mechanics->screw.terms.harmonics.push_back({10, 0.002, 0});
  drive.load.emplace();
  drive.load->kind = truth::EncoderKind::distance_coded;
  drive.load->first_mark = -500, drive.load->signal_period = 0.02, drive.load->sine_offset = 0.01;
  SimulatedAxis axis;
  axis.configure({}, &drive);
  axis.place(0);
  machine::MachineOutline machine;
  machine.design.table_2 = geometry::RotaryAxis{-truth::Vec3::UnitZ(), truth::Vec3::Zero(), 2};
  for (const std::size_t i : {0u, 1u, 2u}) machine.axes[i] = {true, -400, 400};
  const auto geometry = std::get<truth::TrueGeometry>(
      truth::TrueGeometry::make(machine.design, truth::draw_machine(truth::grades()[1], 7, machine)));
  truth::WarmUp warm;
  truth::MachinePose pose;
  AxisSetpoint setpoint{0, 50, 0};
  const auto before = testing_support::allocations;
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    setpoint.position += 0.05;
    axis.step(setpoint, 0.001);
    pose.positions[0] = axis.load();
    warm.step(geometry.errors().heat, {50, 0, 0}, 0.001);
    pose.temperatures = warm.temperatures();
    sum += geometry.pose(pose).tip.x();
  }
  EXPECT_EQ(testing_support::allocations, before) << sum;
}

TEST(Allocation, APeriodWithTheProbeOnAllocatesNothing) {
  struct NoEdges : EncoderRowSink {
    void skip_edge(std::uint64_t, const idl::stream::SkipEdge&) override { FAIL() << "it touches nothing"; }
    void encoder_row(const EncoderRow&) override {}
  } rows;
  machine::MachineOutline machine;
  machine.design.table_2 = geometry::RotaryAxis{-truth::Vec3::UnitZ(), truth::Vec3::Zero(), 2};
  for (const std::size_t i : {0u, 1u, 2u}) machine.axes[i] = {true, -400, 400};
  touch_probe::TouchProbeTruth probe;
  probe.lobing = 0.001;
  ProbeInput input({machine.design,
                    std::get<truth::TrueGeometry>(truth::TrueGeometry::make(
                        machine.design, truth::draw_machine(truth::grades()[1], 7, machine))),
                    probe,
                    {touch_probe::SphereGauge{truth::Vec3(0, 0, -500), 12.5}, touch_probe::CuboidGauge{}}});
  std::vector<SimulatedAxis> servos(4);
  const std::vector<SimulatedSpindle> spindles(1);
  SetpointRow row;
  row.axes.resize(4);
  row.probe_on = true;
  input.step(row, 0.001, servos, spindles, rows);
  const auto before = testing_support::allocations;
  for (int i = 0; i < 1000; ++i) input.step(row, 0.001, servos, spindles, rows);
  EXPECT_EQ(testing_support::allocations, before);
}

}  // namespace
}  // namespace trunnion::drive
