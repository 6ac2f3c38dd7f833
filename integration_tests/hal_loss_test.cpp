// SPDX-License-Identifier: Apache-2.0
// A machine behind LinuxCNC's HAL that loses a process, its drives or HAL itself, and how HAL ends.
#include <pwd.h>

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

TEST_F(Hal, WhenRtapiAppWasKilledHalIsLoadedAgainAndTheMachineRunsAfterHoming) {
  up();
  home_all();
  start_long_move();
  if (kill(rtapi_pid(), SIGKILL) != 0) GTEST_SKIP() << "only root can end rtapi_app";
  await_new_hal("rtapi_app has ended");
  home_all();
  EXPECT_TRUE(cluster->until([&] { return cluster->channels[0].homed; })) << cluster->told();
  cluster->client().set_mode(0, Mode::MDI);
  cluster->client().mdi(0, "G53 G0 X5");
  EXPECT_TRUE(cluster->until([&] { return std::abs(cluster->channels[0].machine[0] - 5) < 0.005; }))
      << cluster->told();
}

TEST_F(Hal, WhenTheSessionWasKilledHalIsLoadedAgainAndNoAxisHasAReference) {
  up();
  home_all();
  start_long_move();
  const int killed = session_pid();
  ASSERT_EQ(kill(killed, SIGKILL), 0);
  await_new_hal("trunnion-hal-session has ended");
  EXPECT_NE(session_pid(), killed);
  home(0);
  await_refusal("Y, Z");
}

// The drive that gives its place away ends HAL.
TEST_F(Hal, AfterASwapOfTheDriveTheAxesMustBeHomedAgain) {
  up();
  home(0);
  const int before = session_pid();
  output_of(cluster::binary_directory() + "/trunnion swap drive --domain " +
            std::to_string(cluster->running().run.domain));
  await_refusal("X, Y, Z");
  EXPECT_NE(session_pid(), before);
}

// Somebody has stopped HAL's threads; the session is there still.
TEST_F(Hal, WhenTheServoThreadHasStoppedHalIsLoadedAgain) {
  make_encoders_absolute();
  up();
  const int drive = drive_pid();
  output_of("halcmd stop");
  EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(100, "servo thread has stopped"); }))
      << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return cluster->ready() && drive_pid() != drive; })) << cluster->told();
  cluster->reset_alarms();
  await_door(true);
  EXPECT_TRUE(cluster->until([] { return signal("drives-on") == 1; })) << cluster->told();
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

TEST_F(Hal, NothingIsLeftOfASessionThatWasKilledJustBeforeTheClusterGoesDown) {
  up();
  const auto directory_of_session = session();
  const auto group = std::to_string(session_pid());
  const auto components = output_of("pgrep -x trunnion-hal-io -g " + group);
  EXPECT_NE(components, "");
  kill(session_pid(), SIGKILL);
  cluster.reset();
  EXPECT_FALSE(fs::exists(directory_of_session));
  EXPECT_LT(shmget(hal_memory, 0, 0), 0) << "HAL is still there";
  const auto state = output_of("ps -o stat= -p " + components);
  EXPECT_TRUE(state.empty() || state[0] == 'Z') << "trunnion-hal-io is still there";
}

TEST_F(Hal, AHalOfSomebodyElseIsNamedAndLeftAlone) {
  const auto other = directory / "other";
  fs::create_directories(other);
  fs::permissions(other, fs::perms::all);
  const int user = geteuid() == 0 ? 65534 : static_cast<int>(geteuid());
  const auto theirs = "HAL_RTMOD_DIR=/usr/lib/linuxcnc/modules RTAPI_UID=" + std::to_string(user) +
                      " RTAPI_FIFO_PATH=" + (other / "socket").string() + " halcmd ";
  // The process that stays keeps what it writes to.
  output_of(theirs + "loadrt threads name1=their-thread period1=1000000 > /dev/null");
  output_of(theirs + "start");
  const auto why = refusal_of_up();
  const auto name = std::string(getpwuid(static_cast<uid_t>(user))->pw_name);
  EXPECT_NE(why.find(" (rtapi_app) of user " + name), std::string::npos) << why;
  const auto at = why.find("process ");
  ASSERT_NE(at, std::string::npos) << why;
  EXPECT_EQ(text_of("/proc/" + std::to_string(std::atoi(why.c_str() + at + 8)) + "/comm"), "rtapi_app\n");
  EXPECT_NE(output_of(theirs + "show thread").find("their-thread"), std::string::npos);
  output_of(theirs + "stop");
  output_of(theirs + "unloadrt all");
}

