// SPDX-License-Identifier: Apache-2.0
// A machine behind LinuxCNC's HAL: a real, headless HAL with its own simulated axes and switches. What HAL
// does is also looked at from outside, with LinuxCNC's program halcmd.
#include <sched.h>
#include <sys/shm.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "cluster_harness.hpp"

namespace trunnion::integration {
namespace {
namespace fs = std::filesystem;

constexpr int hal_memory = 0x48414c32;  // key of HAL's shared memory
using idl::stream::DriveMode;

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void replace(const fs::path& path, const std::string& from, const std::string& to) {
  auto text = text_of(path);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << path << " has no '" << from << "'";
  std::ofstream(path) << text.replace(at, from.size(), to);
}

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  char buffer[256];
  while (pipe != nullptr && fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
  if (pipe != nullptr) pclose(pipe);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

double signal(const std::string& name) {
  const auto text = output_of("halcmd gets " + name);
  if (text.empty()) ADD_FAILURE() << "HAL has no signal " << name;
  return text == "TRUE" ? 1 : text == "FALSE" ? 0 : std::atof(text.c_str());
}

/// A copy of hal-sim-xyz whose queue and lead cover the stalls of a computer that runs other tests. One HAL
/// can run on a computer; with a namespace of its own, which root can have, this test does not meet another
/// one.
struct Hal : ::testing::Test {
  void SetUp() override {
    if (geteuid() == 0) {
      ASSERT_EQ(unshare(CLONE_NEWIPC), 0) << std::strerror(errno);
    }
    // Another user's or worktree's test may have HAL.
    for (int i = 0; i < 600 && shmget(hal_memory, 0, 0) >= 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    directory = fs::temp_directory_path() / ("trunnion-hal-test-" + std::to_string(getpid()));
    fs::remove_all(directory);
    fs::copy(TRUNNION_HAL_MACHINE, directory, fs::copy_options::recursive);
    replace(directory / "machine.yaml", "queue: 32", "queue: 200");
    replace(directory / "parameters.yaml", "\"000900\": 160", "\"000900\": 500");
    const auto port =
        std::to_string(20000 + getpid() % 10000);  // of the Modbus server that trunnion-hal-io asks
    replace(directory / "plc" / "modbus.yaml", "1502", port);
    replace(directory / "io.yaml", "1502", port);
    // A stalled computer is no lost connection: 0.5 s otherwise.
    replace(directory / "plc" / "modbus.yaml", "timeout_ms: 500", "timeout_ms: 5000");
  }
  void TearDown() override {
    cluster.reset();
    fs::remove_all(directory);
  }

  void up() {
    cluster.emplace(directory.string(), Time::real);
    EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::FOLLOWING; }))
        << cluster->told();
    await_door(true);
  }
  /// Until the PLC has the input of the door, X24.2: an open one inhibits starts and jog.
  void await_door(bool closed) {
    auto images = cluster->client().bus().reader(topics::plc_image);
    idl::plc::Image image;
    EXPECT_TRUE(cluster->until([&] {
      while (images.take(image)) continue;
      return image.x.size() > 24 && (image.x[24] >> 2 & 1) == (closed ? 1 : 0);
    })) << cluster->told();
    EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(136) != closed; })) << cluster->told();
  }
  void begin_homing(std::uint8_t axis) {
    cluster->client().set_mode(0, Mode::REF);
    cluster::ChannelRequest request;
    request.command = CommandKind::REFERENCE_AXIS;
    request.axis = axis;
    cluster->client().channel(request);
    EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::HOMING; }))
        << cluster->told();
  }
  void home(std::uint8_t axis) {
    begin_homing(axis);
    EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::FOLLOWING; }, 60))
        << cluster->told();
  }
  /// Before up(): HAL's positions are those of the machine, and no axis has to search a switch, which takes 6
  /// s each.
  void make_encoders_absolute() {
    for (const char* axis : {"100", "101", "102"})
      replace(directory / "parameters.yaml", "\"" + std::string(axis) + "920\": 1",
              "\"" + std::string(axis) + "920\": 0");
    replace(directory / "machine.hal", "setp probe.in1 -56", "setp probe.in1 -60");
  }
  void home_all() {
    for (std::uint8_t axis = 0; axis < 3; ++axis) home(axis);
  }
  /// A long way in X at 100 mm/s.
  void start_long_move() {
    cluster->start_text("G90 G53 G0 X-100\nG1 X150 F6000\nX-100\nX150\nM30\n");
    EXPECT_TRUE(cluster->until([&] { return cluster->feedback.position[0] < -95; })) << cluster->told();
    EXPECT_TRUE(cluster->until([&] { return cluster->feedback.position[0] > -60; })) << cluster->told();
  }
  int drive_pid() {
    cluster->until(
        [&] { return cluster->service("drive") != nullptr && cluster->service("drive")->pid != 0; });
    return cluster->service("drive")->pid;
  }
  /// Waits until HAL's axis X is at rest, and says where.
  static double rest_of_x() {
    double before = signal("x-position");
    for (int i = 0, calm = 0; i < 400 && calm < 10; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const double now = signal("x-position");
      calm = std::abs(now - before) < 1e-6 ? calm + 1 : 0;
      before = now;
    }
    return before;
  }

  fs::path directory;
  std::optional<Cluster> cluster;
};

