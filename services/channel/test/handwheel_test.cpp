// SPDX-License-Identifier: Apache-2.0
// The handwheel: its followers' limits, axes moved by it, and its offset on a program.
#include "handwheel.hpp"

#include <cmath>
#include <random>

#include "channel_fixture.hpp"

namespace trunnion::channel {
namespace {

using testing::Channel;
using testing::CommandKind;
constexpr double cycle = 0.001;

TEST(AxisFollower, KeepsEveryLimitAndTheRangeOfItsTargetsWhateverIsTurned) {
  std::mt19937 random(7);
  for (int run = 0; run < 40; ++run) {
    const double v = 10 + run * 5, a = 200 + run * 100, j = 5000 + run * 2000;
    AxisFollower follower;
    follower.configure(v, a, j, cycle);
    double low = 0, high = 0, target = 0;
    double p[4]{};
    for (int n = 0; n < 4000; ++n) {
      if (random() % 40 == 0) {
        target += (static_cast<double>(random() % 2001) - 1000) * 0.01;
        low = std::min(low, target), high = std::max(high, target);
        follower.set_target(target);
      }
      if (random() % 900 == 0) follower.stop(), target = follower.target();
      p[0] = p[1], p[1] = p[2], p[2] = p[3], p[3] = follower.step();
      // Differences of rounded positions: 1e-14 mm in a cycle cubed is 1e-5 mm/s3.
      ASSERT_LE(std::abs(p[3] - p[2]) / cycle, v * 1.0001);
      ASSERT_LE(std::abs(p[3] - 2 * p[2] + p[1]) / (cycle * cycle), a * 1.0001);
      ASSERT_LE(std::abs(p[3] - 3 * p[2] + 3 * p[1] - p[0]) / (cycle * cycle * cycle), j * 1.001 + 0.1);
      ASSERT_GE(p[3], low - 1e-9);
      ASSERT_LE(p[3], high + 1e-9);
    }
    follower.set_target(target);
    for (int n = 0; n < 20000 && !follower.at_rest(); ++n) follower.step();
    EXPECT_EQ(follower.position(), target) << "bit for bit";
  }
}

struct WheelTest : Channel {
  Answer turn(int counts, double increment, std::uint8_t axis = 0) {
    return ask(CommandKind::HANDWHEEL, "", counts, increment, Mode::AUTO, axis);
  }
};

TEST_F(WheelTest, MovesAnAxisByItsCountsAndAddsThoseThatComeMeanwhile) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  cycles_per_round = 8;
  ASSERT_TRUE(turn(5, 0.1).accepted);
  for (int i = 0; i < 5; ++i) round();
  ASSERT_TRUE(turn(-2, 0.1).accepted);
  ASSERT_TRUE(turn(3, 0.01, 1).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(drive.rows.back()[0], 0.3, 1e-12);
  EXPECT_NEAR(drive.rows.back()[1], 0.03, 1e-12);
  ASSERT_TRUE(turn(1, 1).accepted);
  run();
  EXPECT_NEAR(drive.rows.back()[0], 1.3, 1e-12);
}

TEST_F(WheelTest, StopsAtTheTravelLimitAndRefusesWhatIsBeyond) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  ASSERT_TRUE(turn(500, 1).accepted);
  run();
  EXPECT_EQ(drive.rows.back()[0], 400);
  const auto answer = turn(1, 0.001);
  EXPECT_FALSE(answer.accepted);
  EXPECT_EQ(answer.alarm, 140u);
  EXPECT_TRUE(turn(-1, 0.001).accepted);
}

TEST_F(WheelTest, RefusesIncrementsCountsAndModesItDoesNotHave) {
  EXPECT_FALSE(turn(1, 0.5).accepted);
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  EXPECT_FALSE(turn(20000, 0.1).accepted);
  EXPECT_FALSE(turn(1, 0.1, 3).accepted);
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::AUTO);
  EXPECT_FALSE(turn(1, 0.1).accepted) << "its offset is off";
}

TEST_F(WheelTest, JogStopEndsTheDistanceThatCountsHaveLeft) {
  ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
  cycles_per_round = 8;
  turn(300, 1);
  for (int i = 0; i < 60; ++i) round();
  ask(CommandKind::JOG_STOP);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_LT(drive.rows.back()[0], 60);
}

