// SPDX-License-Identifier: Apache-2.0
// The flow between the interpreter and the trajectory: what it passes on, where it stops, and how it fails.
#include "flow_fixture.hpp"

#include <string>

#include "machine/alarm_constants.hpp"

namespace trunnion::program_execution {
namespace {

using flow_test::Flow;
using flow_test::number;
using flow_test::SlowText;
using language::AlarmNumber;
using language::CommandKind;

TEST_F(Flow, GivesEveryMoveToMotionInSequenceAndReportsTheEndAgainAndAgain) {
  start("G90 F6000\nG1 X10\nG4 P10\nG2 X20 I5\nG0 Y3\n");
  EXPECT_EQ(run(), FlowState::end);
  ASSERT_EQ(moves.size(), 4u);
  const CommandKind kinds[] = {CommandKind::line, CommandKind::dwell, CommandKind::arc, CommandKind::rapid};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(moves[i].kind, kinds[i]);
    EXPECT_EQ(moves[i].line, i + 2);
    EXPECT_EQ(moves[i].sequence, i + 1);
  }
  EXPECT_EQ(x(), 20);
  EXPECT_EQ(flow.fill(false), FlowState::end);
}

TEST_F(Flow, ReadsNoFartherThanMotionHasRoomFor) {
  std::string program = "G91 F6000\n";
  for (int i = 0; i < 20000; ++i) program += "G1 X0.01\n";
  start(program);
  while (flow.fill(false) == FlowState::waiting) EXPECT_FALSE(flow.text_missing());
  EXPECT_FALSE(trajectory->can_accept());
  const auto given = moves.size();
  EXPECT_EQ(flow.fill(false), FlowState::full);
  EXPECT_EQ(moves.size(), given) << "without a step there is no more room";
  EXPECT_LT(given, 20000u);
  EXPECT_NEAR(trajectory->end_position()[language::X], 0.01 * static_cast<double>(given), 1e-9);
}

TEST_F(Flow, StopsMotionAtACommandForTheCallerAndReadsNothingBehindItBeforeItIsDone) {
  start("G90 F6000\nG1 X10\nM8\nG1 X20\nM30\n");
  EXPECT_EQ(run(), FlowState::command);
  EXPECT_EQ(x(), 10);
  EXPECT_EQ(flow.pending().kind, CommandKind::auxiliary);
  EXPECT_EQ(flow.pending().number, 8u);
  EXPECT_EQ(flow.fill(false), FlowState::command);
  EXPECT_EQ(moves.size(), 1u);
  flow.finish_pending();
  EXPECT_EQ(run(), FlowState::command);
  EXPECT_EQ(x(), 20);
  EXPECT_EQ(flow.pending().kind, CommandKind::end);
  EXPECT_EQ(flow.pending().number, 30u);
  const auto functions = flow.auxiliaries().functions();
  ASSERT_EQ(functions.size(), 1u);
  EXPECT_EQ(functions[0].code, 8u);
}

TEST_F(Flow, ALineThatIsPrintedHasItsTextUntilTheCallerIsDone) {
  start("G90 F6000\nG1 X10\n#1=3\nDPRNT[A#1[10]]\nG1 X20\nDPRNT[B]\nM30\n");
  EXPECT_EQ(run(), FlowState::command);
  EXPECT_EQ(x(), 10);
  ASSERT_EQ(flow.pending().kind, CommandKind::print);
  EXPECT_EQ(flow.fill(false), FlowState::command);
  EXPECT_EQ(flow.interpreter().print_text(), "A 3");
  flow.finish_pending();
  EXPECT_EQ(run(), FlowState::command);
  EXPECT_EQ(x(), 20);
  EXPECT_EQ(flow.interpreter().print_text(), "B");
}

TEST_F(Flow, WaitsForTextThatHasNotArrivedAndForNothingElse) {
  SlowText slow("G90 F6000\nG1 X10\nG1 X20\n");
  start(slow);
  EXPECT_EQ(flow.fill(false), FlowState::waiting);
  EXPECT_TRUE(flow.text_missing());
  slow.arrived = 18;  // to the end of line 2
  EXPECT_EQ(flow.fill(false), FlowState::waiting);
  EXPECT_EQ(moves.size(), 1u);
  slow.arrived = 1000;
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_FALSE(flow.text_missing());
  EXPECT_EQ(x(), 20);
}

TEST_F(Flow, ReadsALoopWithoutMotionInPartsAndLetsThePathBeforeItEnd) {
  start("G90 F6000\nG1 X10\nN5 G90\nG1 X10\nGOTO 5\nM30\n");
  EXPECT_EQ(run(), FlowState::loop);
  EXPECT_EQ(x(), 10);
  const auto lines = flow.lines_without_motion();
  EXPECT_GE(lines, lines_of_loop);
  EXPECT_LT(lines, lines_of_loop + 1000) << "of one call of the interpreter";
  EXPECT_EQ(flow.fill(false), FlowState::loop);
  EXPECT_EQ(flow.lines_without_motion(), lines) << "the caller reads on";
  flow.read_on();
  while (flow.fill(false) == FlowState::waiting) EXPECT_FALSE(flow.text_missing());
  EXPECT_GE(flow.lines_without_motion(), lines + 8000);
  EXPECT_LT(flow.lines_without_motion(), lines + 9000);
}

TEST_F(Flow, ALoopOfMovesThatMotionMakesOnePointOfIsOneWithoutMotion) {
  start("G91 F6000\nN5 G1 X0.001\nX-0.001\nGOTO 5\n");
  EXPECT_EQ(run(), FlowState::loop);
  EXPECT_TRUE(flow.loops());
}

TEST_F(Flow, ALoopThatMovesAnAxisOrDwellsIsNoneWithoutMotion) {
  for (const char* program : {"G91 F6000\nN5 G1 X1\nX-1\nGOTO 5\n", "N5 G4 P1\nGOTO 5\n"}) {
    start(program);
    for (int cycle = 0; cycle < 100000; ++cycle) {
      const auto state = flow.fill(false);
      ASSERT_TRUE(state == FlowState::full || state == FlowState::waiting) << program;
      if (state == FlowState::full) trajectory->step(1, 1, false);
    }
    EXPECT_FALSE(flow.loops()) << program;
  }
}

TEST_F(Flow, SingleBlockStopsBeforeTheNextLineAndContinuesOnDemand) {
  single_block = true;
  start("G90 F6000\nG1 X10\nX20\n");
  EXPECT_EQ(run(), FlowState::block_end);
  EXPECT_EQ(x(), 10);
  flow.next_block();
  EXPECT_EQ(run(), FlowState::block_end);
  EXPECT_EQ(x(), 20);
  flow.next_block();
  EXPECT_EQ(run(), FlowState::end);
}

// A rapid and two lines, each to an exact stop.
const std::string stops = "G90 G61 F6000\nG0 X10\nG1 X20\nX30\n";

TEST_F(Flow, AnExactStopBehindARapidIsReachedBitForBitAtSpeedZero) {
  start(stops);
  ASSERT_EQ(run(), FlowState::end);
  for (const double corner : {10.0, 20.0}) {
    bool stopped = false;
    for (const auto& s : setpoints)
      stopped = stopped || (s.position[language::X] == corner && s.path_speed == 0);
    EXPECT_TRUE(stopped) << "at X" << corner;
  }
}

TEST_F(Flow, ARestartAtAnyPointContinuesThereAndStopsWhereTheProgramDoes) {
  start(stops);
  ASSERT_EQ(run(), FlowState::end);
  const auto whole = setpoints;
  ASSERT_GT(whole.size(), 50u);
  for (std::size_t i = 5; i + 5 < whole.size(); i += 37) {
    const auto& from = whole[i];
    Entry entry;
    entry.restart = {from.sequence, from.fraction, from.position};
    start(stops, entry);
    EXPECT_TRUE(flow.searching());
    ASSERT_EQ(run(), FlowState::end) << "from cycle " << i;
    EXPECT_FALSE(flow.searching());
    ASSERT_FALSE(moves.empty());
    EXPECT_EQ(moves.front().sequence, from.sequence) << "the interrupted command comes first";
    EXPECT_EQ(x(), 30);
    double before = from.position[language::X];
    bool stopped = from.sequence > 2;
    for (const auto& s : setpoints) {
      ASSERT_GE(s.position[language::X], before - 1e-9) << "never back";
      ASSERT_LT(s.position[language::X] - before, 0.5) << "no jump";
      before = s.position[language::X];
      stopped = stopped || (before == 20 && s.path_speed == 0);
    }
    EXPECT_TRUE(stopped) << "exact stop at X20, from cycle " << i;
  }
}

TEST_F(Flow, AnErrorInTheTextEndsTheMotionBeforeItAndStays) {
  start("G90 F6000\nG1 X10\nG1 X20\nG77 X3\nG1 X40\n");
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(x(), 20) << "the moves before it are executed to their end";
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::unknown_g));
  EXPECT_EQ(&flow.alarm(), &alarm::unknown_g) << "from the same table as any other";
  EXPECT_EQ(flow.alarm_text().substr(0, 4), "4:1:");
  EXPECT_EQ(flow.fill(false), FlowState::alarm);
  EXPECT_EQ(moves.size(), 2u);
}

