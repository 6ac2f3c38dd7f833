// SPDX-License-Identifier: Apache-2.0
// The simulated gantry: beam between the sides, torque follow, compensation of the synchronization error,
// alarms of the drives.
#include "bus/json.hpp"
#include "gantry_bench.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::drive {
namespace {

using Numbers = std::vector<std::uint32_t>;

struct Beam : testing::Test, GantryMachine {};

// 1 m/s, 10 m/s2; the beam is square where the slave is 0.3 mm behind its place.
TEST_F(Beam, AtOneMetrePerSecondTheSynchronizationErrorStaysWithinItsLimit) {
  const double limit = 0.1;  // mm, 10a107
  beam = beam_of(20, 0.3);
  axis(2, 62, 1), axis(2, 107, limit);
  axis(2, 906, 2.5);  // the heavier side
  build(0, 0.09);
  release();
  ASSERT_TRUE(move(0, 900));
  ASSERT_TRUE(move(900, -900));
  EXPECT_EQ(alarms(), Numbers{});
  EXPECT_GT(fastest, 990);
  EXPECT_LT(largest, limit);
  RecordProperty("synchronization_error_um", std::to_string(largest * 1e3));
  EXPECT_NEAR(feedback.position[1], 0, settled);
}

// J = 1, k = (2 pi 20)^2 = 15791 1/s2; 0.3 mm give 4737 mm/s2; rated torque 1.5 * 10000 mm/s2: 0.3158.
TEST_F(Beam, AtRestTheDrivesHoldTheForceOfTheBeam) {
  beam = beam_of(20, 0.3);
  both(907, 0);
  build();
  release();
  ASSERT_TRUE(move(0, 20, 100));
  const double force = std::pow(2 * std::numbers::pi * 20, 2) * 0.3 / 15000;
  EXPECT_NEAR(feedback.torque[1], -force, 0.01 * force);
  EXPECT_NEAR(feedback.torque[2], force, 0.01 * force);
}

TEST_F(Beam, WithoutForceBetweenTheSidesAndWithoutFunctionsTheDrivesGiveTheSameBitsAsSingleAxes) {
  build();
  release();
  ASSERT_TRUE(move(0, 50));
  GantryMachine other;
  other.set(10050, 0);  // no gantry
  other.build();
  other.release();
  ASSERT_TRUE(other.move(0, 50));
  EXPECT_EQ(feedback.position, other.feedback.position);
  EXPECT_EQ(feedback.torque, other.feedback.torque);
}

// The difference of the position errors of both sides is the commanded distance less the actual one. With
// equal servos the slow part of it is proportional to 1 / (Kv + PB66 / 100).
double error_with(double coefficient) {
  GantryMachine m;
  m.both(942, 1), m.axis(2, 942, 11);
  m.both(943, 1);
  m.axis(2, 944, coefficient);
  m.both(900, 57.14), m.both(902, 0), m.both(905, 1);  // without the integral: the error is in proportion
  m.axis(2, 907, 0.0343), m.axis(1, 907, 0);
  m.axis(2, 36, 10000);
  m.build();
  m.release();
  EXPECT_TRUE(m.move(0, 200, 500));
  EXPECT_TRUE(m.move(200, -200, 500)) << "and the reverse direction";
  return m.largest;
}

TEST_F(Beam, TheCompensationReducesTheErrorFrom15To8) {
  // Kv 57.14 1/s, PB66 5000 is 50 1/s: (57.14 + 50) / 57.14 = 15 / 8.
  const double off = error_with(0), on = error_with(5000);
  // Friction 0.0343 * 15000 mm/s2 / (Kp 600 1/s * Kv 57.14 1/s) = 15.0 um.
  EXPECT_NEAR(off, 0.015, 0.0005);
  EXPECT_NEAR(on, 0.008, 0.0005);
  EXPECT_NEAR(on / off, 8.0 / 15, 0.05 * 8 / 15);
  EXPECT_LT(error_with(10000), on);
  RecordProperty("without_um", std::to_string(off * 1e3));
  RecordProperty("with_um", std::to_string(on * 1e3));
}

TEST_F(Beam, TheCompensationNeedsBothDrivesAndTheSlaveOfThem) {
  const double off = error_with(0);
  const auto with = [&](double master, double slave, double functions) {
    GantryMachine m;
    m.axis(1, 942, master), m.axis(2, 942, slave);
    m.axis(1, 943, functions), m.axis(2, 943, 1);
    m.axis(2, 944, 5000);
    m.both(900, 57.14), m.both(902, 0);
    m.axis(2, 907, 0.0343), m.axis(1, 907, 0);
    m.build();
    m.release();
    EXPECT_TRUE(m.move(0, 200, 500));
    EXPECT_TRUE(m.move(200, -200, 500));
    return m.largest;
  };
  EXPECT_EQ(with(0, 11, 1), off) << "PB64 of the master off";
  EXPECT_EQ(with(1, 1, 1), off) << "no slave";
  EXPECT_EQ(with(1, 11, 0), off) << "PB65 of the master off";
  EXPECT_LT(with(1, 11, 1), 0.6 * off);
}

// Without the integral friction makes the slave lag, and the compensation of a period begins with that lag.
TEST_F(Beam, ACompensatedGantryThatIsContinuedInMotionDoesTheSameBits) {
  axis(1, 942, 1), axis(2, 942, 11);
  both(943, 1), axis(2, 944, 5000);
  both(900, 57.14), both(902, 0);
  axis(2, 907, 0.0343), axis(1, 907, 0);
  build();
  release();
  ASSERT_TRUE(move(0, 200, 500, 160));
  const auto state = core->explicit_state();
  ASSERT_NE(state.at("hardware").at("servos").at(2).at("position_error").get<double>(), 0);
  GantryMachine other;
  other.parameters = parameters;
  other.build();
  other.core->continue_from(state);
  for (auto* machine : {static_cast<GantryMachine*>(this), &other})
    for (int i = 0; i < 20 && machine->core->can_step(true); ++i) {
      machine->core->step();
      machine->take();
    }
  EXPECT_EQ(bus::text_of(core->explicit_state()), bus::text_of(other.core->explicit_state()));
}

TEST_F(Beam, InTorqueFollowBothSidesHaveTheSameTorqueAndNoneRacksTheOther) {
  const auto work = [&](double slave_word) {
    GantryMachine m;
    m.beam = beam_of(50, 0.1);
    m.both(907, 0.01);
    m.axis(1, 942, 1), m.axis(2, 942, slave_word);
    m.axis(2, 37, 0.5);
    m.build();
    m.release();
    EXPECT_TRUE(m.move(0, 300, 500));
    EXPECT_EQ(m.alarms(), Numbers{});
    return std::pair(std::abs(m.feedback.torque[2] - m.feedback.torque[1]), m.error());
  };
  // Speed follow: k = (2 pi 50)^2 * 0.1 mm / 15000 mm/s2 = 0.658 of the rated torque on each side.
  EXPECT_NEAR(work(11).first, 2 * 0.658, 0.05);
  const auto [difference, error] = work(111);
  EXPECT_LT(difference, 0.02);
  EXPECT_NEAR(error, -0.1, 0.01) << "mm: the slave gives way until the beam is square";
}

TEST_F(Beam, AMirroredSlaveInTorqueFollowNeedsTheInvertedTorque) {
  const auto follows = [&](double word, double travel_per_revolution = 10000) {
    GantryMachine m;
    m.beam = beam_of(50);
    m.axis(2, 127, 1), m.axis(2, 4, travel_per_revolution);
    m.axis(1, 942, 1), m.axis(2, 942, word);
    m.build();
    m.release();
    if (!m.started()) return false;
    // The batches of move() have no mirrored slave: the servos alone, by a push of the master.
    m.request(idl::stream::StreamRequestKind::LEAVE);
    const auto hardware = std::make_unique<SimulatedHardware>(m.truth, std::nullopt, m.beam);
    hardware->configure(m.parameters, machine::drive_axes(m.parameters), {}, 0.001);
    SetpointRow row;
    row.enable = row.controlled = true;
    row.axes.resize(3);
    struct None : EncoderRowSink {
      void skip_edge(std::uint64_t, const idl::stream::SkipEdge&) override {}
      void encoder_row(const EncoderRow&) override {}
    } none;
    DriveStatus status;
    double y = 0, worst = 0;
    for (int i = 0; i < 300; ++i) {
      const double before = y;
      y = 0.5e-3 * i * i / 2;  // 500 mm/s2
      ++row.number;
      row.axes[1] = {y, (y - before) * 1000, 500};
      row.axes[2] = {-y, (before - y) * 1000, -500};
      hardware->exchange(row, status, none);
      worst = std::max(worst, std::abs(status.axes[2].position + y));
    }
    return worst < 1;
  };
  EXPECT_TRUE(follows(10111));
  EXPECT_FALSE(follows(111)) << "the sides push against each other";
  EXPECT_TRUE(follows(111, -10000)) << "its motor turns the other way already";
  EXPECT_FALSE(follows(10111, -10000));
}

// Y1 reports an alarm at 300 mm at 1 m/s.
struct Faults : testing::Test, GantryMachine {
  double stop_at(truth::DriveFaultKind kind, double word, double stop) {
    truth["Y1"].fault = {kind, 300};
    both(943, word), both(941, stop);
    both(907, 0.05), both(908, 0);
    beam = beam_of(5);
    build();
    release();
    EXPECT_TRUE(started());
    move(0, 900);
    run();
    RecordProperty("racked_um", std::to_string(racked * 1e3));
    return racked;  // on the way and at rest
  }
};

TEST_F(Faults, AtAGeneralAlarmBothSidesBrakeTogetherAndThePartnerShows483) {
  EXPECT_LT(stop_at(truth::DriveFaultKind::overload, 10, 10), 0.2);
  EXPECT_EQ(core->mode(), Mode::OFF);
  // From 1 m/s with the rated 15000 mm/s2: 33 mm.
  EXPECT_NEAR(feedback.position[1], 300 + 33, 8);
  const auto found = events;
  ASSERT_GE(found.size(), 2u);
  EXPECT_EQ(found[0].alarm->number, alarm::drive_fault.number);
  EXPECT_EQ(found[0].part, 1u);
  EXPECT_NE(found[0].text.find("overload"), std::string::npos) << found[0].text;
  EXPECT_EQ(found[1].alarm->number, 483u);
  EXPECT_EQ(found[1].part, 2u);
}

TEST_F(Faults, WithPB45ZeroBothSidesCoast) {
  EXPECT_LT(stop_at(truth::DriveFaultKind::overload, 10, 0), 0.5);
  // Friction 0.05 * 15000 mm/s2 = 750 mm/s2: 667 mm from 1 m/s.
  EXPECT_NEAR(feedback.position[1], 300 + 667, 30);
  EXPECT_NEAR(feedback.position[2], 300 + 667, 30);
}

TEST_F(Faults, AtAnEmergencyAlarmBothSidesCoastWhateverPB45Says) {
  EXPECT_LT(stop_at(truth::DriveFaultKind::overcurrent, 10, 10), 0.5);
  EXPECT_NEAR(feedback.position[1], 300 + 667, 30);
  EXPECT_NEAR(feedback.position[2], 300 + 667, 30);
}

TEST_F(Faults, WithoutTheCommonStopTheSidesStopDifferentlyAndRackTheBeam) {
  EXPECT_GT(stop_at(truth::DriveFaultKind::overcurrent, 0, 10), 5) << "one coasts while the other brakes";
  for (const auto& event : events) EXPECT_NE(event.alarm->number, 483u);
}

TEST_F(Faults, NothingMovesUntilTheAlarmIsResetAndThenTheGantryIsAligned) {
  axis(2, 62, 1);
  stop_at(truth::DriveFaultKind::overload, 10, 10);
  events.clear();
  EXPECT_FALSE(move(feedback.position[1], 10)) << "the drives are off";
  core->acknowledge();
  release();
  EXPECT_NEAR(error(), 0, 1e-3);
  EXPECT_TRUE(move(feedback.position[1], 10));
  EXPECT_EQ(core->mode(), Mode::FOLLOWING);
}

TEST_F(Faults, AContinuedDriveStopsInTheSameBits) {
  truth["Y1"].fault = {truth::DriveFaultKind::overcurrent, 300};
  both(943, 10), both(907, 0.05);
  beam = beam_of(5);
  build();
  release();
  ASSERT_TRUE(started());
  move(0, 900);
  GantryMachine second;
  second.parameters = parameters, second.truth = truth, second.beam = beam;
  second.build();
  second.release();
  ASSERT_TRUE(second.started());
  second.move(0, 900);
  EXPECT_EQ(bus::text_of(core->explicit_state()), bus::text_of(second.core->explicit_state()))
      << "a second run";
}

}  // namespace
}  // namespace trunnion::drive