TEST_F(Hal, AxesWithoutAReferenceRefuseToMoveAndFindItAtTheirSwitches) {
  up();
  cluster->client().set_mode(0, Mode::MDI);
  cluster->client().mdi(0, "G53 G0 X5");
  EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(115, "X, Y, Z"); })) << cluster->told();
  cluster->client().channel(0, CommandKind::RESET);
  cluster->reset_alarms();
  home_all();
  // HAL has the switches at 12, 9 and 6; the machine positions of them are 10, 8 and 2. The edge is taken at
  // 1 mm/s, in a period of 1 ms; behind it an axis brakes from that speed.
  const double shift[] = {10 - 12, 8 - 9, 2 - 6};
  const char* names[] = {"x-position", "y-position", "z-position"};
  cluster->until([] { return false; }, 0.5);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(cluster->feedback.position[i] - signal(names[i]), shift[i], 0.005) << names[i];
  EXPECT_TRUE(cluster->until([&] { return cluster->active_alarms().empty(); })) << cluster->told();
}

TEST_F(Hal, AProgramIsExecutedAndTheSampledPositionsAreTheCommandedOnes) {
  make_encoders_absolute();
  up();
  const double shift = cluster->feedback.position[0] - signal("x-position");
  double most = 0;
  std::size_t rows = 0;
  std::vector<double> commanded(3), before(3);
  cluster->on_frame = [&](const idl::stream::FeedbackFrame& frame) {
    for (std::uint32_t i = 0; i < frame.count; ++i, ++rows) {
      before = commanded;
      commanded.assign(frame.commanded.begin() + i * 3, frame.commanded.begin() + (i + 1) * 3);
      // An encoder row is of the moment at which the setpoint comes into force: the setpoint before it was
      // reached.
      for (std::size_t a = 0; a < 3 && rows > 0; ++a)
        most = std::max(most, std::abs(frame.actual[i * 3 + a] - before[a]));
    }
  };
  cluster->start("square.nc");
  ASSERT_TRUE(cluster->finish()) << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return rows > 3000; }, 5)) << rows;
  cluster->until([] { return false; }, 0.5);
  // The position loop with Kv 50 1/s and full feed-forward has no error in steady motion; in a change of
  // acceleration of 1500 mm/s2 within 20 ms it is some micrometres, and 0.05 mm leave room for that.
  EXPECT_LT(most, 0.05);
  EXPECT_GT(most, 0) << "simulated axes are not copies of the setpoints";
  EXPECT_EQ(cluster->lost_frames, 0u);
  // G54 X10 Y20 Z-100 and the tool of 50: X0 Y0 Z20 is there.
  EXPECT_NEAR(commanded[0], 10, 1e-6);
  EXPECT_NEAR(commanded[1], 20, 1e-6);
  EXPECT_NEAR(commanded[2], -100 + 20 + 50, 1e-6);
  EXPECT_NEAR(signal("x-position") + shift, 10, 0.005);
  EXPECT_EQ(cluster->active_alarms(), "");
}

// The switch of X, at 12 mm, does not come. The axis searches it at 20 mm/s, so 10 mm are far from the
// longest travel of 1.1 * 400 mm; the search ends the queue and v2 / 2a later.
TEST_F(Hal, ADeadHomeSwitchIsSearchedUntilAHoldAResetAModeOrAnOverrideOfZeroStopsTheAxis) {
  replace(directory / "machine.hal", "setp home.x.home-pos 12", "setp home.x.home-pos 10000");
  up();
  const auto moved = [&](double from) {
    EXPECT_TRUE(cluster->until([&] { return cluster->feedback.position[0] > from + 10; })) << cluster->told();
    EXPECT_EQ(cluster->state(), RunState::RUNNING) << cluster->told();
  };
  const auto rests = [&] {
    EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::FOLLOWING; }))
        << cluster->told();
    return rest_of_x();
  };
  const auto stop_by = [&](CommandKind command) { cluster->client().channel(0, command); };
  const std::vector<std::function<void()>> stops = {[&] { stop_by(CommandKind::FEED_HOLD); },
                                                    [&] { stop_by(CommandKind::RESET); },
                                                    [&] { cluster->client().set_mode(0, Mode::JOG); }};
  for (const auto& stop : stops) {
    const double from = signal("x-position");
    begin_homing(0);
    moved(from);
    stop();
    const double rest = rests();
    EXPECT_TRUE(cluster->until([&] { return cluster->state() == RunState::IDLE; })) << cluster->told();
    EXPECT_EQ(rest_of_x(), rest);
  }
  const auto feed_override = [&](double fraction) {
    cluster->client().channel({.command = CommandKind::FEED_OVERRIDE, .fraction = fraction});
  };
  begin_homing(0);
  feed_override(0);
  const double rest = rests();
  EXPECT_EQ(cluster->state(), RunState::RUNNING);
  feed_override(1);
  moved(rest);
  stop_by(CommandKind::FEED_HOLD);
  rests();
  EXPECT_EQ(cluster->active_alarms(), "");
  cluster->client().set_mode(0, Mode::MDI);
  cluster->client().mdi(0, "G53 G0 X5");
  EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(115, "X, Y, Z"); })) << cluster->told();
}

