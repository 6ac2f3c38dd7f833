// SPDX-License-Identifier: Apache-2.0
// The machine's own programs on the core: emergency stop and the inputs of the panel.
#include <gtest/gtest.h>

#include "core_bench.hpp"

namespace trunnion::plc {
namespace {

using enum AuxiliaryKind;
using idl::plc::PanelRequestKind;

// A PLC that hung when the button was pressed, or has started since, learns of the press from the drive.
TEST(EmergencyStop, APressThatTheDriveHoldsIsTakenOnce) {
  Bench bench;
  bench.run();
  ASSERT_FALSE(bench.core.emergency_stop());
  idl::stream::Feedback feedback;
  feedback.press_client = 7, feedback.press_number = 3;
  bench.core.set_feedback(feedback);
  EXPECT_TRUE(bench.core.outputs().presses.empty()) << "the programs have not run since";
  bench.step();
  EXPECT_TRUE(bench.core.emergency_stop());
  ASSERT_EQ(bench.core.outputs().presses, (std::vector<idl::plc::Press>{{7, 3}}));
  bench.core.panel({.kind = PanelRequestKind::RELEASE_EMERGENCY_STOP});
  bench.core.set_feedback(feedback);  // written before the drive had the outputs
  bench.core.panel({.client = 7, .number = 3, .kind = PanelRequestKind::PRESS_EMERGENCY_STOP});
  bench.step();
  bench.core.panel({.kind = PanelRequestKind::RESET_EMERGENCY_STOP});
  bench.step();
  EXPECT_FALSE(bench.core.emergency_stop()) << "no second press";
  bench.core.panel({.client = 7, .number = 4, .kind = PanelRequestKind::PRESS_EMERGENCY_STOP});
  bench.step();
  EXPECT_TRUE(bench.core.emergency_stop());
  EXPECT_EQ(bench.core.outputs().presses, (std::vector<idl::plc::Press>{{7, 4}, {7, 3}}));
}

TEST(EmergencyStop, LatchesUntilReleasedAndReset) {
  Bench bench;
  bench.request(S, 0, 500);
  bench.request(M, 3);
  bench.run();
  bench.request(M, 8);
  EXPECT_EQ(bench.core.outputs().axis_enable[0], 1);
  EXPECT_EQ(bench.core.outputs().axis_enable[1], 0);  // does not exist
  EXPECT_EQ(bench.core.outputs().axis_enable[2], 1);

  bench.core.panel({.kind = PanelRequestKind::PRESS_EMERGENCY_STOP});
  bench.step();
  auto outputs = bench.core.outputs();
  EXPECT_TRUE(outputs.emergency_stop);
  EXPECT_EQ(outputs.axis_enable, std::vector<std::uint8_t>(32, 0));
  EXPECT_EQ(outputs.spindle_speed[0], 0);
  EXPECT_EQ(outputs.coolant[0], 0);

  bench.core.panel({.kind = PanelRequestKind::RESET_EMERGENCY_STOP});
  bench.step();
  EXPECT_TRUE(bench.core.emergency_stop()) << "reset while the button is pressed";
  bench.core.panel({.kind = PanelRequestKind::RELEASE_EMERGENCY_STOP});
  bench.step();
  EXPECT_TRUE(bench.core.emergency_stop()) << "released but not reset";
  bench.core.panel({.kind = PanelRequestKind::RESET_EMERGENCY_STOP});
  bench.step();
  outputs = bench.core.outputs();
  EXPECT_FALSE(outputs.emergency_stop);
  EXPECT_EQ(outputs.axis_enable[0], 1);
  EXPECT_EQ(outputs.spindle_speed[0], 0) << "the spindle waits for a new command";
}

TEST(EmergencyStop, AFunctionUnderWayFails) {
  Bench bench;
  bench.request(M, 6);
  bench.core.panel({.kind = PanelRequestKind::PRESS_EMERGENCY_STOP});
  bench.step();
  ASSERT_EQ(bench.finished.size(), 1u);
  EXPECT_TRUE(bench.finished[0].failed);
}

TEST(EmergencyStop, WithoutAProgramTheOutputsAreSafe) {
  PlcCore core;
  core.configure(two_axes_and_spindles(), true);
  core.advance(100);
  EXPECT_TRUE(core.outputs().emergency_stop);
  EXPECT_EQ(core.outputs().axis_enable, std::vector<std::uint8_t>(32, 0));
}

idl::plc::PanelRequest force(std::uint32_t address, std::uint32_t value) {
  return {.kind = PanelRequestKind::FORCE_INPUT, .address = address, .value = value};
}

TEST(Panel, ForcesInputBytesWithinTheirBounds) {
  Bench bench;
  EXPECT_EQ(bench.core.panel(force(0, 4)), "");  // X0.2 is the feed hold button
  bench.step();
  EXPECT_TRUE(bench.core.outputs().feed_hold);
  EXPECT_EQ(bench.core.panel(force(512, 0)), "input byte 512 is outside 0 .. 511");
  EXPECT_EQ(bench.core.panel(force(0, 256)), "value 256 is outside 0 .. 255");
}

TEST(Panel, TheKeyOfAGantryTakesItsSlaveOffInJogAndInAnEmergencyStop) {
  Bench bench("gantry-cb-head");
  idl::channel::ChannelState state;
  state.mode = idl::channel::Mode::JOG;
  bench.core.set_channel(state);
  EXPECT_EQ(bench.core.panel(force(16, 64)), "");  // X16.6
  for (int i = 0; i < 20; ++i) bench.core.advance(++bench.tick);
  EXPECT_EQ(bench.core.outputs().axis_enable[2], 3) << "bit 0: enabled, bit 1: off its master";
  EXPECT_EQ(bench.core.outputs().axis_enable[0], 1);
  bench.core.panel({.kind = PanelRequestKind::PRESS_EMERGENCY_STOP});
  bench.step();
  EXPECT_EQ(bench.core.outputs().axis_enable[2], 2);
}

}  // namespace
}  // namespace trunnion::plc
