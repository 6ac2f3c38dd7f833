// SPDX-License-Identifier: Apache-2.0
// G31: a skip input ends the move, the program continues from there and knows the position of the edge.
#include "bus/cdr.hpp"
#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using testing::Channel;
using testing::FakeDrive;

struct Skip : Channel {
  /// X and Y behind the program, and #500.. as it has set them.
  std::vector<double> after(const std::string& program) {
    load(program);
    EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    return drive.rows.empty() ? std::vector<double>{} : drive.rows.back();
  }
  double kept(std::size_t i) {
    if (const auto* news = core->take_variables()) variables = *news;
    return variables.kept[i].number;
  }
  language::VariableStore variables;
};

TEST_F(Skip, TheMoveStopsBehindTheInputAndTheVariablesHoldWhereItCame) {
  drive.switch_ = {1, 0, 20.25};
  // At 1200 mm/min, 0.02 mm a cycle, the channel answers 33 cycles behind the edge's: 0.66 mm and the
  // braking.
  const auto end = after("G90 G54\nG31 X100 F1200\n#500=#5061\n#501=#5041\nG91 G1 X10\nM30\n");
  EXPECT_NEAR(kept(0), 20.25, 1e-9);
  EXPECT_GT(kept(1), 20.25 + 0.02 * 33);
  EXPECT_LT(kept(1), 20.25 + 0.02 * 33 + 1);
  EXPECT_NEAR(end[0], kept(1) + 10, 1e-9) << "incremental from where the axes really stopped";
  EXPECT_TRUE(events.empty());
}

TEST_F(Skip, TheFirstCycleThatBrakesIsTheLeadAndOneBehindTheEdgeHoweverTheFeedbackArrives) {
  std::vector<std::vector<double>> runs[2];
  for (const std::uint64_t cycles : {1ull, 1000ull}) {
    drive = FakeDrive(3);
    drive.switch_ = {1, 0, 20.25};
    begin();
    cycles_per_round = cycles;
    after("G90 G54\nG31 X100 F1200\nM30\n");
    runs[cycles == 1 ? 0 : 1] = drive.rows;
  }
  EXPECT_EQ(runs[0], runs[1]);
  const auto& rows = runs[0];
  std::size_t touch = 0;
  while (rows[touch][0] < 20.25) ++touch;
  // Row `touch` reaches the switch, so the edge belongs to the cycle behind it; lead 32 and one more.
  const std::size_t last_even = touch + 1 + 32;
  for (std::size_t i = touch; i <= last_even; ++i) EXPECT_NEAR(rows[i][0] - rows[i - 1][0], 0.02, 1e-9) << i;
  EXPECT_LT(rows[last_even + 1][0] - rows[last_even][0], 0.02);
}

TEST_F(Skip, WithoutAnEdgeTheMoveEndsAtItsEndAndTheVariablesHoldThat) {
  const auto end = after("G90 G54\nG31 X30 Y6 F1200\n#500=#5061\n#501=#5062\nG1 X40\nM30\n");
  EXPECT_EQ(kept(0), 30);
  EXPECT_EQ(kept(1), 6);
  EXPECT_EQ(end[0], 40);
}

TEST_F(Skip, AnotherInputDoesNotEndIt) {
  drive.switch_ = {2, 0, 20};
  EXPECT_EQ(after("G90 G54\nG31 L1 X30 F1200\nM30\n")[0], 30);
  EXPECT_LT(after("G90 G54 G0 X0\nG31 L2 X30 F1200\nM30\n")[0], 25);
}

TEST_F(Skip, AnEdgeTooNearToTheEndIsStillRemembered) {
  drive.switch_ = {1, 0, 29.9};
  // 0.1 mm before the end the channel hears of it when the move is over.
  EXPECT_EQ(after("G90 G54\nG31 X30 F1200\n#500=#5061\nM30\n")[0], 30);
  EXPECT_NEAR(kept(0), 29.9, 1e-9);
}

TEST_F(Skip, TheWorkOffsetAndTheToolLengthAreOutOfTheLatchedPosition) {
  idl::parameters::WorkOffsets offsets;
  offsets.offsets = {{0, 0, {5, 0, 10, 0, 0, 0, 0, 0, 0}}};
  core->set_offsets(offsets);
  drive.switch_ = {1, 2, 90};
  // Tool 1 is 50 long: machine Z 90 is 90 - 50 - 10 in the workpiece.
  after("G90 G54 G43 H1\nG31 Z50 F1200\n#500=#5063\nM30\n");
  EXPECT_NEAR(kept(0), 30, 1e-9);
}