TEST_F(Flow, AMoveOutOfTravelIsNotGivenToMotion) {
  start("G90 F6000\nG1 X10\nX401\n");
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(x(), 10);
  EXPECT_EQ(&flow.alarm(), &alarm::travel_limit);
  EXPECT_EQ(flow.alarm_text(), "3: X would go to 401.0000, its travel is -400.0000 .. 400.0000");
  EXPECT_EQ(moves.size(), 1u);
}

TEST_F(Flow, AnAlarmHasItsPlaceWhateverRaisesIt) {
  start("G90 F6000\nM98 P7\nM30\nO7\nG1 X401\nM99\n");
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(static_cast<std::uint32_t>(flow.placed_alarm().number), alarm::travel_limit.number);
  EXPECT_EQ(flow.placed_alarm().line, 5u);
  EXPECT_EQ(flow.placed_alarm().column, 0u);
  EXPECT_STREQ(flow.placed_alarm().text.data(),
               "X would go to 401.0000, its travel is -400.0000 .. 400.0000");
  start("G90 F6000\nG1 X10\n G77\n");
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.placed_alarm().number, AlarmNumber::unknown_g);
  EXPECT_EQ(flow.placed_alarm().line, 3u);
  EXPECT_EQ(flow.placed_alarm().column, 2u);
}

