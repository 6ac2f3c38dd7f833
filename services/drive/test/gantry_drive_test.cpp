// SPDX-License-Identifier: Apache-2.0
// The executor with a gantry: alignment at the release of the emergency stop, a slave that is taken off,
// homing of both sides together.
#include "bus/json.hpp"
#include "gantry_bench.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::drive {
namespace {

using idl::stream::StreamRequestKind;
using Numbers = std::vector<std::uint32_t>;

struct Gantry : testing::Test, GantryMachine {
  void SetUp() override { axis(2, 107, 0.5), axis(2, 62, 1); }
};

TEST_F(Gantry, BelowTheLimitTheReleaseOfTheEmergencyStopAlignsTheSlave) {
  build(100, 100.3);
  release();
  EXPECT_NEAR(error(), 0, settled);
  EXPECT_NEAR(feedback.position[1], 100, 1e-5) << "the master stays";
  EXPECT_LE(fastest, 10 * 1.2) << "10a130: 0.01 mm in a cycle are 10 mm/s; the servo overshoots a little";
  EXPECT_EQ(core->mode(), Mode::FOLLOWING);
  EXPECT_EQ(alarms(), Numbers{});
  EXPECT_TRUE(move(100, 50));
  EXPECT_NEAR(feedback.position[2], 150, settled);
}

TEST_F(Gantry, AboveTheLimitItIsAnAlarmAndNothingMoves) {
  build(100, 100.6);
  release();
  EXPECT_NEAR(error(), 0.6, 2e-5);
  EXPECT_EQ(fastest, 0);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].part, 2u);
  EXPECT_NE(events[0].text.find("0.6000 mm"), std::string::npos) << events[0].text;
  EXPECT_NE(events[0].text.find("102107"), std::string::npos) << events[0].text;
  EXPECT_EQ(alarms(), Numbers{121});
  EXPECT_FALSE(move(100, 50)) << "no channel moves it";
  EXPECT_EQ(alarms(), Numbers{121});
  core->acknowledge();
  EXPECT_FALSE(started()) << "a reset does not align it";
}

TEST_F(Gantry, ExactlyAtTheLimitItIsAligned) {
  build(100, 100.5 - 1e-5);
  release();
  EXPECT_NEAR(error(), 0, settled);
}

TEST_F(Gantry, WithoutAlignmentTheSlaveKeepsItsDistanceInEveryMotion) {
  axis(2, 62, 0);
  build(100, 100.3);
  release();
  EXPECT_NEAR(error(), 0.3, 2e-5);
  EXPECT_EQ(fastest, 0) << "nothing moves at the release";
  EXPECT_EQ(alarms(), Numbers{});
  ASSERT_TRUE(move(100, 50));
  EXPECT_NEAR(error(), 0.3, 2e-4);
  ASSERT_TRUE(move(150, -30));
  EXPECT_NEAR(error(), 0.3, 2e-4);
  EXPECT_LT(largest, 0.31) << "both sides have the same servo: they follow alike";
}

TEST_F(Gantry, TheFirstStartAwayFromTheAxesKeepsTheDistanceToo) {
  axis(2, 62, 0);
  build(100, 100.3);
  release();
  ASSERT_TRUE(move(120, 10)) << "the drive moves to 120 first";
  EXPECT_NEAR(feedback.position[1], 130, 1e-3);
  EXPECT_NEAR(error(), 0.3, 2e-4);
}

TEST_F(Gantry, TheOtherLimitsBoundTheAlignmentToo) {
  for (const std::uint32_t limit : {106u, 131u}) {
    axis(2, 106, 0), axis(2, 131, 1);
    axis(2, limit, 0.2);
    build(100, 100.3);
    release();
    EXPECT_NEAR(error(), 0.3, 2e-5) << limit;
    EXPECT_EQ(alarms(), Numbers{121}) << limit;
  }
}