// Limits of -20 and 20 mm: the longest travel is 44 mm.
TEST_F(Hal, ADeadHomeSwitchIsAnAlarmBehindTheLongestTravel) {
  replace(directory / "machine.hal", "setp home.x.home-pos 12", "setp home.x.home-pos 10000");
  replace(directory / "parameters.yaml", "\"100006\": 200", "\"100006\": 20");
  replace(directory / "parameters.yaml", "\"100007\": -200", "\"100007\": -20");
  up();
  begin_homing(0);
  EXPECT_TRUE(cluster->until([&] { return cluster->feedback.mode == DriveMode::FOLLOWING; }))
      << cluster->told();
  // 20 mm/s and 1500 mm/s2: braking takes 0.13 mm, a period 0.02 mm.
  EXPECT_NEAR(rest_of_x(), 44 + 0.133, 0.05);
  EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(116, "home switch within 44 mm"); }))
      << cluster->told();
}

TEST_F(Hal, AProbeEndsAMoveAndItsPositionIsLatched) {
  make_encoders_absolute();
  up();
  std::vector<idl::stream::SkipEdge> edges;
  cluster->on_frame = [&](const idl::stream::FeedbackFrame& frame) {
    edges.insert(edges.end(), frame.skips.begin(), frame.skips.end());
  };
  // The probe is at machine position -60; G54 has Z -100, no tool length.
  cluster->start_text("G90 G54 G49\nG0 Z50\nG31 L1 Z0 F600\nM30\n");
  ASSERT_TRUE(cluster->finish()) << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return !edges.empty(); }, 5));
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].input, 1);
  // 10 mm/s: latched within a period, 0.01 mm.
  EXPECT_NEAR(edges[0].position[2], -60, 0.02);
  EXPECT_GT(cluster->feedback.position[2], -75) << "braked the lead behind it";
  EXPECT_EQ(cluster->active_alarms(), "");
}

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