TEST_F(Flow, AFeedPerRevolutionNeedsATurningSpindle) {
  start("G90 G95 F0.1\nG1 X10\n");
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::feed_not_positive));
  EXPECT_EQ(flow.alarm_text(), "2: feed must be above zero (per revolution: with the spindle turning)");
  EXPECT_TRUE(moves.empty());
  start("G90 F6000\nG1 X1\n");
  EXPECT_EQ(run(), FlowState::end) << "a start forgets the alarm";
  EXPECT_EQ(flow.alarm_number(), 0u);
}

// 200 m/min are 795.77 1/min at 40 mm, 875.35 1/min at 40 / 1.1 mm and at most 3000 1/min. The half circle
// from Z 0 to Z -20 has its largest X in the middle, 30 mm: 1061.03 1/min. That of the circle of 1 mm is 21
// mm: 1515.76 1/min.
TEST_F(Flow, AFeedPerRevolutionWithG96IsThatOfTheSpeedAtTheLargestRadius) {
  start(
      "G90 G95 F0.1\nG92 S3000\nG96 S200\nG0 X40\nG1 Z-1\nX0\nG0 X20 Z0\nG18 G3 X20 Z-20 K-10\n"
      "G0 X20.6 Z0\nG2 X20.6 Z0 I-0.6 K-0.8\n");
  ASSERT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().kind, CommandKind::spindle_speed);
  flow.finish_pending();
  ASSERT_EQ(run(), FlowState::end) << flow.alarm_text();
  ASSERT_GT(moves.size(), 6u);
  EXPECT_NEAR(moves[1].modal.feed, 79.577, 1e-3) << "Z at X 40";
  EXPECT_NEAR(moves[2].modal.feed, 79.577, 1e-3);
  EXPECT_NEAR(moves[3].modal.feed, 87.535, 1e-3) << "the second piece";
  EXPECT_NEAR(moves[16].modal.feed, 300, 1e-9) << "from 10.61 mm to the centre";
  EXPECT_EQ(moves[16].target[language::X], 0);
  EXPECT_NEAR(moves[moves.size() - 3].modal.feed, 106.103, 1e-3) << "the half circle";
  EXPECT_NEAR(moves.back().modal.feed, 151.576, 1e-3) << "the circle";
  EXPECT_NEAR(flow.turning_radius(moves[2].sequence, {25}).value(), 25, 1e-12);
  start("G90 G95 F0.1 S500\nG1 X10\n");
  ASSERT_EQ(run(), FlowState::command);
  flow.finish_pending();
  ASSERT_EQ(run(), FlowState::end);
  EXPECT_EQ(moves[0].modal.feed, 50);
  EXPECT_FALSE(flow.turning_radius(moves[0].sequence, {25}));
}

