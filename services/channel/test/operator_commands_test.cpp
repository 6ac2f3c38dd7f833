// SPDX-License-Identifier: Apache-2.0
// The table of operator commands says in which modes a command is accepted and whether while the channel is
// busy: the channel does as it says.
#include "channel_fixture.hpp"
#include "commands/command_table.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::ChannelRequest;
using testing::CommandKind;
using testing::FakeDrive;

// Within the limits of every command.
ChannelRequest valid(CommandKind command) {
  return {.command = command,
          .program = "part.nc",
          .block = "G91 G1 X1 F100",
          .line = 1,
          .on = true,
          .fraction = 1,
          .speed = 100,
          .increment = 0.1,
          .press = 1,
          .counts = 1,
          .axes = 1,
          .levels = 1};
}

struct OperatorCommands : Channel {
  void begin_anew() {
    drive = FakeDrive{3};
    begin();
  }
  void set(Mode mode) { ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, mode).accepted); }
};

TEST_F(OperatorCommands, AreRefusedInTheModesThatTheTableLeavesOut) {
  int restricted = 0;
  for (const auto& row : commands::channel_commands()) {
    if (row.modes.empty()) continue;
    ++restricted;
    for (const auto mode : {Mode::AUTO, Mode::MDI, Mode::JOG, Mode::REF}) {
      begin_anew();
      load("G90 G1 X5 F1000\nM30\n");
      set(mode);
      const bool named = std::find(row.modes.begin(), row.modes.end(), mode) != row.modes.end();
      const auto answer = ask(valid(row.kind));
      EXPECT_EQ(answer.accepted, named)
          << bus::to_string(row.kind) << " in " << bus::to_string(mode) << ": " << answer.reason;
    }
  }
  EXPECT_GE(restricted, 4);
}

TEST_F(OperatorCommands, AreRefusedInAProgramUnlessTheTableSaysThatBusyDoesNotMatter) {
  int refused = 0;
  for (const auto& row : commands::channel_commands()) {
    if (row.busy) continue;
    ++refused;
    begin_anew();
    load("G90 G1 X300 F1000\nM30\n");
    cycles_per_round = 8;
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    for (int i = 0; i < 5; ++i) round();
    ASSERT_EQ(core->run_state(), RunState::RUNNING);
    EXPECT_FALSE(ask(valid(row.kind)).accepted) << bus::to_string(row.kind);
    EXPECT_EQ(core->run_state(), RunState::RUNNING) << bus::to_string(row.kind);
  }
  EXPECT_GE(refused, 8);
}

TEST_F(OperatorCommands, StepsOfAnOverrideAddUpAndEndAtItsLimits) {
  struct Row {
    CommandKind step;
    double idl::channel::ChannelState::*shown;
    double least, most;
  };
  const auto step = [&](const Row& row, double by) {
    auto request = valid(row.step);
    request.fraction = by;
    EXPECT_TRUE(ask(request).accepted);
    return core->state().*row.shown;
  };
  for (const Row& row :
       {Row{CommandKind::FEED_OVERRIDE_STEP, &idl::channel::ChannelState::feed_override, 0, 1.5},
        Row{CommandKind::RAPID_OVERRIDE_STEP, &idl::channel::ChannelState::rapid_override, 0, 1},
        Row{CommandKind::SPINDLE_OVERRIDE_STEP, &idl::channel::ChannelState::spindle_override, 0.5, 1.5}}) {
    begin_anew();
    ASSERT_EQ(core->state().*row.shown, 1);
    // Two in a row, sent before either is shown, are both done: 1 - 0.1 - 0.1.
    auto first = valid(row.step);
    first.fraction = -0.1;
    EXPECT_TRUE(ask(first).accepted);
    EXPECT_EQ(step(row, -0.1), 0.8);
    EXPECT_EQ(step(row, 0.1), 0.9);
    for (int i = 0; i < 11; ++i) step(row, -0.1);
    EXPECT_EQ(core->state().*row.shown, row.least);
    EXPECT_DOUBLE_EQ(step(row, 0.05), row.least + 0.05);
    for (int i = 0; i < 16; ++i) step(row, 0.1);
    EXPECT_EQ(core->state().*row.shown, row.most);
    EXPECT_DOUBLE_EQ(step(row, -0.05), row.most - 0.05);
  }
}

TEST_F(OperatorCommands, OutsideTheirLimitsAreRefusedAndChangeNothing) {
  set(Mode::JOG);
  auto request = valid(CommandKind::JOG_AXIS);
  request.speed = 0;
  EXPECT_EQ(ask(request).reason, "speed must not be 0: its sign is the direction");
  request = valid(CommandKind::HANDWHEEL);
  request.increment = 0.5;
  EXPECT_EQ(ask(request).reason, "increment 0.5 must be one of 0.001, 0.01, 0.1, 1");
  request = valid(CommandKind::HANDWHEEL);
  request.counts = 10001;
  EXPECT_EQ(ask(request).reason, "counts 10001 must be from -10000 to 10000");
  request = valid(CommandKind::RAPID_OVERRIDE);
  request.fraction = 1.2;
  EXPECT_FALSE(ask(request).accepted);
  EXPECT_EQ(core->state().rapid_override, 1);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
}

TEST_F(OperatorCommands, AResetIsTakenWithParametersThatCannotBeUsedAndCorrectedOnesAreUsed) {
  auto without_direction = testing::three_axes();
  without_direction->values[40425] = {33, ""};
  core = std::make_unique<ChannelCore>(0, true);
  core->set_parameters(without_direction);
  ASSERT_TRUE(core->unusable());
  EXPECT_EQ(core->unusable()->text,
            "channel 0, parameters 040426 .. 040428: the direction of an axis is zero");
  EXPECT_TRUE(core->take_events().empty());
  EXPECT_TRUE(ask(CommandKind::RESET).accepted);
  EXPECT_EQ(core->state().reset_count, 1u);
  core->set_parameters(testing::three_axes(2));
  EXPECT_FALSE(core->unusable());
  EXPECT_TRUE(core->configured());
}

}  // namespace
}  // namespace trunnion::channel