TEST_F(Gantry, AMirroredSlaveWithAZeroDeviationIsAlignedToItsOwnPlace) {
  axis(2, 127, 1), axis(2, 129, 5);
  build(100, -94.8);  // its place is 5 - 100
  release();
  EXPECT_NEAR(feedback.position[2], -95, settled);
}

TEST_F(Gantry, AnEmergencyStopWithinTheAlignmentStopsItAndTheNextReleaseEndsIt) {
  build(100, 100.4);
  core->set_enables({1, 1, 1}, false);
  for (int i = 0; i < 20; ++i) core->step();
  emergency_stop();
  EXPECT_EQ(core->mode(), Mode::OFF);
  EXPECT_GT(error(), 0.1);
  EXPECT_LT(error(), 0.4);
  release();
  EXPECT_NEAR(error(), 0, settled);
}

TEST_F(Gantry, AfterAnEmergencyStopInMotionTheSlaveIsAlignedBeforeTheNextStart) {
  build(0, 0);
  release();
  ASSERT_TRUE(move(0, 100, 500, 160)) << "the setpoints end in motion";
  emergency_stop();
  EXPECT_EQ(core->mode(), Mode::OFF);
  request(StreamRequestKind::LEAVE);
  release();
  EXPECT_NEAR(error(), 0, settled);
  EXPECT_TRUE(move(feedback.position[1], 10));
  EXPECT_NEAR(error(), 0, 1e-4);
}

TEST_F(Gantry, ARestartedDriveAlignsOrKeepsTheDistanceAsBefore) {
  axis(2, 62, 0);
  build(100, 100.3);
  release();
  ASSERT_TRUE(move(100, 50));
  const auto memory = core->memory();
  for (const double aligns : {0, 1}) {
    axis(2, 62, aligns);
    GantryMachine second;
    second.parameters = parameters;
    second.build(memory.position[1], memory.position[2]);
    second.release();
    ASSERT_TRUE(second.move(150, 10));
    EXPECT_NEAR(second.error(), aligns == 1 ? 0 : 0.3, 2e-4);
  }
}

TEST_F(Gantry, WhatCompensationPutsBetweenTheSidesIsNoErrorAndIsNotCountedTwice) {
  for (const double aligns : {0, 1}) {
    axis(2, 62, aligns);
    compensation = 0.2;
    build();
    release();
    ASSERT_TRUE(move(0, 20));
    // Not aligned: the slave was at its place without compensation, and the drive knows no better.
    EXPECT_NEAR(error(), aligns == 1 ? 0.2 : 0, settled) << aligns;
    if (aligns == 0) continue;
    fastest = 0;
    emergency_stop();
    release();
    EXPECT_NEAR(error(), 0.2, settled) << "it stays where compensation wants it";
    EXPECT_LT(fastest, 1);
    ASSERT_TRUE(move(20, 20));
    EXPECT_NEAR(error(), 0.2, settled);
  }
}

TEST_F(Gantry, ASlaveThatIsTakenOffStaysWhileItsMasterIsJoggedAndIsCoupledWhereItIs) {
  build(100, 100.8);
  release();
  EXPECT_EQ(alarms(), Numbers{121});
  release(true);
  EXPECT_EQ(feedback.enabled, (std::vector<std::uint8_t>{1, 1, 3}));
  ASSERT_TRUE(move(100, 0.7, 10)) << "the way out of the alarm";
  EXPECT_NEAR(feedback.position[2], 100.8, 1e-4);
  EXPECT_NEAR(error(), 0.1, settled);
  release(false);
  EXPECT_EQ(feedback.enabled, (std::vector<std::uint8_t>{1, 1, 1}));
  ASSERT_TRUE(move(100.7, 20));
  EXPECT_NEAR(error(), 0.1, settled) << "coupled where it is; the alignment is that of the emergency stop";
  emergency_stop();
  release();
  EXPECT_NEAR(error(), 0, settled);
}