TEST_F(WheelTest, AnOffsetIsAddedToARunningProgramWithinTheLimitsOfTheAxes) {
  load("G90\nG1 X100 F30000\nX0\nX100\nM30\n");
  ASSERT_TRUE(ask(CommandKind::HANDWHEEL_OFFSET, "", 1).accepted);
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 20; ++i) round();
  ASSERT_TRUE(turn(2, 1, 0).accepted);
  ASSERT_TRUE(turn(-3, 1, 2).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_NEAR(drive.rows.back()[0], 102, 1e-12);
  EXPECT_NEAR(drive.rows.back()[2], -3, 1e-12);
  EXPECT_EQ(core->state().handwheel_offset, (std::vector<double>{2, 0, -3}));
  const auto& limits = core->machine().limits().axes[0];
  for (std::size_t i = 3; i < drive.rows.size(); ++i) {
    const double p0 = drive.rows[i - 3][0], p1 = drive.rows[i - 2][0], p2 = drive.rows[i - 1][0],
                 p3 = drive.rows[i][0];
    ASSERT_LE(std::abs(p3 - p2) / cycle, limits.velocity * 1.001);
    ASSERT_LE(std::abs(p3 - 2 * p2 + p1) / (cycle * cycle), limits.acceleration * 1.001);
    ASSERT_LE(std::abs(p3 - 3 * p2 + 3 * p1 - p0) / (cycle * cycle * cycle), limits.jerk * 1.001);
  }
  // The next program keeps it, and without it the position is where the axes are.
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_NEAR(drive.rows.back()[0], 102, 1e-12);
  ASSERT_TRUE(ask(CommandKind::HANDWHEEL_OFFSET, "", 0).accepted);
  EXPECT_EQ(core->state().handwheel_offset, (std::vector<double>{0, 0, 0}));
  const auto before = drive.rows.size();
  ask(CommandKind::CYCLE_START);
  run();
  EXPECT_EQ(drive.rows.back()[0], 100);
  EXPECT_NEAR(drive.rows[before][0], 102, 0.01) << "it begins where the axes are";
}

TEST_F(WheelTest, AnOffsetLeavesThePlannedPathItsTravel) {
  load("G90\nG1 X399 F30000\nX0\nM30\n");
  ask(CommandKind::HANDWHEEL_OFFSET, "", 1);
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 5; ++i) round();
  ASSERT_TRUE(turn(50, 0.1).accepted);
  run();
  double farthest = 0;
  for (const auto& row : drive.rows) farthest = std::max(farthest, row[0]);
  EXPECT_NEAR(farthest, 400, 1e-9) << "1 mm of the 5 mm is left at X399";
}

TEST_F(WheelTest, ResetEndsTheOffsetWithoutAMove) {
  ask(CommandKind::HANDWHEEL_OFFSET, "", 1);
  ask(CommandKind::SET_MODE);
  ASSERT_TRUE(turn(1, 1).accepted);
  run();
  EXPECT_EQ(core->state().handwheel_offset[0], 1);
  const auto rows = drive.rows.size();
  ask(CommandKind::RESET);
  run();
  EXPECT_EQ(drive.rows.size(), rows);
  EXPECT_FALSE(core->state().handwheel_offset_on);
  EXPECT_EQ(core->state().machine[0], 1);
}

TEST_F(WheelTest, AKilledChannelContinuesWithItsOffset) {
  load("G90\nG1 X100 F6000\nM30\n");
  ask(CommandKind::HANDWHEEL_OFFSET, "", 1);
  cycles_per_round = 8;
  ask(CommandKind::CYCLE_START);
  for (int i = 0; i < 10; ++i) round();
  turn(2, 1, 1);
  for (int i = 0; i < 50; ++i) round();
  drive.lose_queue();
  drive.mode = DriveMode::HELD;
  begin();
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  run();
  EXPECT_EQ(drive.rows.back()[0], 100);
  EXPECT_NEAR(drive.rows.back()[1], 2, 1e-12);
  for (std::size_t i = 1; i < drive.rows.size(); ++i)
    ASSERT_LT(std::abs(drive.rows[i][1] - drive.rows[i - 1][1]), 0.1) << "no jump";
}

}  // namespace
}  // namespace trunnion::channel
