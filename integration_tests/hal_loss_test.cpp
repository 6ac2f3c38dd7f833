// SPDX-License-Identifier: Apache-2.0
// A machine behind LinuxCNC's HAL that loses a process, its drives or HAL itself, and how HAL ends.
#include "hal_fixture.hpp"

namespace trunnion::integration {
namespace {

TEST_F(Hal, AKilledDriveLeavesTheAxesBrakedAndSwitchedOffByHal) {
  up();
  home_all();
  start_long_move();
  EXPECT_EQ(signal("drives-on"), 1);
  const int launcher = *cluster->running().run.launcher();
  kill(launcher, SIGSTOP);  // nobody starts the drive again meanwhile
  const double at = signal("x-position");
  kill(drive_pid(), SIGKILL);
  const double rest = rest_of_x();
  // 200 rows in the queue at 0.1 mm, what it takes to start halcmd, and braking: far from the end of the
  // move.
  EXPECT_LT(rest - at, 70);
  EXPECT_EQ(signal("drives-on"), 0);
  EXPECT_TRUE(cluster->until([] { return signal("amplifiers-on") == 0; })) << "0.3 s later";
  EXPECT_EQ(signal("x-speed"), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(signal("x-position"), rest) << "it stays at rest";
  cluster->drain();
  cluster->feedback.mode = DriveMode::OFF;  // what the killed process has told is old
  kill(launcher, SIGCONT);
  // The next process finds the axes where they are, still homed, and the program can be gone on with.
  EXPECT_TRUE(
      cluster->until([&] { return cluster->feedback.mode == DriveMode::FOLLOWING && cluster->ready(); }, 30))
      << cluster->told();
  EXPECT_NEAR(signal("x-position"), rest, 1e-6) << "switching on moves nothing";
  EXPECT_NEAR(cluster->feedback.position[0] - rest, -2, 0.005) << "the reference is the old one";
  EXPECT_TRUE(cluster->go_on()) << cluster->told();
  EXPECT_TRUE(cluster->finish()) << cluster->told();
}

TEST_F(Hal, RowsThatAreMissingAreCountedAndTheAxesStopAtTheNewestOne) {
  replace(directory / "machine.hal", "setp watchdog.timeout-0 0.05", "setp watchdog.timeout-0 5");
  make_encoders_absolute();
  up();
  const auto starved = cluster->feedback.starved;
  start_long_move();
  const int pid = drive_pid();
  kill(pid, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(900));
  const double rest = rest_of_x();
  kill(pid, SIGCONT);
  // At least 0.9 s less the queue of 0.2 s, and what this process itself was slow.
  EXPECT_TRUE(cluster->until([&] { return cluster->feedback.starved > starved + 400; })) << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(110, "without setpoints"); }))
      << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return cluster->state() == RunState::INTERRUPTED; })) << cluster->told();
  EXPECT_NEAR(rest_of_x(), rest, 1.0) << "it holds where it has stopped";
  EXPECT_TRUE(cluster->go_on()) << cluster->told();
  EXPECT_TRUE(cluster->finish()) << cluster->told();
}

TEST_F(Hal, AFaultOfADriveSwitchesAllOffAndIsNamed) {
  make_encoders_absolute();
  up();
  start_long_move();
  output_of("halcmd sets x-fault 1");
  EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(114, "axis X"); })) << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::OFF; })) << cluster->told();
  rest_of_x();
  EXPECT_TRUE(cluster->until([] { return signal("enable") == 0; })) << "behind the rows in the queue";
  EXPECT_TRUE(cluster->until([] { return signal("amplifiers-on") == 0; })) << "0.3 s later";
  output_of("halcmd sets x-fault 0");
  cluster->until([] { return false; }, 0.3);
  EXPECT_EQ(cluster->feedback.mode, DriveMode::OFF) << "until the alarms are reset";
  cluster->client().channel(0, CommandKind::RESET);
  cluster->reset_alarms();
  EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::FOLLOWING; }))
      << cluster->told();
}

TEST_F(Hal, AnOpenEmergencyStopChainIsToldAgainAfterEachReset) {
  make_encoders_absolute();
  up();
  output_of("halcmd sets chain-closed 0");
  EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(114, "switched the drives off"); }))
      << cluster->told();
  for (int i = 0; i < 2; ++i) {
    cluster->reset_alarms();
    EXPECT_TRUE(cluster->until([&] { return !cluster->has_alarm(114); })) << cluster->told();
    EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(114, "not on 2 s after their enable"); }))
        << cluster->told();
  }
  EXPECT_EQ(cluster->feedback.mode, DriveMode::OFF);
  output_of("halcmd sets chain-closed 1");
  cluster->reset_alarms();
  EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::FOLLOWING; }))
      << cluster->told();
}

// The signal of the encoder keeps its last value, and the control of HAL drives the motor ever faster behind
// its setpoints.
TEST_F(Hal, AnAxisWhoseEncoderIsLostIsSwitchedOffAndBrakedByHal) {
  make_encoders_absolute();
  up();
  start_long_move();
  output_of("halcmd unlinkp encoder.x.out");
  EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(119, "Axis X does not follow"); }))
      << cluster->told();
  EXPECT_TRUE(cluster->until([] { return signal("enable") == 0 && signal("drives-on") == 0; }));
  EXPECT_TRUE(cluster->until([] { return signal("x-speed") == 0; }));
  EXPECT_EQ(cluster->feedback.mode, DriveMode::OFF);
  EXPECT_TRUE(cluster->until([&] { return cluster->channels[0].needs_reset; })) << cluster->told();
}

TEST_F(Hal, NothingIsLeftWhenTheClusterIsDown) {
  up();
  const auto directory_of_session = session();
  EXPECT_TRUE(fs::exists(directory_of_session / "ready"));
  EXPECT_GE(shmget(hal_memory, 0, 0), 0);
  cluster.reset();
  EXPECT_FALSE(fs::exists(directory_of_session));
  EXPECT_LT(shmget(hal_memory, 0, 0), 0) << "HAL is still there";
}

TEST_F(Hal, AFaultyFileIsRefusedWithItsLine) {
  replace(directory / "machine.hal", "setp probe.in1 -56", "setp probe.in2 -56");
  const auto why = refusal_of_up();
  EXPECT_NE(why.find("machine.hal:"), std::string::npos) << why;
  EXPECT_NE(why.find("probe.in2"), std::string::npos) << why;
}

}  // namespace
}  // namespace trunnion::integration
