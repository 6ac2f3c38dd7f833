// SPDX-License-Identifier: Apache-2.0
// The start of a program from a line of it.
#include <gmock/gmock.h>

#include <cmath>

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::Codes;
using enum idl::channel::AuxiliaryKind;
using Request = idl::channel::CommandKind;

TEST(Approach, GoesUpBeforeItGoesOverAndDownAfter) {
  const AxisValues low{0, 0, -50}, high{30, 40, 10};
  const auto up = approach_moves(low, high, 7);
  ASSERT_EQ(up.size(), 2u);
  EXPECT_EQ(up[0].target, (AxisValues{0, 0, 10}));
  EXPECT_EQ(up[1].target, high);
  const auto down = approach_moves(high, low, 7);
  ASSERT_EQ(down.size(), 2u);
  EXPECT_EQ(down[0].target, (AxisValues{0, 0, 10}));
  EXPECT_EQ(down[1].target, low);
  EXPECT_TRUE(approach_moves(low, low, 7).empty());
}

TEST(Approach, IsRefusedWhereAZoneForbidsIt) {
  channel_setup::ChannelSetup machine(0);
  machine.configure(*testing::three_axes());
  const AxisValues from{}, to{100, 0, 0};
  const auto moves = approach_moves(from, to, 7);
  language::ProgramFrame frame;
  EXPECT_EQ(approach_error(machine, from, moves, &frame), "");
  language::StrokeZone zone;
  zone.active = zone.bounded[0] = true;
  zone.low[0] = 50, zone.high[0] = 60;
  frame.set_zone(zone);
  EXPECT_EQ(approach_error(machine, from, moves, &frame),
            "7: the approach is not where the zone of G22 permits: it would enter it at X 50.0000");
  EXPECT_EQ(approach_error(machine, from, moves), "");
}

const char* const part =
    "G90 G21 G54\n"    // 1
    "T1 M6\n"          // 2
    "S1000 M3\n"       // 3
    "G0 X10 Y0 Z20\n"  // 4
    "M8\n"             // 5
    "G1 X20 F3000\n"   // 6
    "#100=#100+5\n"    // 7
    "G91\n"            // 8
    "G1 X[#100]\n"     // 9
    "Y7\n"             // 10
    "M30\n";           // 11
struct FromLine : Channel {
  void put_tool_in() {
    ask(Request::SET_MODE, "", 0, 0, Mode::MDI);
    ASSERT_TRUE(ask(Request::MDI_LINE, "T1 M6").accepted);
    run();
    auxiliaries.clear();
  }
};

TEST_F(FromLine, RestoresModesVariablesAndFunctionsThenApproachesAndContinues) {
  put_tool_in();
  load(part);
  ASSERT_TRUE(ask(Request::START_FROM_LINE, "", 10).accepted);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  EXPECT_TRUE(drive.rows.empty()) << "nothing moves before cycle start";
  EXPECT_TRUE(auxiliaries.empty());
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().alarm, &alarm::search_done);
  // X 20 + 5 by the variable, Z 20 up first.
  EXPECT_EQ(events.back().text, "part.nc:10: S1000 M3 M8, approach Z20.0000, then X25.0000");
  ASSERT_TRUE(ask(Request::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  Codes kinds;
  for (const auto& a : auxiliaries) kinds.emplace_back(a.kind, a.code);
  EXPECT_EQ(kinds, (Codes{{S, 0}, {M, 3}, {M, 8}, {M, 30}}));
  // First Z alone, then X alone, then the line of the program, which counts in G91.
  double over = 0;
  for (const auto& row : drive.rows)
    if (row[2] < 20 - 1e-9) over = std::max(over, row[0]);
  EXPECT_EQ(over, 0) << "X waits for Z";
  EXPECT_EQ(drive.rows.back(), (std::vector<double>{25, 7, 20, 0, 0, 0, 0, 0, 0}));
}

TEST_F(FromLine, GivesTheSamePathAsTheWholeProgramFromThereOn) {
  put_tool_in();
  load(part);
  ask(Request::CYCLE_START);
  run();
  std::vector<std::vector<double>> whole;
  for (std::size_t i = 0; i < drive.rows.size(); ++i)
    if (drive.lines[i] >= 9) whole.push_back(drive.rows[i]);
  drive = testing::FakeDrive(3);
  begin();
  put_tool_in();
  load(part);
  drive.rows.clear();
  drive.lines.clear();
  ask(Request::START_FROM_LINE, "", 9);
  run();
  ask(Request::CYCLE_START);
  run();
  EXPECT_EQ(drive.rows.back(), whole.back());
}

// A feedback between the start and the end of the search names the line of the last motion, of MDI here.
TEST_F(FromLine, IsTheLineThatWasAskedForAndNotTheOneOfTheLastMotion) {
  load("G90 G1 F6000\nX10\nX20\nX30\nM30\n");
  ask(Request::SET_MODE, "", 0, 0, Mode::MDI);
  ASSERT_TRUE(ask(Request::MDI_LINE, "G1 X5 F6000").accepted);
  run();
  ask(Request::SET_MODE);
  events.clear();
  ASSERT_TRUE(ask(Request::START_FROM_LINE, "", 4).accepted);
  core->on_feedback(drive.run(0));
  EXPECT_EQ(core->state().line, 4u);
  run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "part.nc:4: approach X20.0000");
}