TEST_F(Flow, ARefusedCommandIsAnAlarmFromThenOn) {
  start("G90 F6000\nM8\nG1 X20\n");
  ASSERT_EQ(run(), FlowState::command);
  flow.refuse_pending(AlarmNumber::tapping_spindle_missing);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.fill(false), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::tapping_spindle_missing));
  EXPECT_EQ(flow.alarm_text().substr(0, 3), "2: ");
  EXPECT_TRUE(moves.empty());
}

TEST_F(Flow, ASkipMoveIsPushedByTheCallerAndItsResultComesBeforeTheNextBlock) {
  const std::string program = "G90 F6000\nG31 X30\n#500=#5061\nG91 G1 X1\n";
  start(program);
  ASSERT_EQ(run(), FlowState::command);
  ASSERT_EQ(flow.pending().kind, CommandKind::skip);
  ASSERT_EQ(flow.push_pending(), FlowState::full);
  EXPECT_EQ(moves.size(), 1u);
  EXPECT_EQ(moves[0].kind, CommandKind::line);
  while (!trajectory->at_rest() && x() < 12) trajectory->step(1, 1, false);
  trajectory->abort();
  while (!trajectory->at_rest()) trajectory->step(1, 1, false);
  SkipResult result{trajectory->position(), trajectory->position()};
  result.touched[language::X] = 11.5;
  flow.skip_ended(result);
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_EQ(flow.variables().kept[0].number, 11.5);
  EXPECT_NEAR(x(), result.stopped[language::X] + 1, 1e-9);

  // A restart behind the move reads the result again; without it the program cannot continue.
  Entry entry;
  entry.restart = {2, 0.5, trajectory->position()};
  start(program, entry);
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_EQ(flow.variables().kept[0].number, 11.5);
  flow.set_skips({});
  start(program, entry);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::not_resumable));
}