TEST_F(Gantry, ASlaveInMotionIsTakenOffAtTheNextRestOnly) {
  build(0, 0);
  release();
  ASSERT_TRUE(started());
  core->set_enables({1, 1, 3}, false);
  take();
  EXPECT_EQ(feedback.enabled[2], 1);
  request(StreamRequestKind::LEAVE);
  ASSERT_TRUE(move(0, 10));
  EXPECT_EQ(feedback.enabled[2], 3);
  EXPECT_NEAR(feedback.position[2], 0, 1e-4);
}

TEST_F(Gantry, AContinuedDriveDoesTheSameBits) {
  axis(2, 62, 0);
  build(100, 100.3);
  release();
  ASSERT_TRUE(move(100, 50, 1000, 160));
  const auto state = core->explicit_state();
  GantryMachine other;
  other.parameters = parameters;
  other.build();
  other.core->continue_from(state);
  for (auto* machine : {static_cast<GantryMachine*>(this), &other}) {
    machine->core->set_enables({1, 1, 1}, true);
    machine->run();
  }
  EXPECT_EQ(bus::text_of(core->explicit_state()), bus::text_of(other.core->explicit_state()));
}

// Encoders without a position of their own. The marks of both scales are 2 mm apart.
struct HomedGantry : testing::Test, GantryMachine {
  void encoders(truth::EncoderKind kind) {
    for (const char* const name : {"Y1", "Y2"}) {
      auto& encoder = truth[name].motor;
      encoder.kind = kind;
      encoder.mark_spacing = kind == truth::EncoderKind::incremental ? 10 : 20;
      encoder.first_mark = name[1] == '1' ? -2000 : -1998;
    }
    both(920, 1);
    beam = beam_of(20);
  }
  // Without control of the brakes nothing moves before; both sides stand square in the truth.
  double home() {
    double rack = 0;
    request(StreamRequestKind::HOME, 1);
    EXPECT_EQ(core->mode(), Mode::HOMING);
    const double before = core->commands()[2] - core->commands()[1];
    while (core->mode() == Mode::HOMING) {
      core->step();
      take();
      if (core->mode() == Mode::HOMING)
        rack = std::max(rack, std::abs(core->commands()[2] - core->commands()[1] - before));
      largest_current = std::max(largest_current, std::abs(feedback.torque[2] - feedback.torque[1]));
    }
    run();
    RecordProperty("racked_um", std::to_string(rack * 1e3));
    return rack;
  }
};

// The switches are at the reference coordinates 50 and 52 of the true machine, and both parameters say so.
TEST_F(HomedGantry, SwitchesTwoMillimetresApartAreFoundWithoutRacking) {
  encoders(truth::EncoderKind::incremental);
  axis(1, 12, 50), axis(2, 12, 52);
  build();
  release();
  EXPECT_FALSE(started());
  EXPECT_EQ(alarms(), Numbers{alarm::not_homed.number});
  EXPECT_LT(home(), 1e-9) << "mm: the commands of both sides do not move against each other";
  EXPECT_LT(largest_current, 0.02) << "nor do the drives work against each other";
  EXPECT_EQ(alarms(), Numbers{});
  // At 1 mm/s the edge is latched within 0.001 mm.
  EXPECT_NEAR(error(), 0, 0.003);
  EXPECT_TRUE(move(feedback.position[1], 10));
}

TEST_F(HomedGantry, IndexMarksTwoMillimetresApartShowTheMisalignmentOfTheirReferences) {
  encoders(truth::EncoderKind::incremental);
  both(922, 1), both(12, 50);
  build();
  release();
  EXPECT_LT(home(), 1e-9);
  // Behind the edges at 50 the master finds its mark at 50 or 60, the slave its own at 52: the one machine
  // position 50 for both says that the slave is 2 mm behind, or 8 mm ahead.
  EXPECT_TRUE(std::abs(error() + 2) < 0.003 || std::abs(error() - 8) < 0.003) << error();
  const double found = error();
  // The reference coordinate of the slave puts it right.
  axis(2, 12, 50 - found);
  build();
  release();
  EXPECT_LT(home(), 1e-9);
  EXPECT_NEAR(std::remainder(error(), 10), 0, 0.003);
}

