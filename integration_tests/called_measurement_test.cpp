// SPDX-License-Identifier: Apache-2.0
// A program that measures the kinematics by CYCLE9960, on the machine of examples/calibration: what it finds,
// what a fault leaves, and what a restart of the measuring process does.
#include "measurement_rig.hpp"

namespace trunnion::integration {
namespace {

// The sphere of truth.yaml is at X60 Y40 Z-360. The ball (6 mm) stands over its pole (25 mm) by the measuring
// path of 2 mm: Z -360 + 12.5 + 3 + 2 + 60 of the probe's length.
std::string program(const std::string& variant = "11400", const std::string& diameter = "25") {
  return "G21 G90 G94 G49 G54\nG53 G0 Z0\nG53 G0 X60 Y40 A0 C0\nG53 G1 Z-282.5 F3000\nCYCLE9960(" + variant +
         ",\"TOOL_CARR_KIN\",1," + diameter +
         ",0,-60,60,3,0,0,0,240,3,0,0.001,2,2,1,1,0,1)\nG53 G1 Z0 F3000\n#550=9960\nM30\n";
}

struct CalledMeasurement : ::testing::Test {
  MeasurementRig rig;

  void run(const std::string& text) {
    auto& client = rig.cluster->client();
    client.upload("measure.nc", text);
    client.set_mode(0, Mode::AUTO);
    client.select_program(0, "measure.nc");
    client.channel(0, CommandKind::CYCLE_START);
    ASSERT_TRUE(rig.until([&] { return rig.cluster->state() != RunState::IDLE; })) << rig.told();
  }
  // CYCLE9960 turns with the delivered feed of the rotary axes.
  bool ended() {
    return rig.until([&] { return rig.cluster->state() == RunState::IDLE; }, 180);
  }
};

TEST_F(CalledMeasurement, WritesTheVectorsOfTheDisplacedTableAndFindsThemAgain) {
  rig.start(MeasurementRig::good_probe);
  run(program());
  ASSERT_TRUE(ended()) << rig.told();
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::FINISHED && rig.changed(); })) << rig.told();
  EXPECT_TRUE(rig.state.written);
  EXPECT_EQ(rig.state.who, "program measure.nc line 5");
  EXPECT_EQ(rig.state.complete, MeasurementRig::poses);
  EXPECT_TRUE(rig.cluster->active_alarms().empty()) << rig.told();
  EXPECT_TRUE(rig.at_top()) << "the program has gone on behind the cycle";
  // As in measurement_faults_test.
  EXPECT_NEAR(rig.pending(40433), 0.21, 0.005);
  EXPECT_NEAR(rig.pending(40435), 0.05, 0.005);
  EXPECT_NEAR(rig.pending(40436), -0.09, 0.005);
  const auto first = rig.result();
  EXPECT_GT(first.largest_change, 0.1);

  // The second run: refused until the values are active, then nothing is left to correct.
  run(program());
  ASSERT_TRUE(ended());
  EXPECT_TRUE(rig.until([&] { return rig.cluster->has_alarm(158, "waits for a reset"); })) << rig.told();
  ASSERT_TRUE(rig.clear_machine()) << rig.told();
  ASSERT_TRUE(rig.until([&] { return rig.set.pending.empty(); })) << rig.told();
  run(program());
  ASSERT_TRUE(ended()) << rig.told();
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::FINISHED && rig.state.measurement == 2; }))
      << rig.told();
  EXPECT_LT(rig.result().largest_change, 0.003);
}

TEST_F(CalledMeasurement, EndsWithTheReasonWhenAnArgumentIsWrong) {
  rig.start(MeasurementRig::good_probe);
  run(program("11402"));
  ASSERT_TRUE(ended()) << rig.told();
  EXPECT_TRUE(rig.until(
      [&] {
        return rig.cluster->has_alarm(
            158, "measure.nc:5: CYCLE9960, argument 1 (S_MVAR): 11402: digit 2 of the ones");
      },
      5))
      << rig.told();
  EXPECT_FALSE(rig.changed());
  EXPECT_EQ(rig.state.phase, Phase::NOTHING);
}

