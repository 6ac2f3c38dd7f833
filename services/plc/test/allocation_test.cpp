// SPDX-License-Identifier: Apache-2.0
// The core of the PLC allocates nothing in its scans, whatever its inputs do.
#include "testing_support/allocation_count.hpp"

#include <gtest/gtest.h>

#include <random>

#include "machine/parameters.hpp"
#include "plc_core.hpp"
#include "program_files.hpp"
#include "task_times.hpp"

namespace trunnion::plc {
namespace {

using testing_support::allocations;

// Half of the requests are functions that the programs finish by themselves, others wait for simulated
// devices.
TEST(PlcAllocation, NoneInTheScansOfTheAcMachineWhileItsInputsChange) {
  machine::Parameters parameters;
  for (const std::uint32_t axis : {100000u, 101000u, 102000u}) parameters.values[axis] = {0, "X"};
  parameters.values[110000] = {0, "S"}, parameters.values[110001] = {10, ""};
  PlcCore core;
  core.configure(parameters, true);
  ASSERT_TRUE(load_programs(TRUNNION_MACHINES "/ac-table/plc", core, true).empty());
  TaskTimes times([]() -> std::uint64_t { return 0; });
  core.set_task_times(&times);
  std::mt19937_64 random(11);
  std::uint64_t tick = 1000;
  std::uint32_t number = 0;
  std::size_t finished = 0, inputs = 0, allocated = 0;
  idl::stream::Feedback feedback;
  feedback.channels.resize(1);
  feedback.enabled = {1, 1, 1};
  feedback.position = {0, 0, 0};
  core.advance(tick);
  for (int step = 0; step < 3000; ++step) {
    idl::plc::PanelRequest panel;
    panel.kind = static_cast<idl::plc::PanelRequestKind>(random() % 4);
    panel.address = static_cast<std::uint32_t>(random() % 128),
    panel.value = static_cast<std::uint32_t>(random() % 256);
    idl::channel::ChannelState state;
    state.state = static_cast<idl::channel::RunState>(random() % 3);
    state.mode = static_cast<idl::channel::Mode>(random() % 3);
    state.reset_count = static_cast<std::uint32_t>(step / 100);
    constexpr std::uint32_t codes[] = {3, 4, 5, 6, 8, 9, 10, 19, 30, 40};
    using enum AuxiliaryKind;
    const idl::channel::AuxiliaryRequest request{0,
                                                 ++number,
                                                 random() % 4 == 0 ? T : random() % 4 == 0 ? S : M,
                                                 codes[random() % std::size(codes)],
                                                 500,
                                                 false,
                                                 10};
    feedback.tick = tick, feedback.first = static_cast<std::uint64_t>(step);
    feedback.position[0] = static_cast<double>(random() % 1000), feedback.skip_inputs = random() % 2;
    feedback.spindle_speed.assign(1, core.memory().spindle_command[0]);
    const auto until = core.outputs().run_until_tick;
    const auto before = allocations;
    if (step % 3 == 0) core.panel(panel);
    if (step % 7 == 0) core.set_channel(state);
    if (step % 20 == 0) core.set_request(request), core.set_request(request);
    core.set_feedback(feedback);
    core.set_alarms(step % 50 == 0, false);
    core.advance(tick);
    tick = std::max(tick + random() % 20, std::min(until, tick + 300));
    core.advance(tick);
    allocated += allocations - before;
    inputs += core.memory().registers.x[panel.address];
    finished += core.take_done().size();
  }
  EXPECT_EQ(allocated, 0u);
  EXPECT_GT(finished, 5u);
  EXPECT_GT(inputs, 0u);
  EXPECT_FALSE(core.has_program_fault()) << core.program_fault();
}

}  // namespace
}  // namespace trunnion::plc
