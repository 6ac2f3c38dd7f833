// SPDX-License-Identifier: Apache-2.0
// The positions an operator reads: the tool tip in the words of the block being executed.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "channel_fixture.hpp"
#include "modal_codes.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using idl::channel::Mode;

struct Display : testing::Channel {
  idl::parameters::WorkOffsets offsets;
  void SetUp() override {
    Channel::SetUp();
    offsets.offsets.push_back({0, 0, {100, 0, 10, 0, 0, 0, 0, 0, 0}});
    offsets.offsets.push_back({0, 1, {0, 50, 0, 0, 0, 0, 0, 0, 0}});
    core->set_offsets(offsets);
  }
  void expect(const std::vector<double>& workpiece, const std::vector<double>& machine) {
    const auto& state = core->state();
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(state.workpiece[i], workpiece[i], 1e-9) << i;
      EXPECT_NEAR(state.machine[i], machine[i], 1e-9) << i;
    }
  }
  /// A program that stops at M0 behind these lines.
  void stop_behind(const std::string& lines) {
    answer_plc = false;
    load("G90 G21 G54 G64\n" + lines + "M0\nM30\n");
    ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
    for (int i = 0; i < 2000 && auxiliaries.empty(); ++i) round();
    ASSERT_EQ(auxiliaries.size(), 1u);
  }
};

TEST_F(Display, OfAWorkOffset) {
  stop_behind("G0 X7 Y8 Z9\n");
  expect({7, 8, 9}, {107, 8, 19});
}

TEST_F(Display, OfALocalOffsetAndAShift) {
  stop_behind("G52 X10 Y1\nG0 X7 Y8 Z9\nG92 Z0\n");
  expect({7, 8, 0}, {117, 9, 19});
}

// (7, 8) turned by 90 degrees about the zero of G54 is (-8, 7).
TEST_F(Display, OfARotation) {
  stop_behind("G68 X0 Y0 R90\nG0 X7 Y8 Z9\n");
  expect({7, 8, 9}, {92, 7, 19});
}

TEST_F(Display, OfScalingMirrorAndToolLength) {
  stop_behind("G43 H1\nG51 X0 Y0 Z0 P2\nG51.1 X0\nG0 X7 Y8 Z9\n");
  expect({7, 8, 9}, {86, 16, 78});
}

// G55 X0 is the machine's zero, so behind the first move the program reads on to X-400 in the rotated G55.
// While that first move is executed its own frame counts: the display goes with the words, from X0 to X80.
TEST_F(Display, IsOfTheBlockUnderWayAndNotOfThoseReadAhead) {
  load("G90 G21 G54 G64\nG52 X10\nG1 X80 F6000\nG52 X0\nG55 G68 X0 Y0 R90\nG1 X0 Y-80\nM30\n");
  cycles_per_round = 8;
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  int first = 0, second = 0;
  for (int i = 0; i < 2000 && core->run_state() != idl::channel::RunState::IDLE; ++i) {
    round();
    const auto& state = core->state();
    if (state.line == 3 && core->link().state() == LinkState::active) {
      EXPECT_NEAR(state.workpiece[0], state.machine[0] - 110, 1e-9);
      ++first;
    } else if (state.line == 6 && core->link().state() == LinkState::active) {
      // The machine's (x, y) is the word (y - 50, -x).
      EXPECT_NEAR(state.workpiece[0], state.machine[1] - 50, 1e-9);
      EXPECT_NEAR(state.workpiece[1], -state.machine[0], 1e-9);
      ++second;
    }
  }
  EXPECT_GT(first, 10);
  EXPECT_GT(second, 10);
}

TEST_F(Display, KeepsTheFramesOfMdiUntilReset) {
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI).accepted);
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G90 G54 G52 X10").accepted);
  run();
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G0 X7 Y8 Z9").accepted);
  run();
  expect({7, 8, 9}, {117, 8, 19});
  // The table counts as it is now.
  idl::parameters::WorkOffsets offsets;
  offsets.offsets.push_back({0, 0, {101, 0, 10, 0, 0, 0, 0, 0, 0}});
  core->set_offsets(offsets);
  run();
  expect({6, 8, 9}, {117, 8, 19});
  ask(CommandKind::RESET);
  run();
  expect({16, 8, 9}, {117, 8, 19});
}

