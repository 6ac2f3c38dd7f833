// SPDX-License-Identifier: Apache-2.0
// What a program leaves behind: kept variables, changed tables, and the codes an operator reads.
#include <gmock/gmock.h>

#include <limits>

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"
#include "modal_codes.hpp"
#include "table_request.hpp"
#include "variable_text.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using language::Value;
using testing::Channel;

TEST(VariableText, BringsVariablesBackBitForBitAndVacantOnesStayVacant) {
  auto before = std::make_unique<language::VariableStore>();
  before->kept[0] = Value::of(0.1);
  before->kept[499] = Value::of(-1.0 / 3);
  before->user[4999] = Value::of(std::numeric_limits<double>::denorm_min());
  before->extended[7399] = Value::of(1e-9);
  before->skip[8] = Value::of(-0.5);
  before->common[5] = Value::of(7);
  auto after = std::make_unique<language::VariableStore>();
  read_variables(write_variables(*before, "12 ab"), "f", "12 ab", *after);
  EXPECT_EQ(after->kept[0].number, 0.1);
  EXPECT_EQ(after->kept[499].number, -1.0 / 3);
  EXPECT_EQ(after->user[4999].number, std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(after->extended[7399].number, 1e-9);
  EXPECT_FALSE(after->kept[1].given);
  EXPECT_EQ(after->skip[8].number, -0.5);
  EXPECT_FALSE(after->skip[0].given);
  EXPECT_EQ(after->common[5].number, 7);
}

TEST(VariableText, CommonVariablesAreForgottenAtPowerOff) {
  auto before = std::make_unique<language::VariableStore>(),
       after = std::make_unique<language::VariableStore>();
  before->kept[3] = Value::of(3);
  before->common[5] = Value::of(7);
  read_variables(write_variables(*before, "12"), "f", "13", *after);
  EXPECT_EQ(after->kept[3].number, 3);
  EXPECT_FALSE(after->common[5].given);
}

TEST(VariableText, AWrongLineIsNamed) {
  auto variables = std::make_unique<language::VariableStore>();
  for (const char* bad :
       {"#500: 1\n500: 2\n", "#500: 1\n#49: 2\n", "#500: 1\n#501: x\n", "#500: 1\n#501: inf\n",
        "#500: 1\n#501: 1 2\n", "#500: 1\n\n", "#500: 1\n#501:\n", "boot 1\nboot 1\n"}) {
    std::string message;
    try {
      read_variables(bad, "channel-0.variables", "1", *variables);
    } catch (const std::runtime_error& e) {
      message = e.what();
    }
    EXPECT_THAT(message, ::testing::StartsWith("channel-0.variables:2: ")) << bad;
  }
}

TEST(TableRequest, ChangesOneFieldOfAToolAndKeepsTheOthers) {
  idl::parameters::ToolTable tools;
  tools.tools = {{3, 100, 0.1, 5, 0.2, "End mill"}};
  language::Command command;
  command.kind = language::CommandKind::table;
  command.table = language::Table::tool_radius_wear;
  command.number = 3;
  command.value = -0.05;
  const auto request = table_request(command, 0, tools);
  EXPECT_EQ(request.operation, idl::parameters::Operation::SET_TOOL);
  ASSERT_EQ(request.tools.size(), 1u);
  EXPECT_EQ(request.tools[0].radius_wear, -0.05);
  EXPECT_EQ(request.tools[0].length, 100);
  EXPECT_EQ(request.tools[0].name, "End mill");
}

TEST(TableRequest, NamesTheWorkOffsetAndItsChannel) {
  language::Command command;
  command.kind = language::CommandKind::table;
  command.table = language::Table::work_offset;
  command.number = 7;
  command.target = {1, 2, 3};
  const auto request = table_request(command, 1, {});
  ASSERT_EQ(request.offsets.size(), 1u);
  EXPECT_EQ(request.offsets[0].channel, 1);
  EXPECT_EQ(request.offsets[0].index, 7);
  EXPECT_EQ(request.offsets[0].values, (std::vector<double>{1, 2, 3, 0, 0, 0, 0, 0, 0}));
}

TEST(ModalCodes, ShowOneCodeOfEachGroupAndWhatIsSwitchedOn) {
  language::ModalState modal;
  EXPECT_THAT(modal_codes(modal), ::testing::ElementsAre("G0", "G17", "G21", "G90", "G94", "G64", "G54",
                                                         "G40", "G49", "G97", "G98"));
  modal.cycle = 83;
  modal.work_offset = 6;
  modal.cutter_side = language::CutterSide::left;
  modal.transformation = language::Transformation::rtcp;
  modal.tool_vector = true;
  modal.tilt.active = modal.rotated = true;
  EXPECT_THAT(modal_codes(modal), ::testing::ElementsAre("G83", "G17", "G21", "G90", "G94", "G64", "G54.1 P1",
                                                         "G41", "G43.5", "G97", "G98", "G68.2"));
}

TEST_F(Channel, AProgramThatChangesATableWaitsUntilItsOwnerHasDoneSo) {
  load("G90 G54\nG10 L2 P1 X5\nG1 X10 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  EXPECT_EQ(core->run_state(), RunState::WAITING);
  const auto request = core->take_table_request();
  ASSERT_TRUE(request);
  ASSERT_EQ(request->offsets.size(), 1u);
  EXPECT_EQ(request->offsets[0].values[0], 5);
  core->on_table_changed("");
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 15) << "G54 X5 and X10";
}

// As in ProgramEntry and ChannelRequest: 0 operator, 1 setter, 2 builder.
TEST_F(Channel, ATableIsChangedForWhoStoredTheTextOrEnteredTheLine) {
  subprograms["O9001.nc"] = {"G10 L50\nN100006 R5000\nG11\nM99\n", 1, 2};
  const auto asked = [&] {
    for (int i = 0; i < 20; ++i) round();
    const auto request = core->take_table_request();
    if (request) core->on_table_changed("");
    run();
    return request.value_or(idl::parameters::ParameterRequest{.who = "nothing was asked for"});
  };
  load("G10 L2 P1 X5\nM30\n");
  ask(CommandKind::CYCLE_START);
  auto request = asked();
  EXPECT_EQ(request.role, 1);
  EXPECT_EQ(request.who, "part.nc line 1 of channel 0");

  load("M98 P9001\nM30\n");
  ask(CommandKind::CYCLE_START);
  request = asked();
  EXPECT_EQ(request.role, 1) << "a builder's subprogram called by a setter's program";
  EXPECT_EQ(request.who, "part.nc line 1 of channel 0");
  load("M98 P9002\nM30\nO9002\nG10 L2 P1 X6\nM99\n");
  ask(CommandKind::CYCLE_START);
  EXPECT_EQ(asked().role, 1) << "a subprogram in the same text";

  ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI);
  idl::channel::ChannelRequest line;
  line.command = CommandKind::MDI_LINE, line.who = "ann";
  for (const char* block : {"G10 L2 P1 X7", "#5221=3", "G10 L10 P1 R20"}) {
    line.block = block, line.role = 0;
    EXPECT_TRUE(ask(line).accepted) << block;
    request = asked();
    EXPECT_EQ(request.role, 0) << block;
    EXPECT_EQ(request.who, "MDI of channel 0 by ann") << block;
    line.role = 2;
    EXPECT_TRUE(ask(line).accepted) << block;
    EXPECT_EQ(asked().role, 2) << block;
  }
  line.block = "M98 P9001", line.role = 0;
  EXPECT_TRUE(ask(line).accepted);
  request = asked();
  EXPECT_EQ(request.role, 2) << "who stored it has released it";
  EXPECT_EQ(request.who, "MDI of channel 0 by ann");
}

TEST_F(Channel, ARefusedTableStopsTheProgramWithTheReason) {
  load("G10 L2 P1 X5\nG1 X10 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ASSERT_TRUE(core->take_table_request());
  core->on_table_changed("the disk is full");
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  const auto reported = core->take_events();
  ASSERT_FALSE(reported.empty());
  EXPECT_EQ(reported.back().alarm, &alarm::table_refused);
  EXPECT_NE(reported.back().text.find("part.nc:1: the disk is full"), std::string::npos)
      << reported.back().text;
}

TEST_F(Channel, AMessageStopsTheProgramUntilCycleStart) {
  load("G90\n#3006=1 (turn the part)\nG1 X10 F6000\nM30\n");
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::program_message);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(drive.rows.back()[0], 10);
}

}  // namespace
}  // namespace trunnion::channel