TEST_F(FromLine, ANewToolMustBeInTheSpindleAlready) {
  load(part);
  ASSERT_TRUE(ask(Request::START_FROM_LINE, "", 6).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::search_failed);
  EXPECT_EQ(events[0].text, "part.nc:6: needs tool T1, T0 is in the spindle: change it by MDI first");
}

TEST_F(FromLine, ALineBehindTheEndOrNotThereIsRefused) {
  load("G90\nG1 X1 F1000\nM30\nG1 X2\n");
  EXPECT_FALSE(ask(Request::START_FROM_LINE, "", 0).accepted);
  EXPECT_FALSE(ask(Request::START_FROM_LINE, "", 6).accepted);
  ASSERT_TRUE(ask(Request::START_FROM_LINE, "", 4).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "part.nc:4: the program ends without reaching this line");
}

TEST_F(FromLine, TheMiddleOfCutterCompensationIsRefused) {
  load("G90 G17\nG41 D1 G1 X1 F1000\nX10\nX20\nG40 X30\nM30\n");
  idl::parameters::ToolTable tools;
  tools.tools.resize(1);
  tools.tools[0].number = 1, tools.tools[0].radius = 0.1;
  core->set_tools(tools);
  ASSERT_TRUE(ask(Request::START_FROM_LINE, "", 4).accepted);
  run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "part.nc:4: cutter radius compensation is on here: start before its G41 or G42");
}

TEST_F(FromLine, AnApproachOutOfTravelIsSeenBeforeAnythingMoves) {
  load("G90\nG0 X500\nG1 X10 F1000\nM30\n");
  ASSERT_TRUE(ask(Request::START_FROM_LINE, "", 3).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].alarm, &alarm::travel_limit);
  EXPECT_TRUE(drive.rows.empty());
}

TEST_F(FromLine, ALineOfASubprogramOrALoopIsTheFirstTimeItIsReached) {
  load("G90 F6000\nM98 P7 L3\nM30\nO7\n#1=#1+1\nG91\nG1 X1\nG90\nM99\n");
  ASSERT_TRUE(ask(Request::START_FROM_LINE, "", 8).accepted);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  ask(Request::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 3) << "the approach to X1, and two more rounds";
}

TEST_F(FromLine, AHoldInTheApproachContinuesWithCycleStart) {
  load("G90\nG0 X200\nG1 X210 F1000\nM30\n");
  ask(Request::START_FROM_LINE, "", 3);
  run();
  cycles_per_round = 8;
  ask(Request::CYCLE_START);
  for (int i = 0; i < 10; ++i) round();
  ASSERT_TRUE(ask(Request::FEED_HOLD).accepted);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  EXPECT_LT(drive.rows.back()[0], 200);
  ASSERT_TRUE(ask(Request::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 210);
}

TEST_F(FromLine, AMeasuringBlockBeforeTheLineIsRefused) {
  load("G90 F1000\nG31 X10\nG1 X5\nM30\n");
  ask(Request::START_FROM_LINE, "", 3);
  run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "part.nc:3: line 2 measures (G31), and what follows depends on it");
}

}  // namespace
}  // namespace trunnion::channel
