// SPDX-License-Identifier: Apache-2.0
// The machine's own programs on the core: handshakes and restart, all by the drive's ticks.
#include <gtest/gtest.h>

#include "core_bench.hpp"

namespace trunnion::plc {
namespace {

using enum AuxiliaryKind;

TEST(Handshake, AnUnknownMAndATAreFinishedWithoutTime) {
  Bench bench;
  bench.request(M, 99);
  EXPECT_TRUE(bench.done());
  bench.request(T, 5);
  EXPECT_TRUE(bench.done());
  EXPECT_EQ(bench.run(), 0u);
  EXPECT_EQ(bench.finished.size(), 2u);
}

TEST(Handshake, M3WaitsUntilTheSpindleIsWithinFivePercent) {
  Bench bench;
  bench.request(S, 0, 1000);
  ASSERT_TRUE(bench.done());  // the spindle is at standstill by command: S alone moves nothing
  bench.request(M, 3);
  EXPECT_FALSE(bench.done());
  // 2 1/min in each ms reach 950 after 475 ms; the PLC checks every 10 ms.
  std::uint64_t waited = 0;
  while (!bench.done() && waited < 2000) {
    const auto until = bench.core.outputs().run_until_tick;
    ASSERT_EQ(until, bench.tick + 10);
    for (; bench.tick < until; ++bench.tick, ++waited) bench.speed[0] += bench.ramp;
    bench.feedback();
  }
  EXPECT_EQ(waited, 480u);
  EXPECT_EQ(bench.core.outputs().spindle_speed[0], 1000);
}

TEST(Handshake, M4TurnsTheOtherWayAndM5WaitsForStandstill) {
  Bench bench;
  bench.request(S, 0, 200);
  bench.request(M, 4);
  bench.run();
  EXPECT_TRUE(bench.done());
  EXPECT_EQ(bench.core.outputs().spindle_speed[0], -200);
  const double before = bench.speed[0];
  EXPECT_LE(before, -190);
  bench.request(M, 5);
  EXPECT_FALSE(bench.done());
  bench.run();
  EXPECT_TRUE(bench.done());
  EXPECT_GE(bench.speed[0], -5);
  EXPECT_EQ(bench.core.outputs().spindle_speed[0], 0);
}

TEST(TouchProbe, M40SwitchesItOnAndTheContactIsAnInputOfTheFastTask) {
  Bench bench("ac-table");
  bench.request(M, 40);
  EXPECT_TRUE(bench.core.outputs().probe_on);
  EXPECT_FALSE(bench.done());
  EXPECT_GE(bench.run(), 100u) << "until the receiver has started";
  EXPECT_TRUE(bench.done());
  const auto contact = [&] { return (bench.core.image().x[4] & 1u << 5) != 0; };  // X4.5
  EXPECT_FALSE(contact());
  bench.skip_inputs = 1;
  bench.feedback();
  EXPECT_TRUE(contact());
  bench.skip_inputs = 2;
  bench.feedback();
  EXPECT_FALSE(contact()) << "input 2 is another";
  bench.request(M, 41);
  EXPECT_TRUE(bench.done());
  EXPECT_FALSE(bench.core.outputs().probe_on);
}

TEST(TouchProbe, TheFirstOfTwoChannelsHasItAndTheSecondRefusesIt) {
  Bench bench("two-channel");
  bench.request(M, 40, 0, 1);
  ASSERT_TRUE(bench.done());
  EXPECT_TRUE(bench.finished.back().failed);
  EXPECT_FALSE(bench.core.outputs().probe_on);
  bench.request(M, 40);
  EXPECT_TRUE(bench.core.outputs().probe_on);
  EXPECT_EQ(bench.run(), 100u) << "until the receiver has started";
  ASSERT_TRUE(bench.done());
  EXPECT_FALSE(bench.finished.back().failed);
  bench.request(M, 41);
  EXPECT_TRUE(bench.done());
  EXPECT_FALSE(bench.core.outputs().probe_on);
}

TEST(TouchProbe, M70FailsInContact) {
  Bench bench("ac-table");
  bench.skip_inputs = 1;
  bench.feedback();
  bench.request(M, 70);
  bench.run();
  ASSERT_TRUE(bench.done());
  EXPECT_TRUE(bench.finished.back().failed);
  EXPECT_FALSE(bench.core.outputs().probe_on);
}

TEST(Handshake, AnotherSWithTurningSpindleWaitsForTheNewSpeed) {
  Bench bench;
  bench.request(S, 0, 200);
  bench.request(M, 3);
  bench.run();
  bench.request(S, 0, 400);
  EXPECT_FALSE(bench.done());
  bench.run();
  EXPECT_TRUE(bench.done());
  EXPECT_GE(bench.speed[0], 380);
}

// M19 of a turning spindle: 200 1/min at 2 1/min in a tick are 100 ticks.
TEST(Handshake, M19IsFinishedWhenTheDriveHoldsTheSpindleAtItsAngle) {
  Bench bench("ac-table");
  bench.request(S, 0, 200);
  bench.request(M, 3);
  bench.run();
  bench.request(M, 19);
  EXPECT_FALSE(bench.done());
  EXPECT_EQ(bench.core.outputs().spindle_orient[0], 1);
  EXPECT_EQ(bench.core.outputs().spindle_speed[0], 0);
  const auto time = bench.run();
  EXPECT_TRUE(bench.done());
  EXPECT_FALSE(bench.finished.back().failed);
  EXPECT_GE(time, 95u) << "it is not finished while the spindle turns";
  bench.request(M, 19);
  EXPECT_TRUE(bench.done()) << "it is held already";
  bench.request(M, 3);
  EXPECT_EQ(bench.core.outputs().spindle_orient[0], 0);
}

// Arm 300, drawbar 200, rotation 400, drawbar 200, arm 300 ms. T1 is before the arm; T5 is 4 places of 150 ms
// away.
TEST(ToolChanger, M6TakesTheTimeOfItsMovementsWithTheMagazineInPlaceOrNot) {
  Bench bench("ac-table");
  bench.request(T, 1);
  bench.request(M, 6);
  EXPECT_NEAR(static_cast<double>(bench.run()), 1400, 12);
  EXPECT_TRUE(bench.done());
  EXPECT_FALSE(bench.finished.back().failed);
  bench.request(T, 5);
  EXPECT_TRUE(bench.done()) << "the program goes on while the magazine turns";
  bench.request(M, 6);
  EXPECT_NEAR(static_cast<double>(bench.run()), 600 + 1400, 12);
  EXPECT_TRUE(bench.done());
  bench.request(T, 5);
  bench.request(M, 6);
  EXPECT_TRUE(bench.done()) << "the tool is in the spindle";
  bench.request(T, 30);
  EXPECT_TRUE(bench.finished.back().failed) << "the magazine has 24 places";
}

TEST(Handshake, M6TakesExactlyTheChangersTimeOnAStandingSpindle) {
  Bench bench;
  bench.request(M, 6);
  EXPECT_FALSE(bench.done());
  EXPECT_EQ(bench.core.outputs().run_until_tick, bench.tick + 300);
  EXPECT_EQ(bench.run(), 300u);
  EXPECT_TRUE(bench.done());
  bench.tick += 7;  // another phase of the main task takes the same time
  bench.feedback();
  bench.request(M, 6);
  EXPECT_EQ(bench.run(), 300u);
  EXPECT_TRUE(bench.done());
}

TEST(Handshake, TicksAreTheSameEveryTime) {
  const auto ticks = [] {
    Bench bench;
    std::vector<std::uint64_t> result;
    const std::vector<std::pair<AuxiliaryKind, std::uint32_t>> sequence = {
        {S, 3000}, {M, 3}, {M, 8}, {S, 500}, {M, 6}, {M, 4}, {M, 30}};
    for (const auto& [kind, code] : sequence) {
      bench.request(kind, code, code);
      result.push_back(bench.run());
      EXPECT_TRUE(bench.done()) << bus::to_string(kind) << " " << code;
    }
    return result;
  };
  const auto first = ticks();
  EXPECT_EQ(first, ticks());
}

TEST(Handshake, ARequestWaitsForTheDriveToConfirmTheStandstill) {
  Bench bench;
  bench.active = true;
  bench.feedback();
  bench.executed = 600;
  bench.request(M, 6);  // the drive's batch of cycle 600 has not arrived
  EXPECT_TRUE(bench.core.waits_for_standstill());
  EXPECT_EQ(bench.core.outputs().run_until_tick, bench.tick);
  bench.tick += 100, bench.active = false;
  bench.feedback();
  EXPECT_FALSE(bench.core.waits_for_standstill());
  EXPECT_EQ(bench.run(), 300u);
  EXPECT_TRUE(bench.done());
}

TEST(Handshake, ARepeatedRequestIsConfirmedAgainButNotCarriedOutAgain) {
  Bench bench;
  bench.request(M, 6);
  bench.run();
  ASSERT_EQ(bench.finished.size(), 1u);
  bench.core.set_request({0, bench.number, M, 6, 0, false, bench.executed});
  bench.step();
  EXPECT_EQ(bench.finished.size(), 2u);
  EXPECT_EQ(bench.run(), 0u);
}

TEST(Handshake, AWithdrawnRequestIsNotFinished) {
  Bench bench;
  bench.request(M, 6);
  bench.core.set_request({0, bench.number, NO_AUXILIARY, 0, 0, false, bench.executed});
  bench.run();
  EXPECT_TRUE(bench.finished.empty());
}

TEST(Handshake, CoolantIsSwitchedByM7M8M9AndTheEndOfTheProgram) {
  Bench bench;
  const auto coolant = [&] { return bench.core.outputs().coolant[0] + 2 * bench.core.outputs().coolant[1]; };
  bench.request(M, 8);
  EXPECT_EQ(coolant(), 1);
  bench.request(M, 7);
  EXPECT_EQ(coolant(), 3);
  bench.request(M, 9);
  EXPECT_EQ(coolant(), 0);
  bench.request(M, 8);
  bench.request(M, 0);
  EXPECT_EQ(coolant(), 1);  // a program stop leaves it on
  bench.request(M, 30);
  EXPECT_EQ(coolant(), 0);
  EXPECT_TRUE(bench.done());
}

TEST(Handshake, TheSpindleOverrideActsOnTheTurningSpindle) {
  Bench bench;
  bench.request(S, 0, 1000);
  bench.request(M, 3);
  bench.run();
  idl::channel::ChannelState state;
  state.spindle_override = 1.2, state.feed_override = 1, state.rapid_override = 1;
  bench.core.set_channel(state);
  bench.step();
  EXPECT_EQ(bench.core.outputs().spindle_speed[0], 1200);
}

TEST(Handshake, AResetOfTheChannelStopsSpindleAndCoolant) {
  Bench bench;
  bench.request(S, 0, 100);
  bench.request(M, 3);
  bench.run();
  bench.request(M, 8);
  idl::channel::ChannelState state;
  state.spindle_override = 1, state.reset_count = 4;
  bench.core.set_channel(state);
  bench.step();
  EXPECT_EQ(bench.core.outputs().spindle_speed[0], 100);  // the first count says nothing
  state.reset_count = 5;
  bench.core.set_channel(state);
  bench.step();
  EXPECT_EQ(bench.core.outputs().spindle_speed[0], 0);
  EXPECT_EQ(bench.core.outputs().coolant[0], 0);
}

TEST(Handshake, TwoChannelsHaveTheirOwnSpindles) {
  Bench bench("two-channel");
  bench.request(S, 0, 300, 0);
  bench.request(S, 0, 700, 1);
  bench.request(M, 3, 0, 0);
  bench.request(M, 4, 0, 1);
  bench.run();
  EXPECT_EQ(bench.core.outputs().spindle_speed, (std::vector<double>{300, -700}));
  EXPECT_EQ(bench.finished.size(), 4u);
  bench.request(M, 8, 0, 1);
  EXPECT_EQ(bench.core.outputs().coolant, (std::vector<std::uint8_t>{0, 0, 1, 0, 0, 0, 0, 0}));
}

TEST(Restart, AProcessThatComesBackGoesOnWhereItWas) {
  Bench bench;
  bench.request(S, 0, 500);
  bench.request(M, 3);
  bench.run();
  bench.request(M, 6);  // 500 1/min first come down, then the changer's time: interrupt it within
  const auto target = bench.core.outputs();
  Bench fresh("two-channel", false);
  fresh.core.restore(bench.core.memory());
  EXPECT_EQ(fresh.core.outputs(), target);
  fresh.tick = bench.tick, fresh.speed = bench.speed, fresh.number = bench.number,
  fresh.executed = bench.executed;
  fresh.core.set_request({0, bench.number, M, 6, 0, false, bench.executed});
  fresh.feedback();
  const auto rest = fresh.run();
  EXPECT_TRUE(fresh.done());
  EXPECT_EQ(fresh.finished.size(), 1u);
  EXPECT_EQ(rest, bench.run());  // the same ticks as without the restart
  // Again after it is done: confirmed, not repeated.
  Bench third;
  third.core.restore(fresh.core.memory());
  ASSERT_EQ(third.core.all_done().size(), 1u);
  EXPECT_EQ(third.core.all_done()[0].number, bench.number);
}

TEST(Restart, APowerUpKeepsOnlyTheKeptRegisters) {
  Bench bench;
  bench.request(S, 0, 500);
  bench.request(M, 3);
  bench.run();
  auto memory = bench.core.memory();
  memory.registers.b[7] = 42;
  Bench fresh;
  fresh.core.power_up(memory);
  fresh.feedback();
  EXPECT_EQ(fresh.core.outputs().spindle_speed[0], 0);
  EXPECT_EQ(fresh.core.image().b[7], 42);
}

TEST(Scans, FollowTheTicksAndSkipWhatIsTooOld) {
  Bench bench;
  const auto before = bench.core.image().scan;
  bench.tick += 150;
  bench.feedback();
  EXPECT_EQ(bench.core.image().scan, before + 150);
  bench.tick += 100000;
  bench.feedback();
  EXPECT_EQ(bench.core.image().scan, before + 100150);
}

}  // namespace
}  // namespace trunnion::plc