TEST_F(Hal, InputsAndOutputsOfThePlcAreItsPinsAndOutputsEndWithThePlc) {
  make_encoders_absolute();
  up();
  const auto one_line = [&](const char* line) {
    cluster->client().set_mode(0, Mode::MDI);
    cluster->client().mdi(0, line);
    cluster->until([&] { return cluster->state() != RunState::IDLE; }, 1);
    EXPECT_TRUE(cluster->until([&] { return cluster->state() == RunState::IDLE; }, 20))
        << line << ": " << cluster->told();
  };
  one_line("M8");
  EXPECT_TRUE(cluster->until([] { return signal("coolant-flood") == 1; }, 2));
  // M6: the drawbar takes 0.2 s to release and 0.2 s to clamp, as HAL has it.
  bool released = false;
  cluster->client().mdi(0, "T1 M6");
  EXPECT_TRUE(cluster->until([&] { return released = released || signal("tool-released") == 1; }, 5));
  EXPECT_TRUE(cluster->until([&] { return cluster->state() == RunState::IDLE; }, 10)) << cluster->told();
  EXPECT_EQ(signal("tool-clamped"), 1);
  EXPECT_EQ(cluster->active_alarms(), "");

  // A PLC that does not answer: its outputs are 0 after 0.3 s.
  const int plc = cluster->service("plc")->pid;
  kill(plc, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  EXPECT_EQ(signal("coolant-flood"), 0);
  kill(plc, SIGCONT);
  EXPECT_TRUE(cluster->until([] { return signal("coolant-flood") == 1; }, 5));

  // A killed one: the next takes the connection again.
  kill(plc, SIGKILL);
  EXPECT_TRUE(cluster->until(
      [&] { return cluster->service("plc") != nullptr && cluster->service("plc")->pid != plc; }, 10));
  EXPECT_TRUE(cluster->until([] { return signal("coolant-flood") == 1; }, 10)) << "M8 is still in force";

  cluster->client().channel(0, CommandKind::RESET);
  for (int i = 0; i < 20 && !cluster->active_alarms().empty(); ++i) {  // until HAL has connected anew
    cluster->reset_alarms();
    cluster->until([&] { return cluster->active_alarms().empty(); }, 0.5);
  }
  EXPECT_EQ(cluster->active_alarms(), "");

  // An input: with the door open the spindle does not start.
  output_of("halcmd sets door-closed 0");
  await_door(false);
  EXPECT_THROW(cluster->client().mdi(0, "S100 M3"), std::exception) << "the door is open";
  output_of("halcmd sets door-closed 1");
  await_door(true);

  // A door that opens stops the spindle.
  one_line("S100 M3");
  EXPECT_TRUE(cluster->until([] { return std::abs(signal("s-speed")) > 90; }, 5)) << cluster->told();
  output_of("halcmd sets door-closed 0");
  EXPECT_TRUE(cluster->until([] { return std::abs(signal("s-speed")) < 1; }, 5)) << cluster->told();
}

TEST_F(Hal, KeysOfThePanelArePinsAndSoAreItsLamps) {
  make_encoders_absolute();
  up();
  cluster->until([] { return false; }, 0.8);  // keys pressed within 0.5 s of the PLC's start are held keys
  const auto press = [&](const std::string& key, const std::function<bool()>& condition) {
    output_of("halcmd setp io.key-" + key + " 1");
    EXPECT_TRUE(cluster->until(condition, 10)) << key << ": " << cluster->told();
    output_of("halcmd setp io.key-" + key + " 0");
  };
  const auto lamp = [](const std::string& name) {
    return output_of("halcmd getp io.lamp-" + name) == "TRUE";
  };
  const auto& state = cluster->channels[0];
  press("mdi", [&] { return state.mode == Mode::MDI; });
  EXPECT_TRUE(cluster->until([&] { return lamp("mdi") && !lamp("jog"); }, 5));
  press("jog", [&] { return state.mode == Mode::JOG; });
  EXPECT_TRUE(cluster->until([&] { return lamp("jog") && !lamp("mdi"); }, 5));
  press("single-block", [&] { return state.single_block; });
  EXPECT_TRUE(cluster->until([&] { return lamp("single-block"); }, 5));
  const double x = cluster->feedback.position[0];
  press("x-plus", [&] { return cluster->feedback.position[0] > x + 1; });
  EXPECT_TRUE(cluster->until([&] { return state.state == RunState::IDLE; }, 10)) << cluster->told();
  const double rest = rest_of_x();
  EXPECT_NEAR(signal("x-position"), rest, 1e-6) << "it stays where the key was released";
}

// The angle of the spindle's encoder in HAL, in revolutions.
TEST_F(Hal, M19IsFinishedWhenTheSpindleIsHeldAtItsAngle) {
  make_encoders_absolute();
  up();
  cluster->client().set_mode(0, Mode::MDI);
  for (const char* line : {"S300 M3", "G4 P500", "M19"}) {
    cluster->client().mdi(0, line);
    cluster->until([&] { return cluster->state() != RunState::IDLE; }, 1);
    ASSERT_TRUE(cluster->until([&] { return cluster->state() == RunState::IDLE; }, 20)) << cluster->told();
  }
  EXPECT_NEAR(std::remainder(signal("s-angle"), 1.0) * 360, 0, 0.2) << "10a945 is 0 deg, 10a946 0.1 deg";
  const double angle = signal("s-angle");
  EXPECT_GT(angle, 1) << "it has turned before";
  cluster->until([] { return false; }, 0.5);
  EXPECT_NEAR(signal("s-angle"), angle, 0.001) << "it is held";
}

TEST_F(Hal, NothingIsLeftWhenTheClusterIsDown) {
  up();
  const auto session =
      "/tmp/trunnion-hal-" + std::to_string(getuid()) + "-" + std::to_string(cluster->running().run.domain);
  EXPECT_TRUE(fs::exists(session + "/ready"));
  EXPECT_GE(shmget(hal_memory, 0, 0), 0);
  cluster.reset();
  EXPECT_FALSE(fs::exists(session));
  EXPECT_LT(shmget(hal_memory, 0, 0), 0) << "HAL is still there";
}

TEST_F(Hal, AFaultyFileIsRefusedWithItsLine) {
  replace(directory / "machine.hal", "setp probe.in1 -56", "setp probe.in2 -56");
  try {
    up();
    FAIL() << "it was started";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("machine.hal:"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("probe.in2"), std::string::npos) << e.what();
  }
  cluster.reset();
}

}  // namespace
}  // namespace trunnion::integration