// Every line moves, so each has canonical commands with a state of their own (more than one at a corner of
// the compensated contour), and its line is shown while it is executed. The flow is some forty blocks ahead.
TEST_F(Display, TheModalStateIsThatOfTheCanonicalCommandBeingExecuted) {
  std::string program;
  for (int i = 0; i < 12; ++i) {
    const auto feed = std::to_string(1000 + 100 * i);
    program += "G90 G17 G40 G0 X0 Y0\nG41 D1 G1 X10 Y0 F" + feed + "\nG1 X20 Y5\nG3 X30 Y15 R10 F" + feed +
               "0\nG1 X30 Y40 G61\nG40 G0 X0 Y40 G64\nG91 G2 X10 Y10 R10 F" + feed +
               "\nG1 X-5 G55\nG90 G18 G20 G1 Z0.1\nG21 G54 G0 Z0\n";
  }
  load(program + "M30\n");
  channel_setup::ChannelSetup setup(0);
  setup.configure(*parameters);
  idl::parameters::ToolTable tools;
  tools.tools.resize(1);
  tools.tools[0].number = 1, tools.tools[0].radius = 1;
  setup.set_tools(tools);
  setup.set_offsets(offsets);
  core->set_tools(tools);
  language::Interpreter interpreter(setup);
  language::StringSource source(text);
  interpreter.start(source, {}, setup.power_on());
  std::map<std::uint32_t, std::vector<language::ModalState>> canonical;
  language::Command command;
  while (interpreter.next(command) == language::Step::command)
    canonical[command.line].push_back(command.modal);
  ASSERT_EQ(canonical.size(), 121u);
  cycles_per_round = 8;
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  int compared = 0;
  std::set<std::uint32_t> lines;
  for (int i = 0; i < 20000 && core->run_state() != idl::channel::RunState::IDLE; ++i) {
    round();
    const auto& state = core->state();
    if (state.line == 0 || core->run_state() != idl::channel::RunState::RUNNING) continue;
    const auto& made = canonical[state.line];
    ASSERT_TRUE(std::any_of(made.begin(), made.end(),
                            [&](const auto& modal) {
                              return state.modal == modal_codes(modal) && state.programmed_feed == modal.feed;
                            }))
        << "line " << state.line << " F" << state.programmed_feed << " "
        << ::testing::PrintToString(state.modal);
    lines.insert(state.line);
    ++compared;
  }
  EXPECT_EQ(events.size(), 0u);
  EXPECT_GT(compared, 200);
  EXPECT_GT(lines.size(), 100u);
}

TEST_F(Display, TheTypedLineIsNoLineOfTheProgram) {
  load("G90 G21 G54\nG1 X8 F6000\nX0\nM30\n");
  cycles_per_round = 8;
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  while (core->state().line != 3) round();
  ASSERT_TRUE(ask(CommandKind::FEED_HOLD).accepted);
  run();
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::MDI).accepted);
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G1 Y5 F6000").accepted);
  for (int i = 0; i < 5; ++i) round();
  EXPECT_EQ(core->state().line, 3u) << "of the held program";
  EXPECT_EQ(core->running_program().line, 3u);
  ASSERT_TRUE(ask(CommandKind::RESET).accepted);
  run();
  ASSERT_TRUE(ask(CommandKind::MDI_LINE, "G1 Y0 F6000").accepted);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(core->state().line, 0u);
    round();
  }
  run();
  EXPECT_EQ(core->state().line, 0u);
}

TEST_F(Display, TheSpindleSpeedBehindAStartFromALineIsTheRestoredOne) {
  load("G90 G21 G54\nS500 M3\nG1 X8 F6000\nS1500\nX0\nX5\nM30\n");
  ASSERT_TRUE(ask(CommandKind::START_FROM_LINE, "", 6).accepted);
  run();
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(core->state().spindle_programmed, 1500);
}

TEST_F(Display, OfAHeldProgramStaysThatOfItsBlockWhileTheAxesAreJogged) {
  load("G90 G21 G54\nG52 X10\nG1 X80 F6000\nG52 X0\nG1 X0\nM30\n");
  cycles_per_round = 8;
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  for (int i = 0; i < 20; ++i) round();
  ASSERT_TRUE(ask(CommandKind::FEED_HOLD).accepted);
  run();
  ASSERT_TRUE(ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG).accepted);
  round();
  const auto& state = core->state();
  EXPECT_NEAR(state.workpiece[0], state.machine[0] - 110, 1e-9);
}

TEST(FrameTrail, FindsTheFrameOfACommandAndForgetsTheOldest) {
  program_execution::FrameTrail trail;
  EXPECT_EQ(trail.at(5), nullptr);
  language::ProgramFrame frame;
  const auto x_at = [&](std::uint32_t sequence) { return trail.at(sequence)->total_offset()[0]; };
  for (std::uint32_t i = 0; i < 10; ++i) {
    frame.set_local(0, i);
    trail.add(3 + 10 * i, frame);
  }
  EXPECT_EQ(x_at(0), 0) << "before the first";
  EXPECT_EQ(x_at(3), 0);
  EXPECT_EQ(x_at(12), 0);
  EXPECT_EQ(x_at(13), 1);
  EXPECT_EQ(x_at(92), 8);
  EXPECT_EQ(x_at(1000), 9);
  for (std::uint32_t i = 10; i < 10 + program_execution::FrameTrail::capacity; ++i) {
    frame.set_local(0, i);
    trail.add(3 + 10 * i, frame);
  }
  EXPECT_EQ(x_at(13), 10) << "the oldest there is";
  EXPECT_EQ(x_at(10 * 500), 499);
  EXPECT_EQ(trail.newest()->total_offset()[0], 9 + program_execution::FrameTrail::capacity);
}

}  // namespace
}  // namespace trunnion::channel
