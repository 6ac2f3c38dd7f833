// SPDX-License-Identifier: Apache-2.0
// Taps and threads in a program: what couples, what can be restarted, and what is refused.
#include "flow_fixture.hpp"

#include <string>
#include <vector>

#include "machine/alarm_constants.hpp"

namespace trunnion::program_execution {
namespace {

using flow_test::Flow;
using flow_test::number;
using flow_test::NumThreadFlow;
using flow_test::ThreadFlow;
using language::AlarmNumber;
using language::CommandKind;

TEST_F(Flow, ATapIsAMoveOnlyWhileTappingAndCannotBeRestartedInTheThread) {
  const std::string program = "G90 G94 S400 M3\nG0 Z5\nG99 G84 X0 Y0 Z-10 R2 F500\nG80\n";
  start(program);
  for (int i = 0; i < 5 && run() == FlowState::command && flow.pending().kind != CommandKind::tap; ++i)
    flow.finish_pending();  // spindle functions
  ASSERT_EQ(flow.pending().kind, CommandKind::tap);
  const auto tap = flow.pending();
  flow.set_tapping(true);
  run();
  ASSERT_FALSE(moves.empty());
  EXPECT_EQ(moves.back().kind, CommandKind::line);
  EXPECT_EQ(moves.back().modal.path_control, language::PathControl::exact_stop);
  EXPECT_NEAR(moves.back().modal.feed, 500, 1e-9) << "lead 1.25 mm at 400 1/min";
  EXPECT_EQ(flow.tap_speed(), 400);
  Entry entry;
  entry.restart = {tap.sequence, 0.5, {}};
  start(program, entry);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::not_resumable));
}

// Of the way out all is done: what comes behind it continues. Behind the way in the tap is in the hole.
TEST_F(Flow, ARestartBehindAWholeTapContinuesAndOneAtItsBottomDoesNot) {
  const std::string program = "G90 G94 S400 M3\nG0 Z5\nG99 G84 X0 Y0 Z-10 R2 F500\nG80\nG0 X7\n";
  start(program);
  for (int i = 0; i < 5 && run() == FlowState::command && flow.pending().kind != CommandKind::tap; ++i)
    flow.finish_pending();
  ASSERT_EQ(flow.pending().kind, CommandKind::tap);
  const auto in = flow.pending();
  Entry entry;
  entry.restart = {in.sequence, 1, in.target};
  start(program, entry);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::not_resumable));
  // The way out is the next command.
  AxisValues out{};
  out[language::Z] = 2;
  entry.restart = {in.sequence + 1, 1, out};
  start(program, entry);
  ASSERT_EQ(run(), FlowState::command);
  EXPECT_FALSE(flow.searching());
  EXPECT_EQ(flow.pending().kind, CommandKind::auxiliary);
  EXPECT_EQ(flow.pending().number, 3u) << "the spindle turns again";
  EXPECT_EQ(trajectory->position()[language::Z], 2);
  flow.finish_pending();
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_EQ(x(), 7);
  EXPECT_EQ(trajectory->position()[language::Z], 2);
}

TEST_F(Flow, WithATapInItsHoleOnlyItsRemovalMayMove) {
  const std::string tap = "right-hand thread, lead 1.25 mm, 6.500 mm deep";
  for (const char* wrong : {"G90 G0 Z5\n", "G90 G1 X1 F100\n", "G90 G17 G2 X2 I1 F100\n", "G31 Z5 F100\n",
                            "S200 M3 G33 Z5 F2\n", "G28.2 Z0\n"}) {
    flow.set_tap_in_hole(tap);
    start(wrong);
    FlowState state = run();
    for (int i = 0; i < 5 && state == FlowState::command && flow.pending().kind != CommandKind::home; ++i) {
      flow.finish_pending();
      state = run();
    }
    EXPECT_EQ(state, FlowState::alarm) << wrong;
    EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::tap_removal_thread)) << wrong;
    EXPECT_NE(flow.alarm_text().find(tap), std::string::npos) << flow.alarm_text();
    EXPECT_TRUE(moves.empty()) << wrong;
  }
  start("S200 M8\nG4 P10\nG84.9 Z12 K1.25\nG0 X7\n");
  for (int i = 0; i < 5 && run() == FlowState::command && flow.pending().kind != CommandKind::tap; ++i)
    flow.finish_pending();
  ASSERT_EQ(flow.pending().kind, CommandKind::tap);
  flow.set_tapping(true);
  EXPECT_EQ(run(), FlowState::command) << "X7 waits until the tap is out";
  flow.set_tap_in_hole("");
  flow.set_tapping(false);
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_EQ(x(), 7);
}

// Whoever ends the tapping does not begin it again with the same stroke.
TEST_F(Flow, AnAlarmOfAStrokeLastsWhenTheTappingHasEnded) {
  start("G90 G94 S400 M3\nG0 Z5\nG99 G84 X0 Y0 Z-410 R2 F500\nG80\n");
  for (int i = 0; i < 5 && run() == FlowState::command && flow.pending().kind != CommandKind::tap; ++i)
    flow.finish_pending();
  ASSERT_EQ(flow.pending().kind, CommandKind::tap);
  flow.set_tapping(true);
  EXPECT_EQ(run(), FlowState::alarm);
  flow.set_tapping(false);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(&flow.alarm(), &alarm::travel_limit);
}