TEST_F(CalledMeasurement, EndsWithAnAlarmWhenTheMeasuringProcessIsKilledAndIsMeasuredAgain) {
  rig.start(MeasurementRig::good_probe);
  run(program());
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::MEASURING && rig.state.complete >= 2; }))
      << rig.told();
  const auto reply = rig.measure();
  EXPECT_NE(reply.reason.find("a measurement is under way"), std::string::npos) << reply.reason;
  rig.kill("measurement");
  // Alarm 100 of the killed process holds the program in its part; when it goes on, it asks, and is refused.
  const auto refused = [&] { return rig.cluster->has_alarm(158, "the measurement process has ended"); };
  EXPECT_TRUE(rig.until(
      [&] {
        if (rig.cluster->state() == RunState::HELD) try {
            rig.cluster->reset_alarms();
            rig.cluster->client().channel(0, CommandKind::CYCLE_START);
          } catch (const std::exception&) {
          }
        return refused();
      },
      30))
      << rig.told();
  ASSERT_TRUE(ended()) << rig.told();
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::INTERRUPTED; })) << rig.told();
  EXPECT_FALSE(rig.changed());
  EXPECT_FALSE(rig.state.may_continue);
  EXPECT_NE(rig.order(Operation::CONTINUE).reason.find("start that program again"), std::string::npos);

  ASSERT_TRUE(rig.clear_machine()) << rig.told();
  run(program());
  ASSERT_TRUE(ended()) << rig.told();
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::FINISHED && rig.changed(); })) << rig.told();
  EXPECT_NEAR(rig.pending(40433), 0.21, 0.005);
}

TEST_F(CalledMeasurement, IsInterruptedByAResetAndByTheEndOfTheChannel) {
  rig.start(MeasurementRig::good_probe);
  run(program());
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::MEASURING; })) << rig.told();
  rig.cluster->client().channel(0, CommandKind::RESET);
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::INTERRUPTED; })) << rig.told();
  EXPECT_NE(rig.state.error.find("the program has ended"), std::string::npos) << rig.state.error;
  EXPECT_FALSE(rig.changed());

  ASSERT_TRUE(rig.clear_machine()) << rig.told();
  run(program());
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::MEASURING && rig.state.complete >= 1; }))
      << rig.told();
  rig.kill("channel");
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::INTERRUPTED; })) << rig.told();
  EXPECT_FALSE(rig.changed());
  // The program cannot be resumed behind the cycle. Once the start is accepted, another reset would clear the
  // alarm.
  bool started = false;
  ASSERT_EQ(rig.cluster->state(), RunState::INTERRUPTED) << rig.told();
  EXPECT_TRUE(rig.until(
      [&] {
        if (!started && rig.cluster->state() == RunState::INTERRUPTED) try {
            rig.cluster->reset_alarms();
            rig.cluster->client().channel(0, CommandKind::CYCLE_START);
            started = true;
          } catch (const std::exception&) {
          }
        return rig.cluster->has_alarm(1119, "cannot be resumed");
      },
      10))
      << rig.told();
  ASSERT_TRUE(rig.clear_machine()) << rig.told();
  run(program());
  ASSERT_TRUE(ended()) << rig.told();
  EXPECT_TRUE(rig.until([&] { return rig.state.phase == Phase::FINISHED; })) << rig.told();
}

TEST_F(CalledMeasurement, EndsWithTheAlarmOfATouchWithoutContact) {
  rig.start(std::string(MeasurementRig::good_probe) + ", no_signal_from_touch: 31");
  run(program());
  ASSERT_TRUE(ended()) << rig.told();
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::INTERRUPTED; })) << rig.told();
  EXPECT_TRUE(rig.cluster->has_alarm(1501, "no contact")) << rig.told();
  EXPECT_NE(rig.state.error.find("alarm 1501"), std::string::npos) << rig.state.error;
  EXPECT_FALSE(rig.changed());
}

TEST_F(CalledMeasurement, AnEmergencyStopWritesNothing) {
  rig.start(MeasurementRig::good_probe);
  run(program());
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::MEASURING && rig.state.complete >= 1; }))
      << rig.told();
  rig.cluster->client().panel(idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP);
  ASSERT_TRUE(rig.until([&] { return rig.state.phase == Phase::INTERRUPTED; })) << rig.told();
  EXPECT_NE(rig.state.error.find("mergency stop"), std::string::npos) << rig.state.error;
  EXPECT_FALSE(rig.changed());
  ASSERT_TRUE(rig.clear_machine()) << rig.told();
}

}  // namespace
}  // namespace trunnion::integration
