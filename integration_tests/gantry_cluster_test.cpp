// SPDX-License-Identifier: Apache-2.0
// A gantry of real processes: release of the emergency stop, a slave that is taken off, killed services, a
// second run. gantry-cb-head: Y (1) with its slave Y2 (2); 102062 = 1, 102107 = 0.2 mm; the key is X16.6.
#include <cmath>

#include "cluster_harness.hpp"
#include "machine_copy.hpp"

namespace trunnion::integration {
namespace {

using idl::plc::PanelRequestKind;

// Friction 0.03 * 4500 mm/s2 / (Kp 600 1/s * Kv 60 1/s) = 3.8 um, of either side, until the integral has it.
constexpr double settled = 0.008;  // mm

class Bridge : public Cluster {
 public:
  using Cluster::Cluster;
  double error() const { return feedback.position.at(2) - feedback.position.at(1); }
  bool is_off() const { return feedback.enabled.at(2) == 3; }

  /// Keys at the bridge: X16.6 takes the slave off, X16.7 is the external reset.
  void keys(std::uint32_t value) {
    service::RequestClient<idl::plc::PanelRequest, idl::plc::PanelReply> panel(
        client().bus(), topics::panel_request, topics::panel_reply);
    const auto reply = panel.call({.kind = PanelRequestKind::FORCE_INPUT, .address = 16, .value = value}, 5);
    ASSERT_TRUE(reply) << "the PLC does not answer; " << told();
    ASSERT_TRUE(reply->accepted) << reply->reason;
  }
  /// The key of the slave, until the drive has it; takes it off without an alarm that would refuse a jog.
  void key(bool on) {
    client().set_mode(0, Mode::JOG);
    keys(on ? 64u : 0u);
    ASSERT_TRUE(until([&] { return is_off() == on; })) << told();
    if (on) reset();  // nothing supervises a slave that is off
  }
  void jog(double increment) {
    const double from = feedback.position.at(1);
    idl::channel::ChannelRequest request;
    request.command = CommandKind::JOG_AXIS;
    request.axis = 1, request.speed = std::copysign(600, increment), request.increment = std::abs(increment);
    client().set_mode(0, Mode::JOG);
    client().channel(request);
    ASSERT_TRUE(until([&] {
      return std::abs(feedback.position.at(1) - from - increment) < settled && state() == RunState::IDLE;
    })) << told();
  }
  /// The slave is `distance` away from its master afterwards.
  void misalign(double distance) {
    key(true);
    jog(error() - distance);
    key(false);
    EXPECT_TRUE(error_becomes(distance)) << error();
  }
  /// Of an axis that is at rest, mm.
  bool error_becomes(double expected) {
    const auto is_there = [&] { return std::abs(error() - expected) <= settled; };
    return until(is_there) && rests() && is_there();
  }
  void press() {
    client().panel(PanelRequestKind::PRESS_EMERGENCY_STOP);
    ASSERT_TRUE(until([&] { return feedback.mode == DriveMode::OFF; })) << told();
  }
  void release() {
    client().panel(PanelRequestKind::RELEASE_EMERGENCY_STOP);
    client().panel(PanelRequestKind::RESET_EMERGENCY_STOP);
    ASSERT_TRUE(until([&] { return feedback.mode == DriveMode::FOLLOWING; })) << told();
    ASSERT_TRUE(rests()) << told();
  }
  void kill_service(const std::string& name) {
    const auto pid = service(name)->pid;
    ASSERT_EQ(kill(pid, SIGKILL), 0);
    ASSERT_TRUE(until([&] { return service(name)->pid != pid && ready(); })) << told();
    ASSERT_TRUE(rests()) << told();
  }
  void reset() {
    ASSERT_TRUE(until([&] {
      reset_alarms();
      newer_state();
      return active_alarms().empty();
    })) << told();
  }
  bool runs(const std::string& text) {
    reset();
    start_text(text);
    return finish();
  }
};

struct StateDirectory {
  std::string path = (std::filesystem::temp_directory_path() / "trunnion-gantry-XXXXXX").string();
  StateDirectory() { EXPECT_NE(mkdtemp(path.data()), nullptr); }
  ~StateDirectory() { std::filesystem::remove_all(path); }
};

const char* const to_and_fro = "G21 G90 G53 G1 Y40 F20000\nG53 G1 Y0\nM30\n";

TEST(GantryCluster, TheReleaseOfTheEmergencyStopAlignsBelowTheLimitAndRefusesAboveIt) {
  Bridge bridge("gantry-cb-head");
  bridge.misalign(0.12);
  EXPECT_EQ(bridge.active_alarms(), "");
  ASSERT_TRUE(bridge.runs(to_and_fro)) << bridge.told();
  EXPECT_TRUE(bridge.error_becomes(0.12)) << bridge.error() << " mm, "
                                          << "kept until the release";
  const double master = bridge.feedback.position[1];
  bridge.press();
  EXPECT_TRUE(bridge.error_becomes(0.12)) << bridge.error();
  bridge.release();
  EXPECT_TRUE(bridge.error_becomes(0)) << bridge.error();
  EXPECT_NEAR(bridge.feedback.position[1], master, settled) << "the master stays";
  // Above the limit.
  bridge.reset();
  bridge.misalign(0.3);
  ASSERT_TRUE(bridge.until([&] { return bridge.has_alarm(121, "axis 2"); })) << bridge.told();
  bridge.press();
  bridge.release();
  EXPECT_TRUE(bridge.error_becomes(0.3)) << bridge.error() << " mm, "
                                         << "nothing moved";
  EXPECT_TRUE(bridge.has_alarm(121, "was not moved")) << bridge.told();
  bridge.reset_alarms();
  bridge.until([] { return false; }, 0.5);
  EXPECT_TRUE(bridge.has_alarm(121)) << "its cause is there";
  // The way out: nothing supervises a slave that is off, and the external reset of the manuals (G2960.3)
  // clears what it has reported.
  bridge.client().set_mode(0, Mode::JOG);
  bridge.keys(64);
  ASSERT_TRUE(bridge.until([&] { return bridge.is_off(); })) << bridge.told();
  bridge.until([] { return false; }, 0.5);
  EXPECT_TRUE(bridge.has_alarm(121)) << "until a reset";
  bridge.keys(64 + 128);
  EXPECT_TRUE(bridge.until([&] { return bridge.active_alarms().empty(); })) << bridge.told();
  bridge.misalign(0.05);
  bridge.press();
  bridge.release();
  EXPECT_TRUE(bridge.error_becomes(0)) << bridge.error();
  EXPECT_TRUE(bridge.runs(to_and_fro)) << bridge.told();
}

TEST(GantryCluster, AKilledServiceChangesNothingOfAGantryAtRest) {
  for (const std::string victim : {"gantry", "drive", "plc"}) {
    SCOPED_TRACE(victim);
    Bridge bridge("gantry-cb-head");
    // Aligned.
    bridge.kill_service(victim);
    EXPECT_TRUE(bridge.error_becomes(0)) << bridge.error();
    ASSERT_TRUE(bridge.runs(to_and_fro)) << bridge.told();
    EXPECT_TRUE(bridge.error_becomes(0)) << bridge.error();
    // The slave taken off: the PLC keeps the key's input no longer, and the slave is coupled where it is.
    bridge.key(true);
    bridge.jog(-0.3);
    bridge.kill_service(victim);
    EXPECT_TRUE(bridge.error_becomes(0.3)) << bridge.error();
    bridge.key(true);
    bridge.jog(0.2);
    bridge.key(false);
    EXPECT_TRUE(bridge.error_becomes(0.1)) << bridge.error();
    // Out of tolerance.
    bridge.misalign(0.4);
    bridge.kill_service(victim);
    EXPECT_TRUE(bridge.error_becomes(0.4)) << bridge.error() << " mm, "
                                           << "nothing aligns it";
    ASSERT_TRUE(bridge.until([&] { return bridge.has_alarm(121); })) << bridge.told();
    bridge.misalign(0.1);
    bridge.press();
    bridge.release();
    EXPECT_TRUE(bridge.error_becomes(0)) << bridge.error();
    EXPECT_TRUE(bridge.runs(to_and_fro)) << bridge.told();
  }
}

TEST(GantryCluster, AGantryStageKilledInMotionStopsBothSidesTogetherAndTheProgramContinues) {
  const MachineCopy machine("gantry-cb-head");
  machine.set_lead(lead_beyond_stalls);
  Bridge bridge(machine.path(), Time::real);
  double most = 0;
  bridge.on_batch = [&](const auto& batch) {
    for (std::uint32_t i = 0; i < batch.count; ++i)
      most = std::max(most, std::abs(batch.commanded[i * batch.axis_count + 2] -
                                     batch.commanded[i * batch.axis_count + 1]));
  };
  bridge.start_text("G21 G90 G53 G1 Y300 F6000\nG53 G1 Y0\nM30\n");
  ASSERT_TRUE(bridge.until([&] { return bridge.feedback.position[1] > 50; })) << bridge.told();
  const auto pid = bridge.service("gantry")->pid;
  ASSERT_EQ(kill(pid, SIGKILL), 0);
  // The drive stops when its setpoints end, or the channel before that, at the alarm of the lost stage.
  ASSERT_TRUE(bridge.until([&] {
    return bridge.feedback.mode == DriveMode::HELD || bridge.state() == RunState::HELD;
  })) << bridge.told();
  ASSERT_TRUE(bridge.until([&] { return bridge.service("gantry")->pid != pid && bridge.ready(); }))
      << bridge.told();
  ASSERT_TRUE(bridge.go_on()) << bridge.told();
  ASSERT_TRUE(bridge.finish()) << bridge.told();
  EXPECT_LT(most, 1e-9) << "mm, of the setpoints of both sides";
  EXPECT_TRUE(bridge.until([&] { return std::abs(bridge.error()) < settled; })) << bridge.error() << " mm";
}

TEST(GantryCluster, ASecondRunIsTheFirstBitForBitAndARestartKeepsTheSides) {
  const StateDirectory state;
  Rows first;
  for (const int run : {1, 2}) {
    Bridge bridge("gantry-cb-head");
    bridge.keep_rows = true;
    ASSERT_TRUE(bridge.runs(to_and_fro)) << bridge.told();
    if (run == 1)
      first = bridge.rows;
    else
      EXPECT_EQ(first_difference(bridge.rows, first), "");
  }
  for (const int run : {1, 2}) {
    Bridge bridge("gantry-cb-head", Time::virtual_, "", false, std::nullopt, state.path);
    if (run == 1) {
      bridge.misalign(0.3);
    } else {
      EXPECT_TRUE(bridge.error_becomes(0.3)) << bridge.error() << " mm, "
                                             << "above the limit: not aligned when it is switched on";
      ASSERT_TRUE(bridge.until([&] { return bridge.has_alarm(121); })) << bridge.told();
    }
  }
}

}  // namespace
}  // namespace trunnion::integration