TEST_F(Flow, ACalledCycleNeedsTheAxesAtRestAndKeepsItsPlaceAndItsVariables) {
  const std::string program =
      "G90 F6000\nG1 X10\nG65 P9010 A3 B4\nG1 X[20+#3100]\nM30\nO9010\n#3100=12\nM99\n";
  start(program);
  ASSERT_EQ(run(), FlowState::command);
  ASSERT_EQ(flow.pending().kind, CommandKind::cycle);
  EXPECT_EQ(flow.pending().number, 12u);
  EXPECT_EQ(x(), 10);
  EXPECT_EQ(flow.main_line(), 3u) << "the line that calls the macro";
  EXPECT_EQ(flow.locals()[1].number, 3);
  EXPECT_EQ(flow.locals()[2].number, 4);
  EXPECT_FALSE(flow.locals()[3].given);
  flow.cycle_answered(1);
  EXPECT_EQ(run(), FlowState::command);
  EXPECT_EQ(flow.pending().kind, CommandKind::end);
  EXPECT_EQ(x(), 21);

  // Behind it nothing is found again: the service has gone on.
  Entry entry;
  entry.restart = {3, 0.5, trajectory->position()};
  start(program, entry);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(flow.alarm_number(), number(AlarmNumber::not_resumable));
  Entry line;
  line.line = 4;
  start(program, line);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(&flow.alarm(), &alarm::search_failed);
}

TEST_F(Flow, ADryRunReplacesFeedsFromTheNextStartOn) {
  flow.set_dry_run_feed(2000);
  start("G90 F100\nG1 X1\nG93 X2 F0.5\n");
  ASSERT_EQ(run(), FlowState::end);
  for (const auto& move : moves) {
    EXPECT_EQ(move.modal.feed, 2000);
    EXPECT_EQ(move.modal.feed_mode, language::FeedMode::per_minute);
  }
}

TEST_F(Flow, AnOffsetCountsInTheTravelAndTheExtentOfThePathIsKept) {
  AxisValues offset{};
  offset[language::X] = 5;
  flow.set_offset(offset);
  start("G90 F6000\nG1 X100 Y-20\nX396\n");
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(&flow.alarm(), &alarm::travel_limit) << "396 + 5 is above 400";
  EXPECT_EQ(flow.extent().high[language::X], 100);
  EXPECT_EQ(flow.extent().low[language::Y], -20);
}

TEST_F(Flow, ASearchStopsBeforeTheLineInTheStateInWhichItBegins) {
  Entry entry;
  entry.line = 4;
  start("G90 F6000\nS1000 M3\nG1 X10 Y5\nG1 X20\n", entry);
  EXPECT_EQ(run(), FlowState::found);
  EXPECT_TRUE(moves.empty());
  EXPECT_FALSE(flow.searching());
  EXPECT_EQ(flow.position()[language::X], 10);
  EXPECT_EQ(flow.executing().feed, 6000);
  EXPECT_EQ(flow.auxiliaries().functions().size(), 2u) << "S1000 M3";
  trajectory->start(flow.position(), language::Transformation::none, 0);
  EXPECT_EQ(run(), FlowState::end);
  EXPECT_EQ(x(), 20);
}

TEST_F(Flow, ASearchForALineThatIsNotReachedFailsAtTheEndOfTheText) {
  Entry entry;
  entry.line = 4;
  start("G90 F6000\nG1 X10\nM30\nG1 X20\n", entry);
  EXPECT_EQ(run(), FlowState::alarm);
  EXPECT_EQ(&flow.alarm(), &alarm::search_failed);
  EXPECT_EQ(flow.alarm_text(), "4: the program ends without reaching this line");
  EXPECT_TRUE(moves.empty());
}

TEST_F(Flow, ALongSearchReturnsNowAndThenWithoutWaitingForText) {
  std::string program = "G91 F6000\n";
  for (int i = 0; i < 10000; ++i) program += "G1 X0.001\n";
  Entry entry;
  entry.restart = {9000, 0, {}};
  start(program, entry);
  EXPECT_EQ(flow.fill(false), FlowState::waiting);
  EXPECT_FALSE(flow.text_missing());
  EXPECT_TRUE(flow.searching());
  int calls = 1;
  while (flow.searching() && calls < 10) flow.fill(false), ++calls;
  EXPECT_EQ(calls, 3) << "9000 commands at 4096 a call";
}

}  // namespace
}  // namespace trunnion::program_execution