TEST_F(Skip, ThePositionOutlivesItsProgram) {
  drive.switch_ = {1, 0, 20.25};
  after("G90 G54\nG31 X30 F1200\nM30\n");
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, idl::channel::Mode::MDI).accepted);
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "#500=#5061").accepted);
  run();
  EXPECT_NEAR(kept(0), 20.25, 1e-9);
}

TEST_F(Skip, TwoTouchesInOneProgramAreToldApart) {
  drive.switch_ = {1, 0, 20};
  after("G90 G54\nG31 X30 F1200\n#500=#5061\nG0 X10\nG31 X15\n#501=#5061\nG0 X0\nG31 X30\n#502=#5061\nM30\n");
  EXPECT_NEAR(kept(0), 20, 1e-9);
  EXPECT_EQ(kept(1), 15) << "it did not come";
  EXPECT_NEAR(kept(2), 20, 1e-9);
}

TEST_F(Skip, AHoldWithinTheMoveDoesNotLoseTheEdge) {
  drive.switch_ = {1, 0, 20};
  load("G90 G54\nG31 X30 F1200\n#500=#5061\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  while (drive.rows.empty() || drive.rows.back()[0] < 19.7) round();
  ask(CommandKind::FEED_HOLD);
  run();
  EXPECT_EQ(core->run_state(), RunState::HELD);
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(kept(0), 20, 1e-9);
  EXPECT_LT(drive.rows.back()[0], 25);
}

TEST_F(Skip, ResetWithinTheMoveForgetsIt) {
  drive.switch_ = {1, 0, 20};
  load("G90 G54\nG31 X30 F1200\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  while (drive.rows.empty() || drive.rows.back()[0] < 10) round();
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_LT(drive.rows.back()[0], 12);
  EXPECT_EQ(after("G90 G1 X1 F3000\nM30\n")[0], 1);
}

TEST_F(Skip, AMoveBeyondTheTravelIsAnAlarmBeforeItMoves) {
  after("G90 G54\nG31 X401 F1200\nG0 X1\nM30\n");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "part.nc:2: X would go to 401.0000, its travel is -400.0000 .. 400.0000");
  EXPECT_TRUE(drive.rows.empty());
}

TEST_F(Skip, AFreshProcessContinuesBehindATouchThatTheOneBeforeItMade) {
  drive.switch_ = {1, 0, 20};
  const std::string program = "G90 G54\nG31 X30 F1200\nG1 X[#5061+40] F6000\nM30\n";
  load(program);
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  while (drive.rows.empty() || drive.rows.back()[0] < 40) round();
  drive.lose_queue();
  drive.mode = DriveMode::HELD;
  begin();
  EXPECT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(drive.rows.back()[0], 60, 1e-9);
}

TEST_F(Skip, ATouchThatTheDriveHasLostIsMadeAgainAndTheOneBeforeItIsNotTakenForIt) {
  drive.switch_ = {1, 0, 20};
  load("G90 G54\nG31 X30 F1200\n#500=#5061\nG1 X0\nG31 X30\n#501=#5061\nG1 X1\nM30\n");
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  const auto x = [this] { return drive.rows.empty() ? 0 : drive.rows.back()[0]; };
  while (x() < 5) round();
  FakeDrive cut = drive;
  while (x() < 20) round();
  while (x() > 10) round();
  cut.forget();
  drive = cut;  // it published nothing of the touch
  drive.switch_->position = 20.5;
  core->on_feedback(drive.run(0));
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  while (x() < 20) round();
  while (x() > 10) round();
  drive.switch_->position = 22;
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(kept(0), 20.5, 1e-9);
  EXPECT_NEAR(kept(1), 22, 1e-9);
}

SkipResult touch(double x, double z) {
  SkipResult result;
  result.stopped[language::X] = x, result.stopped[language::Z] = z;
  result.touched = result.stopped;
  result.touched[language::X] += 0.25;
  return result;
}

std::vector<SkipResult> brought_back(const std::vector<SkipResult>& skips) {
  idl::stream::ChannelSnapshot stored;
  store({}, skips, stored);
  bus::Bytes bytes;
  bus::encode(stored, bytes);  // within the bounds of the message
  return snapshot_of(stored)->skips;
}

// A message has 234 values for either position: with X and Z that are 117 results.
TEST(ChannelSnapshot, HoldsTheResultsOfAsManySkipMovesAsItHasRoomForOrOfNone) {
  EXPECT_TRUE(brought_back({}).empty());
  std::vector<SkipResult> skips;
  for (int i = 1; i <= 117; ++i) {
    skips.push_back(touch(i, -i));
    const auto back = brought_back(skips);
    ASSERT_EQ(back.size(), skips.size());
    EXPECT_EQ(back.front().touched, skips.front().touched);
    EXPECT_EQ(back.back().stopped, skips.back().stopped);
    EXPECT_EQ(back.back().touched, skips.back().touched);
  }
  skips.push_back(touch(200, 1));
  EXPECT_TRUE(brought_back(skips).empty());
  EXPECT_EQ(brought_back({SkipResult{}, SkipResult{}}).size(), 2u) << "touched at zero";
}

TEST(ChannelSnapshot, BringsEveryFieldBackToTheLastBit) {
  ChannelSnapshot s;
  s.running = true, s.crc = 0xfedcba98;
  s.revision = (std::uint64_t{1} << 53) + 1;  // no double holds it
  s.sequence = 7, s.line = 9, s.fraction = 1.0 / 3;
  s.transformation = language::Transformation::rtcp;
  s.tool_length = 50.1, s.tool = 12;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    s.position[i] = 0.1 * static_cast<double>(i), s.start[i] = -s.position[i],
    s.offset[i] = 1e-9 * s.start[i];
  s.offset_on = s.dry_run = s.auxiliary_lock = true;
  s.block_skip = 0b101;
  idl::stream::ChannelSnapshot stored, arrived;
  store(s, {touch(1, 2)}, stored);
  bus::Bytes bytes;
  bus::encode(stored, bytes);
  ASSERT_TRUE(bus::decode(bytes, arrived));
  const auto back = snapshot_of(arrived);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->running);
  EXPECT_EQ(back->crc, s.crc);
  EXPECT_EQ(back->revision, s.revision);
  EXPECT_EQ(back->sequence, s.sequence);
  EXPECT_EQ(back->line, s.line);
  EXPECT_EQ(back->fraction, s.fraction);
  EXPECT_EQ(back->transformation, s.transformation);
  EXPECT_EQ(back->tool_length, s.tool_length);
  EXPECT_EQ(back->tool, s.tool);
  EXPECT_EQ(back->position, s.position);
  EXPECT_EQ(back->start, s.start);
  EXPECT_TRUE(back->offset_on && back->dry_run && back->auxiliary_lock);
  EXPECT_EQ(back->offset, s.offset);
  EXPECT_EQ(back->block_skip, s.block_skip);
  ASSERT_EQ(back->skips.size(), 1u);
  EXPECT_EQ(back->skips[0].touched, touch(1, 2).touched);
}

// 9 values are three rows of three axes.
TEST(ChannelSnapshot, LosesNoFieldOfItsMessage) {
  idl::stream::ChannelSnapshot stored, back;
  int n = 0;
  bus::Fields<idl::stream::ChannelSnapshot>::visit(stored, [&](const char*, auto& field, auto...) {
    using Field = std::remove_reference_t<decltype(field)>;
    ++n;
    if constexpr (std::is_enum_v<Field>)
      field = static_cast<Field>(1);
    else if constexpr (std::is_arithmetic_v<Field>)
      field = static_cast<Field>(n);
    else
      for (int i = 0; i < 9; ++i) field.push_back(n + 0.1 * i);
  });
  stored.skip_axes = 0b111;
  const auto snapshot = snapshot_of(stored);
  ASSERT_TRUE(snapshot);
  store(*snapshot, snapshot->skips, back);
  back.cycle = stored.cycle;  // the batch sets it
  EXPECT_EQ(back, stored);
}

TEST(ChannelSnapshot, IsNoneBeforeAnyoneHasWrittenOne) { EXPECT_FALSE(snapshot_of({})); }

}  // namespace
}  // namespace trunnion::channel