TEST_F(Hal, HalEndsWithTheLauncher) {
  cluster::UpOptions options;
  options.machine = directory.string();
  options.state_directory = "temporary";
  options.own_domain = true;
  options.virtual_time = false;
  options.with_gateway = false;
  const auto running = cluster::start_cluster(options);
  const auto directory_of_session = session_of(running.run.domain);
  EXPECT_TRUE(fs::exists(directory_of_session / "ready"));
  ASSERT_EQ(kill(*running.run.launcher(), SIGKILL), 0);
  for (int i = 0; i < 6000 && fs::exists(directory_of_session); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(fs::exists(directory_of_session));
  EXPECT_LT(shmget(hal_memory, 0, 0), 0) << "HAL is still there";
  running.run.remove();
}

TEST_F(Hal, AFaultyFileIsRefusedWithItsLine) {
  replace(directory / "machine.hal", "setp probe.in1 -56", "setp probe.in2 -56");
  const auto why = refusal_of_up();
  EXPECT_NE(why.find("machine.hal:"), std::string::npos) << why;
  EXPECT_NE(why.find("probe.in2"), std::string::npos) << why;
}

TEST_F(Hal, AServoThreadOfAnotherPeriodIsRefused) {
  replace(directory / "machine.hal", "period1=1000000", "period1=2000000");
  const auto why = refusal_of_up();
  // Of 0.2 s of a computer that may be late by some tens of milliseconds.
  const std::string words = "has a period of about ";
  const auto at = why.find(words);
  ASSERT_NE(at, std::string::npos) << why;
  EXPECT_NEAR(std::atof(why.c_str() + at + words.size()), 2.0, 0.5) << why;
  EXPECT_NE(why.find("parameter 000001 is 1.00 ms"), std::string::npos) << why;
}

TEST_F(Hal, AFifoThatIsMissingIsNamed) {
  replace(directory / "machine.hal", "depth=2048,2048 cfg=uffffffff,bbbbbbbbbb", "depth=2048 cfg=uffffffff");
  replace(directory / "machine.hal", "addf sampler.1 servo", "");
  replace(directory / "machine.hal", "net drives-on     => sampler.1.pin.0 sampler.1.pin.3 sampler.1.pin.6",
          "");
  auto text = text_of(directory / "machine.hal");
  for (auto at = text.find("sampler.1.pin."); at != std::string::npos; at = text.find("sampler.1.pin."))
    text.erase(at, text.find_first_of(" \n", at) - at);
  std::ofstream(directory / "machine.hal") << text;
  const auto why = refusal_of_up();
  EXPECT_NE(why.find("loads no sampler 1"), std::string::npos) << why;
}

TEST_F(Hal, AResetOfTheAlarmsResetsTheFaultsOfTheDrives) {
  make_encoders_absolute();
  std::ofstream(directory / "machine.hal", std::ios::app)
      << "loadrt flipflop\naddf flipflop.0 servo\nnet fault-reset => flipflop.0.set\n"
         "net reset-seen flipflop.0.out\n";
  up();
  EXPECT_EQ(signal("reset-seen"), 0);
  cluster->reset_alarms();
  EXPECT_TRUE(cluster->until([] { return signal("reset-seen") == 1; })) << cluster->told();
  EXPECT_TRUE(cluster->until([] { return signal("fault-reset") == 0; })) << "0.1 s later";
}

}  // namespace
}  // namespace trunnion::integration
