// SPDX-License-Identifier: Apache-2.0
// A machine behind LinuxCNC's HAL in use: references, programs, probes, inputs and outputs.
#include "hal_fixture.hpp"

namespace trunnion::integration {
namespace {

TEST_F(Hal, AxesWithoutAReferenceRefuseToMoveAndFindItAtTheirSwitches) {
  up();
  for (const auto* axis : {"axis X ", "axis Y ", "axis Z "})
    EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(115, axis); })) << cluster->told();
  EXPECT_TRUE(cluster->until([&] { return !cluster->channels[0].homed; })) << cluster->told();
  await_refusal("X, Y, Z");
  home(0);
  EXPECT_FALSE(cluster->channels[0].homed);
  await_refusal("Y, Z");
  home(1);
  home(2);
  EXPECT_TRUE(cluster->until([&] { return cluster->channels[0].homed; })) << cluster->told();
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
  cluster->on_batch = [&](const idl::stream::Feedback& feedback) {
    for (std::uint32_t i = 0; i < feedback.count; ++i, ++rows) {
      before = commanded;
      commanded.assign(feedback.commanded.begin() + i * 3, feedback.commanded.begin() + (i + 1) * 3);
      // An encoder row is of the moment at which the setpoint comes into force: the setpoint before it was
      // reached.
      for (std::size_t a = 0; a < 3 && rows > 0; ++a)
        most = std::max(most, std::abs(feedback.actual[i * 3 + a] - before[a]));
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
  EXPECT_EQ(cluster->lost_batches, 0u);
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
  EXPECT_FALSE(cluster->has_alarm(116)) << cluster->told();
  await_refusal("X, Y, Z");
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
  cluster->on_batch = [&](const idl::stream::Feedback& feedback) {
    edges.insert(edges.end(), feedback.skips.begin(), feedback.skips.end());
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

}  // namespace
}  // namespace trunnion::integration
