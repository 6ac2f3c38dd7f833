// SPDX-License-Identifier: Apache-2.0
// The flow between the interpreter and the trajectory: what it passes on, where it stops, and how it fails.
#include "program_execution/program_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "machine/alarm_constants.hpp"
#include "motion/trajectory.hpp"

namespace trunnion::program_execution {
namespace {

using language::AlarmNumber;
using language::CommandKind;

std::uint32_t number(AlarmNumber alarm) { return static_cast<std::uint32_t>(alarm); }

/// A text whose bytes behind `arrived` are still on their way.
class SlowText final : public language::TextSource {
 public:
  explicit SlowText(std::string text) : text_(std::move(text)) {}
  language::ReadResult read(std::uint64_t offset, char* buffer, std::size_t capacity) override {
    if (offset >= text_.size()) return {language::ReadStatus::end, 0};
    if (offset >= arrived) return {language::ReadStatus::pending, 0};
    const std::size_t size =
        std::min({capacity, arrived - static_cast<std::size_t>(offset), text_.size() - offset});
    std::memcpy(buffer, text_.data() + offset, size);
    return {language::ReadStatus::bytes, size};
  }
  std::size_t arrived = 0;

 private:
  std::string text_;
};

/// X Y Z of 400 mm to either side, a flow and its trajectory.
struct Flow : ::testing::Test {
  Flow() : machine(0) {
    machine.configure(axes());
    flow.on_move = [this](const language::Command& move) { moves.push_back(move); };
  }
  static machine::Parameters axes() {
    machine::Parameters parameters;
    for (std::uint32_t a = 0; a < 3; ++a) {
      parameters.values[40001 + a] = {static_cast<double>(a), ""};
      parameters.values[100000 + a * 1000] = {0, std::string(1, "XYZ"[a])};
      parameters.values[100006 + a * 1000] = {400, ""};
      parameters.values[100007 + a * 1000] = {-400, ""};
    }
    return parameters;
  }
  void start(const std::string& program, const Entry& entry = {}) {
    text = program;
    source = std::make_unique<language::StringSource>(text);
    start(*source, entry);
  }
  void start(language::TextSource& from, const Entry& entry = {}) {
    moves.clear();
    setpoints.clear();
    trajectory = std::make_unique<motion::Trajectory>(machine.limits(), &machine.chain(), 0.001);
    trajectory->start({}, language::Transformation::none, 0);
    flow.start(*trajectory, from, {}, {}, variables, entry);
  }
  /// Fills and steps until the motion has come to rest and the flow needs attention: the state it is in.
  FlowState run() {
    for (int cycle = 0; cycle < 200000; ++cycle) {
      const auto state = flow.fill(single_block);
      if (state == FlowState::waiting && !flow.text_missing()) continue;
      if (state == FlowState::waiting || state == FlowState::found) return state;
      if (trajectory->at_rest()) return state;
      setpoints.push_back(trajectory->step(1, 1, false));
    }
    ADD_FAILURE() << "the motion does not end";
    return FlowState::waiting;
  }
  double x() const { return trajectory->position()[language::X]; }

  channel_setup::ChannelSetup machine;
  language::VariableStore variables;
  ProgramFlow flow{machine};
  std::unique_ptr<motion::Trajectory> trajectory;
  std::string text;
  std::unique_ptr<language::StringSource> source;
  std::vector<language::Command> moves;
  std::vector<motion::Setpoint> setpoints;
  bool single_block = false;
};

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
  EXPECT_EQ(flow.alarm_text(), "6: line 3 reads the state of a spindle, and what follows depends on it");
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

/// With a spindle.
struct ThreadFlow : Flow {
  ThreadFlow() {
    auto parameters = axes();
    parameters.values[103000] = {0, "S"}, parameters.values[103001] = {10, ""};
    machine.configure(parameters);
  }
  /// Up to the first thread; what comes before is done.
  void reach_thread(const std::string& program) {
    start(program);
    for (int i = 0; i < 5 && run() == FlowState::command && flow.pending().kind != CommandKind::thread; ++i)
      flow.finish_pending();
    ASSERT_EQ(flow.pending().kind, CommandKind::thread);
  }
};

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

/// The same with the NUM dialect.
struct NumThreadFlow : ThreadFlow {
  NumThreadFlow() {
    auto parameters = axes();
    parameters.values[103000] = {0, "S"}, parameters.values[103001] = {10, ""};
    parameters.values[40959] = {1, ""};
    machine.configure(parameters);
    flow.set_coupled_threads(true);
  }
};

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
