// SPDX-License-Identifier: Apache-2.0
// Any commands in any sequence: the setpoints never jump and the channel never gets stuck.
#include <cmath>
#include <random>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::CommandKind;

struct RandomCommands : Channel, ::testing::WithParamInterface<int> {};

const char* const program =
    "G90 G64 F9000\nS800 M3\nG1 X40 Y10\nG2 X80 Y10 I20 J0\nG1 X60 Z-20\nM8\nG1 X0 Y0 Z0\nM0\n"
    "G1 X30 Y-30\nG4 P20\nX-30\nM9\nY30 Z10\nX0 Y0 Z0\nM30\n";

TEST_P(RandomCommands, NeverMakeASetpointJumpOrLeaveTravelAndAResetAlwaysHelps) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  load(program);
  cycles_per_round = 16;
  for (int n = 0; n < 250; ++n) {
    const auto axis = static_cast<std::uint8_t>(below(3));
    switch (below(22)) {
      case 0:
      case 1:
      case 2:
      case 3:
      case 4:
        ask(CommandKind::CYCLE_START);
        break;
      case 5:
        ask(CommandKind::FEED_HOLD);
        break;
      case 6:
        ask(CommandKind::SET_MODE, "", 0, 0, static_cast<Mode>(below(4)));
        break;
      case 7:
      case 8:
      case 9:
        ask(CommandKind::SET_MODE);
        break;
      case 10:
        ask(CommandKind::RETRACE, "", below(2));
        break;
      case 11:
        ask(CommandKind::MDI_LINE, below(2) != 0 ? "G91 G1 X3 Z-2 F4000" : "M5");
        break;
      case 12:
        ask(CommandKind::JOG_AXIS, "", 2000 - 4000 * below(2), below(5), Mode::AUTO, axis);
        break;
      case 13:
        ask(CommandKind::JOG_STOP);
        break;
      case 14:
      case 15:
        ask(CommandKind::HANDWHEEL, "", below(9) - 4, 0.1, Mode::AUTO, axis);
        break;
      case 16:
        ask(CommandKind::HANDWHEEL_OFFSET, "", below(3));
        break;
      case 17:
        ask(CommandKind::FEED_OVERRIDE, "", below(4) * 0.5);
        break;
      case 18:
        ask(CommandKind::START_FROM_LINE, "", 1 + below(15));
        break;
      case 19:
        ask(CommandKind::SINGLE_BLOCK, "", below(2));
        break;
      case 20:
        ask(CommandKind::DRY_RUN, "", below(2));
        break;
      default:
        if (below(4) == 0) ask(CommandKind::RESET);
        break;
    }
    for (int k = below(12); k >= 0; --k) round();
  }
  // Axes start from 0, and a jump would be above the fastest axis' distance in a cycle.
  std::vector<double> before(9, 0.0);
  for (const auto& row : drive.rows)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& limits = core->machine().limits().axes[i];
      ASSERT_LE(std::abs(row[i] - before[i]),
                std::max(limits.velocity, limits.rapid_velocity) * 0.001 * 1.001);
      ASSERT_LE(std::abs(row[i]), 400 + 1e-6);
      before[i] = row[i];
    }
  ask(CommandKind::FEED_OVERRIDE, "", 1);
  ask(CommandKind::SINGLE_BLOCK, "", 0);
  ask(CommandKind::RESET);
  for (int n = 0; n < 400 && core->run_state() != RunState::IDLE; ++n) round();
  ASSERT_EQ(core->run_state(), RunState::IDLE);
  events.clear();
  load("G90 F9000\nG1 X7 Y8 Z9\nM30\n");
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  ASSERT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(drive.rows.back()[0], 7);
  EXPECT_EQ(drive.rows.back()[2], 9);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomCommands, ::testing::Range(1, 16));

}  // namespace
}  // namespace trunnion::channel