// 2 mm in each of 100 revolutions a minute.
TEST_F(ThreadFlow, AThreadThatIsNotCoupledIsALineOfItsOwnSpeed) {
  flow.set_dry_run_feed(2000);
  start("G90 S100 M3\nG33 Z-5 F2\nG1 X1 F300\n");
  for (int i = 0; i < 5 && run() == FlowState::command; ++i) flow.finish_pending();
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_EQ(moves[0].kind, CommandKind::line);
  EXPECT_NEAR(moves[0].modal.feed, 200, 1e-9);
  EXPECT_EQ(moves[1].modal.feed, 2000);
  EXPECT_EQ(trajectory->position()[language::Z], -5);
}

TEST_F(ThreadFlow, CoupledThreadsThatFollowEachOtherAreCollectedAtRest) {
  flow.set_coupled_threads(true);
  reach_thread("G90 S100 M3\nG0 X10\nG33 Z-5 F2 Q90\nX12 Z-9 F1\nG0 X20\n");
  EXPECT_EQ(x(), 10);
  EXPECT_EQ(flow.fill(false), FlowState::command) << "as often as it is asked";
  flow.set_threading(true);
  EXPECT_EQ(flow.fill(true), FlowState::full) << "single block does not stop within a thread";
  ASSERT_EQ(flow.legs().size(), 2u);
  EXPECT_EQ(flow.legs()[0].lead, 2);
  EXPECT_EQ(flow.legs()[0].start_angle, 90);
  EXPECT_EQ(flow.legs()[0].line, 3u);
  EXPECT_EQ(flow.legs()[1].lead, 1);
  EXPECT_EQ(flow.legs()[1].target[language::Z], -9);
  EXPECT_EQ(flow.fill(false), FlowState::full) << "it reads on only when they are done";
  EXPECT_EQ(moves.size(), 3u) << "a rapid and the two";
  trajectory->start(flow.legs()[1].target, language::Transformation::none, 0);
  flow.set_threading(false);
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_EQ(x(), 20);
}

TEST_F(ThreadFlow, AnExactStopAndAnotherCommandEndAThread) {
  flow.set_coupled_threads(true);
  reach_thread("G90 S100 M3\nG9 G33 Z-5 F2\nZ-9\nM8\nZ-12\n");
  for (const double end : {-5.0, -9.0, -12.0}) {
    ASSERT_EQ(flow.pending().kind, CommandKind::thread);
    flow.set_threading(true);
    flow.fill(false);
    ASSERT_EQ(flow.legs().size(), 1u);
    EXPECT_EQ(flow.legs()[0].target[language::Z], end);
    trajectory->start(flow.legs()[0].target, language::Transformation::none, 0);
    flow.set_threading(false);
    if (run() == FlowState::command && flow.pending().kind == CommandKind::auxiliary) {
      flow.finish_pending();
      run();
    }
  }
}

// 64 blocks are one thread. Behind them another one would begin, at its own angle.
TEST_F(ThreadFlow, TheSixtyFifthBlockOfAThreadIsRefusedBeforeItBegins) {
  flow.set_coupled_threads(true);
  const auto blocks = [](int count) {
    std::string program = "G90 S100 M3\nG33 Z-1 F1\n";
    for (int i = 2; i <= count; ++i) program += "Z-" + std::to_string(i) + "\n";
    return program;
  };
  reach_thread(blocks(64) + "G0 X1\n");
  flow.set_threading(true);
  EXPECT_EQ(flow.fill(false), FlowState::full);
  EXPECT_EQ(flow.legs().size(), 64u);
  reach_thread(blocks(65));
  flow.set_threading(true);
  EXPECT_EQ(flow.fill(false), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::thread_impossible));
  EXPECT_EQ(flow.placed_alarm().line, 66u);
  EXPECT_NE(flow.alarm_text().find("more than 64 blocks"), std::string::npos) << flow.alarm_text();
}

TEST_F(ThreadFlow, ARestartBehindAWholeThreadContinues) {
  flow.set_coupled_threads(true);
  const std::string program = "G90 S100 M3\nG33 Z-5 F2\nG9 Z-9\nG33 Z-12\nM5\nG0 X20\n";
  reach_thread(program);
  const auto first = flow.pending();
  // At the end of the first block the same thread goes on; behind the exact stop it is another one.
  Entry entry;
  entry.restart = {first.sequence, 1, first.target};
  start(program, entry);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::not_resumable));
  AxisValues at{};
  at[language::Z] = -9;
  entry.restart = {first.sequence + 1, 1, at};
  start(program, entry);
  ASSERT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().kind, CommandKind::thread);
  EXPECT_EQ(flow.executing().spindle_speed, 100);
  at[language::Z] = -12;
  entry.restart = {first.sequence + 2, 1, at};
  start(program, entry);
  ASSERT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().number, 5u) << "M5";
  flow.finish_pending();
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_EQ(x(), 20);
  EXPECT_EQ(trajectory->position()[language::Z], -12);
  // Not all of it is done.
  entry.restart = {first.sequence + 2, 0.999999, at};
  start(program, entry);
  EXPECT_EQ(run(), FlowState::alarm);
}

