// SPDX-License-Identifier: Apache-2.0
// Searches for references and values of spindles in a program, which the caller answers.
#include "flow_fixture.hpp"

#include <string>
#include <vector>

namespace trunnion::program_execution {
namespace {

using flow_test::Flow;
using flow_test::number;
using language::AlarmNumber;
using language::CommandKind;

// read 1: spindle 2 homed. The wait of 10 ms is 10 cycles of motion at rest.
TEST_F(Flow, AValueOfASpindleIsReadBehindAWaitAtRestAndARestartReadsItAgain) {
  const std::string program = "G90 F6000\nG1 X10\nWHILE #4802 EQ 0\nENDW\n#500=#4842\nG1 X20\nM30\n";
  start(program);
  std::vector<double> values = {0, 0, 0, 1, 500};
  for (const double value : values) {
    ASSERT_EQ(run(), FlowState::command);
    ASSERT_EQ(flow.pending().kind, CommandKind::read);
    EXPECT_EQ(x(), 10);
    const auto cycles = setpoints.size();
    ASSERT_EQ(flow.push_pending(), FlowState::full);
    EXPECT_EQ(moves.back().kind, CommandKind::dwell);
    while (!trajectory->at_rest()) setpoints.push_back(trajectory->step(1, 1, false));
    EXPECT_GE(setpoints.size() - cycles, 10u);
    flow.value_read(value);
  }
  EXPECT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().kind, CommandKind::end);
  EXPECT_EQ(flow.variables().kept[0].number, 500);
  ASSERT_EQ(flow.skips().size(), 3u) << "equal ones behind each other are one";
  EXPECT_EQ(flow.skips()[0].touched[language::X], 3);

  // Command 1 is the line to 10, 2 to 6 are the readings, 7 the line to 20: half of it is left.
  Entry entry;
  entry.restart = {7, 0.5, {15}};
  start(program, entry);
  ASSERT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().kind, CommandKind::end);
  EXPECT_EQ(flow.variables().kept[0].number, 500);
  EXPECT_EQ(flow.skips().size(), 3u);

  // In the third reading: what was read in it and behind it is void.
  entry.restart = {4, 0, {10}};
  start(program, entry);
  ASSERT_EQ(run(), FlowState::command);
  ASSERT_EQ(flow.pending().kind, CommandKind::read);
  ASSERT_EQ(flow.skips().size(), 1u);
  EXPECT_EQ(flow.skips()[0].touched[language::X], 2);

  entry.restart = {7, 0.5, {15}};
  flow.set_skips({});
  start(program, entry);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::not_resumable));
  Entry line;
  line.line = 6;
  start(program, line);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_text(),
            "6: line 3 reads a spindle or a signal of the PLC, and what follows depends on it");
}

// The reference position is 0, and the drive has found X at 3.25.
TEST_F(Flow, ASearchForReferencesEndsWhereTheDriveSaysAndARestartPassesOverIt) {
  const std::string program = "G90 F6000\nG1 X10\nG28.2 X0\nG91 G1 X1\nM30\n";
  start(program);
  ASSERT_EQ(run(), FlowState::command);
  ASSERT_EQ(flow.pending().kind, CommandKind::home);
  EXPECT_EQ(flow.pending().number, 1u);
  trajectory->start({3.25}, language::Transformation::none, 0);
  flow.home_ended({3.25});
  ASSERT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().kind, CommandKind::end);
  EXPECT_NEAR(x(), 4.25, 1e-9);

  // Command 1 is the line to 10, 2 the search, 3 the line by 1: half of it is left.
  Entry entry;
  entry.restart = {3, 0.5, {3.75}};
  start(program, entry);
  ASSERT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().kind, CommandKind::end);
  EXPECT_NEAR(x(), 4.25, 1e-9);
  ASSERT_EQ(moves.size(), 1u);
}

TEST_F(Flow, AStartFromALineBehindASearchTakesTheReferencePositions) {
  Entry entry;
  entry.line = 3;
  start("G90 F6000\nG28.2 X0 M9\nG91 G1 X1\nM30\n", entry);
  ASSERT_EQ(run(), FlowState::found);
  EXPECT_EQ(flow.position()[language::X], 0);
  EXPECT_EQ(flow.skips().size(), 1u) << "a restart reads it again";
}

// The manual's example for one group on a machine with X Y Z: C is left out.
TEST_F(Flow, ThePrintedHomingProgramOfNumSearchesAxisByAxis) {
  auto parameters = axes();
  parameters.values[40959] = {1, ""};  // NUM
  machine.configure(parameters);
  flow.set_without_reference("X, Y, Z");
  start(
      "$9990\nIF [.RG80] = 159 THEN (called by G159)\n   G77 H9990.9\n\nELSE (called in homing mode)\n   "
      "L0=2 F2000 G77 H9990.9 (axis Z)\n   L0=0 F3000 G77 H9990.9 (axis X)\n   L0=1 G77 H9990.9 (axis Y)\n"
      "   L0=8 F10000 G77 H9990.9 (axis C)\nM2\n");
  ASSERT_EQ(run(), FlowState::command);
  ASSERT_EQ(flow.pending().kind, CommandKind::message);
  flow.finish_pending();
  struct SearchOfAxis {
    std::uint32_t bit, line;
    double speed;
  };
  for (const auto& search : {SearchOfAxis{4, 6, 2000}, SearchOfAxis{1, 7, 3000}, SearchOfAxis{2, 8, 3000}}) {
    ASSERT_EQ(run(), FlowState::command);
    ASSERT_EQ(flow.pending().kind, CommandKind::home);
    EXPECT_EQ(flow.pending().number, search.bit);
    EXPECT_EQ(flow.pending().line, search.line);
    EXPECT_EQ(flow.pending().value, search.speed);
    flow.home_ended({});
  }
  ASSERT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().kind, CommandKind::end);
  EXPECT_TRUE(moves.empty());
}

TEST_F(Flow, WithoutReferencesNothingMovesButFunctionsAndTheSearchDo) {
  flow.set_without_reference("Y, Z");
  start("M8\nG28.2 Y0 Z0\nG0 X1\n");
  ASSERT_EQ(run(), FlowState::command);
  flow.finish_pending();
  ASSERT_EQ(run(), FlowState::command);
  ASSERT_EQ(flow.pending().kind, CommandKind::home);
  flow.home_ended({});
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::axes_without_reference));
  EXPECT_EQ(flow.alarm_text(), "3: axes without a reference: Y, Z. Home them with G28.2, or in mode REF");
  EXPECT_TRUE(moves.empty());
  for (const auto* function : {"M3\n", "M4\n", "M6\n", "M19\n", "T1\n"}) {
    start(function);
    EXPECT_EQ(run(), FlowState::alarm) << function;
    EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::axes_without_reference)) << function;
  }

  flow.set_without_reference("");
  start("G0 X1\n");
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_EQ(moves.size(), 1u);
}

}  // namespace
}  // namespace trunnion::program_execution
