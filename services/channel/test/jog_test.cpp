// SPDX-License-Identifier: Apache-2.0
// A jog without an increment: it lasts as long as its press is renewed, by machine time.
#include "channel_fixture.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::channel {
namespace {
using namespace testing;

class Jog : public Channel {
 protected:
  void SetUp() override {
    Channel::SetUp();
    ask(CommandKind::SET_MODE, "", 0, 0, Mode::JOG);
    cycles_per_round = 8;
  }
  Answer press(std::uint32_t number, double speed = 3000) {
    return ask({.command = CommandKind::JOG_AXIS, .speed = speed, .press = number});
  }
  Answer renew(std::uint32_t number) { return ask({.command = CommandKind::JOG_RENEW, .press = number}); }
  void rounds(int count) {
    for (int i = 0; i < count; ++i) round();
  }
  double x() const { return drive.rows.empty() ? 0 : drive.rows.back()[0]; }
};

// 3000 mm/min = 50 mm/s; the default of 04c917 is 0.25 s.
constexpr double speed = 50, renewal_seconds = 0.25;

TEST_F(Jog, StopsWhenTheKeyIsReleased) {
  ASSERT_TRUE(press(5).accepted);
  rounds(20);
  ask(CommandKind::JOG_STOP);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_GT(x(), 1);
  // Twenty rounds of 8 cycles, what is written ahead, and braking.
  EXPECT_LT(x(), speed * (0.16 + 0.1 + 0.05));
}

TEST_F(Jog, WithoutARenewalStopsByItselfAfterItsTime) {
  ASSERT_TRUE(press(5).accepted);
  run();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  // It accelerates within some hundredths of a second, and the round in which the time ends, what is written
  // ahead (8 cycles here) and braking follow.
  EXPECT_GT(x(), speed * (renewal_seconds - 0.1));
  EXPECT_LT(x(), speed * (renewal_seconds + 0.1));
  const double there = x();
  EXPECT_FALSE(renew(5).accepted) << "a renewal that comes too late starts nothing";
  rounds(20);
  EXPECT_EQ(x(), there);
}

TEST_F(Jog, RenewedGoesToTheTravelLimitAndIsRefusedThere) {
  ASSERT_TRUE(press(5).accepted);
  for (int i = 0; i < 5000 && core->run_state() != RunState::IDLE; ++i) {
    renew(5);
    round();
  }
  EXPECT_EQ(x(), 400);
  EXPECT_FALSE(press(6).accepted) << "at the limit";
  ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", -3000, 0.1).accepted);
  run();
  EXPECT_NEAR(x(), 399.9, 1e-12);
}

TEST_F(Jog, IsNotStartedAgainByTheRenewalsOfAStationWhenAnotherHasStoppedIt) {
  ASSERT_TRUE(press(5).accepted);
  rounds(10);
  ask(CommandKind::JOG_STOP);
  EXPECT_EQ(renew(5).reason, "Jog press 5 has ended: release the key and press it again");
  run();
  const double there = x();
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(renew(5).accepted);
    round();
  }
  EXPECT_EQ(x(), there);
  EXPECT_EQ(core->run_state(), RunState::IDLE);
}

TEST_F(Jog, IsNotRenewedByAnotherPress) {
  ASSERT_TRUE(press(5).accepted);
  for (int i = 0; i < 60 && core->run_state() != RunState::IDLE; ++i) {
    EXPECT_FALSE(renew(4).accepted);
    EXPECT_FALSE(press(6).accepted) << "busy";
    round();
  }
  EXPECT_LT(x(), speed * (renewal_seconds + 0.1));
}

TEST_F(Jog, ByAnIncrementNeedsNoRenewal) {
  ASSERT_TRUE(ask(CommandKind::JOG_AXIS, "", 3000, 100).accepted);
  run();
  EXPECT_NEAR(x(), 100, 1e-12);
}

TEST_F(Jog, TimeThatPassesInAHoldCountsToo) {
  ASSERT_TRUE(press(5).accepted);
  rounds(10);
  ask(CommandKind::FEED_HOLD);
  run();
  ASSERT_EQ(core->run_state(), RunState::HELD);
  drive.tick += 251;  // 1 ms each
  rounds(2);
  EXPECT_FALSE(renew(5).accepted);
}

}  // namespace
}  // namespace trunnion::channel