// From Z-5 the taught place is 2 revolutions ahead: 90 deg.
const std::string num_threads = "M3 S100\nG38 K2 Z-5\nG38+ J-4 EC90 K2 Z-9\nZ-12\nG33 Z-14 K2\nX20\nM2\n";

TEST_F(NumThreadFlow, AResumedThreadIsNotOneWithTheThreadBeforeIt) {
  reach_thread(num_threads);
  const std::vector<std::vector<double>> threads = {{-5}, {-9, -12}, {-14}};
  for (std::size_t k = 0; k < threads.size(); ++k) {
    ASSERT_EQ(flow.pending().kind, CommandKind::thread);
    flow.set_threading(true);
    EXPECT_EQ(flow.fill(false), FlowState::full);
    ASSERT_EQ(flow.legs().size(), threads[k].size());
    for (std::size_t i = 0; i < threads[k].size(); ++i)
      EXPECT_EQ(flow.legs()[i].target[language::Z], threads[k][i]);
    EXPECT_EQ(flow.legs()[0].start_angle, k == 1 ? 90 : 0);
    trajectory->start(flow.legs().back().target, language::Transformation::none, 0);
    flow.set_threading(false);
    ASSERT_EQ(run(), FlowState::command);
  }
  // Behind G33 G38 is active again: X20 is a thread of its own.
  EXPECT_EQ(flow.pending().kind, CommandKind::thread);
  EXPECT_EQ(flow.pending().target[language::X], 20);
}

TEST_F(NumThreadFlow, AProgramMayBeginWithAResumedThreadButNotBehindItsFirstBlock) {
  for (const std::uint32_t line : {3u, 4u, 5u}) {
    Entry entry;
    entry.line = line;
    start(num_threads, entry);
    ASSERT_EQ(run(), FlowState::found);
    trajectory->start(flow.position(), language::Transformation::none, 0);
    EXPECT_EQ(run(), line == 4 ? FlowState::alarm : FlowState::command) << line;
  }
}

// As behind a start from the line of the thread, which passes over M3.
TEST_F(ThreadFlow, AThreadWithoutReferencesIsAnAlarmBeforeItBegins) {
  flow.set_coupled_threads(true);
  reach_thread("G90 S100 M3\nG33 Z-5 F2\n");
  flow.set_without_reference("Z");
  flow.set_threading(true);
  EXPECT_EQ(flow.fill(false), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::axes_without_reference));
  EXPECT_TRUE(flow.legs().empty());
}

TEST_F(ThreadFlow, AThreadOutOfTravelIsAnAlarmBeforeItBegins) {
  flow.set_coupled_threads(true);
  reach_thread("G90 S100 M3\nG33 Z-5 F2\nZ-401\n");
  flow.set_threading(true);
  EXPECT_EQ(flow.fill(false), FlowState::alarm);
  EXPECT_EQ(&flow.alarm(), &alarm::travel_limit);
}

TEST_F(ThreadFlow, ARefusedLegIsAnAlarmAtItsLine) {
  flow.set_coupled_threads(true);
  reach_thread("G90 S100 M3\nG33 Z-5 F2\nZ-5.1\nG0 X1\n");
  flow.set_threading(true);
  flow.fill(false);
  flow.refuse_thread(AlarmNumber::thread_too_short, 1);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_text().rfind("3: thread is too short", 0), 0u) << flow.alarm_text();
  EXPECT_EQ(flow.placed_alarm().line, 3u);
}

TEST_F(ThreadFlow, NoProgramBeginsOrContinuesWithinAThread) {
  flow.set_coupled_threads(true);
  const std::string program = "G90 S100 M3\nG33 Z-5 F2\nZ-9\nG0 X20\n";
  reach_thread(program);
  Entry restart;
  restart.restart = {flow.pending().sequence, 0.5, {}};
  start(program, restart);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::not_resumable));
  for (const std::uint32_t line : {2u, 3u, 4u}) {
    Entry entry;
    entry.line = line;
    start(program, entry);
    ASSERT_EQ(run(), FlowState::found);
    trajectory->start(flow.position(), language::Transformation::none, 0);
    const auto state = run();
    EXPECT_EQ(state, line == 2 ? FlowState::command : line == 3 ? FlowState::alarm : FlowState::end);
    if (line == 3) {
      EXPECT_EQ(flow.alarm_text(), "3: the line continues a thread: start before the first block of it");
    }
  }
}

TEST_F(Flow, AThreadNeedsASpindle) {
  start("G90 S100 M3\nG33 Z-5 F2\n");
  FlowState state = run();
  for (int i = 0; i < 5 && state == FlowState::command; ++i) {
    flow.finish_pending();
    state = run();
  }
  EXPECT_EQ(state, FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::tapping_spindle_missing));
}

}  // namespace
}  // namespace trunnion::program_execution