TEST_F(HomedGantry, DistanceCodedScalesAreFoundAfterTwoMarksWithoutASwitch) {
  encoders(truth::EncoderKind::distance_coded);
  both(922, 2);
  build(-40, -40);
  release();
  EXPECT_LT(home(), 1e-9);
  EXPECT_LT(std::abs(feedback.position[1] + 40), 45) << "two gaps of about 10 mm and what braking takes";
  // The scale gives the true position; both stand square.
  EXPECT_NEAR(error(), 0, 0.001);
  EXPECT_TRUE(move(feedback.position[1], 10));
}

// Scales on the loads that count down, and parameters that say so (10a931).
TEST_F(HomedGantry, DistanceCodedScalesMountedTheWrongWayRoundGiveTheSamePlace) {
  for (const char* const name : {"Y1", "Y2"}) {
    auto& scale = truth[name].load.emplace();
    scale.kind = truth::EncoderKind::distance_coded;
    scale.first_mark = -2000, scale.inverted = true;
  }
  both(920, 1), both(922, 2), both(930, 1), both(931, 1);
  beam = beam_of(20);
  build(-100, -100);
  release();
  EXPECT_LT(home(), 1e-9);
  EXPECT_EQ(alarms(), Numbers{});
  for (const std::size_t side : {1u, 2u}) {
    EXPECT_GT(feedback.position[side], -100) << "it has moved upwards";
    EXPECT_LT(feedback.position[side], -100 + 45) << "two gaps of about 10 mm and what braking takes";
  }
  EXPECT_NEAR(error(), 0, 0.001);
}

TEST_F(HomedGantry, AnAbsoluteScaleOnTheLoadNeedsNoHoming) {
  for (const char* const name : {"Y1", "Y2"}) {
    truth[name].motor.kind = truth::EncoderKind::incremental;
    truth[name].load.emplace();
  }
  both(930, 1);
  build(7, 7);
  release();
  EXPECT_NEAR(feedback.position[1], 7, 1e-4);
  EXPECT_TRUE(move(7, 10));
}

TEST_F(HomedGantry, HomingTheSlaveHomesTheGantry) {
  encoders(truth::EncoderKind::incremental);
  both(12, 50);
  build();
  release();
  request(StreamRequestKind::HOME, 2);
  run();
  EXPECT_EQ(alarms(), Numbers{});
  EXPECT_TRUE(started());
}

TEST_F(HomedGantry, AMissingSwitchOfTheSlaveEndsTheSearchOfBoth) {
  encoders(truth::EncoderKind::incremental);
  axis(1, 12, 50), axis(2, 12, 5000);
  axis(1, 6, 100), axis(1, 7, -100);
  build();
  release();
  EXPECT_LT(home(), 1e-9);
  EXPECT_EQ(alarms(), Numbers{alarm::homing_failed.number});
  EXPECT_FALSE(started());
}

TEST_F(HomedGantry, SidesThatSearchInOppositeDirectionsAreRefused) {
  encoders(truth::EncoderKind::incremental);
  axis(2, 920, -1);
  build();
  release();
  request(StreamRequestKind::HOME, 1);
  EXPECT_EQ(core->mode(), Mode::FOLLOWING);
  take();
  EXPECT_EQ(alarms(), Numbers{alarm::homing_failed.number});
}

TEST_F(HomedGantry, ARestartLosesTheReferencesOfIncrementalEncodersAndASecondHomingFindsTheSame) {
  encoders(truth::EncoderKind::incremental);
  axis(1, 12, 50), axis(2, 12, 52);
  build();
  release();
  home();
  const double first = feedback.position[1];
  build(20, 20);
  release();
  EXPECT_FALSE(started());
  home();
  EXPECT_NEAR(feedback.position[1], first, 0.003);
  EXPECT_NEAR(error(), 0, 0.003);
}

}  // namespace
}  // namespace trunnion::drive
