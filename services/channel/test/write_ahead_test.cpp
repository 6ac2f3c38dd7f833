// SPDX-License-Identifier: Apache-2.0
// How far the channel runs ahead of the drive in virtual time (parameters 000900, 000902, 000903), and that
// the setpoints do not depend on it.
#include <functional>
#include <map>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using testing::Channel;
using testing::FakeDrive;

struct WriteAhead : Channel {
  bool gantry = false;
  void begin_with(double lead, double ahead, double batch) {
    parameters = testing::three_axes(2);
    auto& values = parameters->values;
    values[900] = {lead, ""}, values[902] = {batch, ""}, values[903] = {ahead, ""};
    values[105000] = {0, "S"}, values[105001] = {10, ""};  // a spindle for tapping
    values[105036] = {12000, ""};
    if (gantry) {  // axis 6, which belongs to no channel, follows X
      values[106000] = {0, "X1"};
      values[50] = {1, ""}, values[51] = {6, ""};
      values[106100] = {1, ""}, values[106101] = {0, ""};
    }
    drive = FakeDrive(3);
    drive.switch_ = {1, 0, 20.25};  // of the G31 below
    begin();
  }
  /// What the drive executes of `program`.
  std::vector<std::vector<double>> rows_of(const std::string& program) {
    load(program);
    EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    run();
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    EXPECT_TRUE(events.empty());
    return drive.rows;
  }
  /// The same with changes at fixed cycles, which every batch that divides 64 meets.
  std::vector<std::vector<double>> rows_with_changes(const std::string& program) {
    load(program);
    EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    const std::map<std::uint64_t, std::function<void()>> changes = {
        {128, [&] { ask(CommandKind::FEED_OVERRIDE, "", 0.5); }},
        {448, [&] { ask(CommandKind::FEED_OVERRIDE, "", 1.2); }},
        {576, [&] { ask(CommandKind::FEED_HOLD); }},
    };
    std::size_t made = 0;
    for (int i = 0; i < 100000 && core->run_state() != RunState::IDLE; ++i) {
      begin_round();
      idl::stream::PathBatch out;
      while (core->produce(out)) {
        drive.put(out);
        if (const auto found = changes.find(core->link().next()); found != changes.end()) {
          found->second();
          ++made;
        }
      }
      end_round();
      if (core->run_state() == RunState::HELD) {
        EXPECT_TRUE(ask(CommandKind::CYCLE_START).accepted);
      }
    }
    EXPECT_EQ(made, changes.size());
    EXPECT_EQ(core->run_state(), RunState::IDLE);
    return drive.rows;
  }
  /// Cycles written and not executed when the drive executes nothing more.
  std::uint64_t written_ahead() {
    cycles_per_round = 0;
    for (int i = 0; i < 20; ++i) round();
    return core->link().next() - core->link().executed();
  }
};

// An exact stop, a skip move that is ended by its input, corners, an arc, tapping and a dwell.
const char* const everything =
    "G21 G90 G94 G54\nG9 G1 X10 F3000\nG1 X12 Y3\nG31 X60 F1200\nG1 X20 F2000\nG2 X30 Y3 I5 J0 F2000\nS400 "
    "M3\n"
    "G99 G84 X30 Y3 Z-4 R2 F500\nG80\nG4 P50\nG0 X0 Y0 Z20\nM30\n";

TEST_F(WriteAhead, TheSetpointsAreTheSameForEveryDistanceAndBatchAndHoweverTheFeedbackArrives) {
  begin_with(32, 32, 16);
  const auto expected = rows_of(everything);
  ASSERT_GT(expected.size(), 1440u) << "6 mm down and up at 500 mm/min alone";
  for (const double ahead : {32.0, 100.0, 256.0, 512.0})
    for (const double batch : {1.0, 16.0, 64.0})
      for (const std::uint64_t cycles : {1ull, 40ull, 100000ull}) {
        begin_with(32, ahead, batch);
        cycles_per_round = cycles;
        EXPECT_EQ(rows_of(everything), expected)
            << ahead << " cycles, batches of " << batch << ", " << cycles;
      }
}

// No cycle of such a motion looks back by the lead, so the lead is a bound of the distance and no more.
const char* const without_feedback =
    "G21 G90 G94 G54 G64\nG1 X10 F3000\nG1 X12 Y3\nG2 X30 Y3 I9 J0 F2000\nG1 X40.1 Y3.2\nX40.2 Y3.4\n"
    "X40.3 Y3.5\nX60 Y20 Z4\nG0 X0 Y0 Z20\nM30\n";

TEST_F(WriteAhead, TheLeadChangesNoSetpointOfAMotionWithoutFeedbackUnderOverridesAndAHold) {
  begin_with(32, 32, 16);
  const auto expected = rows_with_changes(without_feedback);
  ASSERT_GT(expected.size(), 1500u) << "70 mm at 3000 mm/min and less";
  std::size_t standing = 0;
  for (std::size_t i = 577; i < expected.size(); ++i) standing += expected[i] == expected[i - 1] ? 1 : 0;
  EXPECT_GT(standing, 0u) << "it was held";
  for (const double lead : {8.0, 64.0, 128.0, 256.0})
    for (const double batch : {1.0, 16.0, 64.0})
      for (const std::uint64_t cycles : {64ull, 100000ull}) {
        begin_with(lead, 512, batch);
        cycles_per_round = cycles;
        EXPECT_EQ(rows_with_changes(without_feedback), expected)
            << "lead " << lead << ", batches of " << batch << ", " << cycles;
      }
}

TEST_F(WriteAhead, AGantryHasTheSetpointsOfAMachineWithoutOne) {
  begin_with(32, 512, 64);
  const auto expected = rows_with_changes(without_feedback);
  gantry = true;
  for (const double lead : {8.0, 32.0, 128.0}) {
    begin_with(lead, 512, 64);
    EXPECT_EQ(rows_with_changes(without_feedback), expected) << "lead " << lead;
  }
}

TEST_F(WriteAhead, AProgramIsWrittenToTheLimitInWholeBatches) {
  begin_with(32, 256, 64);
  load("G21 G90 G94 G54\nG1 X100 F1000\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  EXPECT_EQ(written_ahead(), 256u);
}

TEST_F(WriteAhead, ASkipMoveAndAJogAreWrittenToTheLeadOnly) {
  begin_with(32, 256, 64);
  load("G21 G90 G94 G54\nG31 X100 F1000\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  EXPECT_EQ(written_ahead(), 32u);
  begin_with(32, 256, 64);
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG).accepted);
  ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", 1000, 0).accepted);
  EXPECT_EQ(written_ahead(), 32u);
}

TEST_F(WriteAhead, AtAnExactStopTheChannelWaitsForTheFeedbackOfTheLead) {
  begin_with(32, 256, 64);
  load("G21 G90 G94 G54\nG9 G1 X0.2 F3000\nG1 X100 F1000\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  // The move of 0.2 mm ends within the first 256 cycles. Nothing behind its stop can be computed before the
  // following error at the stop is known, so at most the move, the cycle that finds the stop and one lead are
  // written.
  const auto ahead = written_ahead();
  EXPECT_LT(ahead, 256u);
  cycles_per_round = ~0ull;
  run();
  std::size_t move = 0;
  while (drive.rows[move][0] < 0.2) ++move;
  EXPECT_LE(ahead, move + 2 + 32);
}

}  // namespace
}  // namespace trunnion::channel
