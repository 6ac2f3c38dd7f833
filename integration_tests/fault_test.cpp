// SPDX-License-Identifier: Apache-2.0
// kill -9 of every service in the middle of a motion: what the machine does and that nothing is lost. In
// virtual time, so that a busy machine changes nothing.
#include "cluster_harness.hpp"
#include "machine/services.hpp"
#include "machine_copy.hpp"

namespace trunnion::integration {
namespace {

// 30 rounds of 0.2 m with both rotary axes at 50 mm/s: about 130 s of motion, of which the kill comes in the
// eighth; in virtual time still some seconds.
std::string long_program() {
  std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  for (int i = 0; i < 30; ++i) text += "X60 Y30 A20 C40 F3000\nX-60 Y-30 A-10 C-20\n";
  return text + "X0 Y0 A0 C0\nG49\nM30\n";
}

class KillInMotion : public testing::TestWithParam<machine::ServiceDefinition> {};

TEST_P(KillInMotion, StopsNamesTheServiceBecomesReadyAndTheProgramGoesOn) {
  const std::string victim = GetParam().name;
  Cluster cluster("ac-table", Time::virtual_, "", victim == "gateway");
  cluster.start_text(long_program());
  ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].line >= 8; }));
  std::map<std::string, int> pids;
  for (const auto& s : cluster.list().services) pids[s.service] = s.pid;
  ASSERT_EQ(kill(pids[victim], SIGKILL), 0);

  ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(100, victim); })) << "an alarm names the service";
  ASSERT_TRUE(cluster.until([&] { return cluster.ready() && cluster.service(victim)->pid != pids[victim]; }))
      << "ready again";
  ASSERT_TRUE(cluster.until([&] {
    return cluster.state() == RunState::INTERRUPTED || cluster.state() == RunState::HELD;
  })) << "stopped; state "
      << bus::to_string(cluster.state());
  // A channel may be back before the drive's patience with the silence of the old one ends and it brakes.
  ASSERT_TRUE(cluster.until([&] {
    const auto& channels = cluster.feedback.channels;
    return cluster.feedback.mode == DriveMode::HELD ||
           std::none_of(channels.begin(), channels.end(), [](const auto& channel) { return channel.active; });
  })) << cluster.told();
  ASSERT_TRUE(cluster.rests()) << cluster.told();
  for (const auto& s : cluster.list().services)
    if (s.service != victim) {
      EXPECT_EQ(s.pid, pids[s.service]) << s.service << " was not restarted";
    }
  if (victim == "gateway") {
    EXPECT_TRUE(cluster.until([&] {
      return http_client::request(cluster.running().port, "GET", "/api/status").status == 200;
    })) << "the page is served again";
  }
  const auto stopped_at = cluster.channels[0].machine;
  ASSERT_TRUE(cluster.rests()) << cluster.told();
  for (std::size_t i = 0; i < stopped_at.size(); ++i)
    EXPECT_NEAR(cluster.channels[0].machine[i], stopped_at[i], 0.05) << "stands still";

  ASSERT_TRUE(cluster.until(
      [&] {
        cluster.reset_alarms();
        return !cluster.has_alarm(100) && !cluster.has_alarm(110);
      },
      10))
      << cluster.active_alarms();
  std::string refusal;
  ASSERT_TRUE(cluster.until([&] {
    try {
      cluster.client().channel(0, CommandKind::CYCLE_START);
      return true;
    } catch (const std::exception& e) {
      refusal = e.what();
      cluster.reset_alarms();
      return false;
    }
  })) << refusal
      << " " << cluster.active_alarms();
  ASSERT_TRUE(cluster.until([&] { return cluster.state() == RunState::RUNNING; })) << cluster.told();
  ASSERT_TRUE(cluster.finish()) << cluster.told();
  ASSERT_TRUE(cluster.rests()) << cluster.told();  // the encoders settle on the commanded position
  // Tip at X0 Y0 Z80 of G54 (Z -380) with A0 C0: the spindle face is the tool's 100 mm above it.
  const auto& machine = cluster.channels[0].machine;
  EXPECT_NEAR(machine[0], 0, 0.02);
  EXPECT_NEAR(machine[1], 0, 0.02);
  EXPECT_NEAR(machine[2], -380 + 80 + 100, 0.02);
  EXPECT_NEAR(machine[3], 0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Services, KillInMotion, testing::ValuesIn(machine::service::all),
                         [](const auto& service) { return std::string(service.param.name); });

TEST(Faults, AHungServiceIsReplaced) {
  const MachineCopy machine("ac-table");
  machine.set_lead(lead_beyond_stalls);
  Cluster cluster(machine.path(), Time::real);
  cluster.until([] { return false; }, 8);  // a process gets its time to start before its silence counts
  const int pid = cluster.service("compensation")->pid;
  ASSERT_EQ(kill(pid, SIGSTOP), 0);
  EXPECT_TRUE(cluster.until([&] { return cluster.has_alarm(100, "compensation"); }));
  EXPECT_TRUE(cluster.until([&] { return cluster.ready() && cluster.service("compensation")->pid != pid; }));
}

// The button is pressed while the PLC hangs: the drive takes it at once, and the PLC that replaces the hung
// one has it too.
TEST(Faults, AnEmergencyStopIsAcceptedWithoutThePlcAndKeptThroughItsReplacement) {
  Cluster cluster("ac-table", Time::virtual_, "", true);
  const auto status = [&](const char* method, const std::string& path) {
    return http_client::request(cluster.running().port, method, path, "{}").status;
  };
  ASSERT_TRUE(cluster.until([&] { return status("GET", "/api/channels/0") == 200; }));
  ASSERT_TRUE(cluster.until([&] { return cluster.feedback.mode == DriveMode::FOLLOWING; }));
  const int pid = cluster.service("plc")->pid;
  ASSERT_EQ(kill(pid, SIGSTOP), 0);
  EXPECT_EQ(status("POST", "/api/panel/emergency-stop"), 200);
  EXPECT_TRUE(cluster.until([&] { return cluster.feedback.mode == DriveMode::OFF; }));
  EXPECT_NE(cluster.feedback.press_number, 0U);
  ASSERT_TRUE(cluster.until([&] {
    return cluster.ready() && cluster.service("plc")->pid != pid && cluster.has_alarm(130);
  })) << cluster.active_alarms();
  for (int i = 0; i < 50; ++i) {  // whatever order the new one's messages come in
    cluster.until([] { return false; }, 0.02);
    ASSERT_NE(cluster.feedback.mode, DriveMode::FOLLOWING);
  }
  cluster.client().panel(idl::plc::PanelRequestKind::RELEASE_EMERGENCY_STOP);
  cluster.client().panel(idl::plc::PanelRequestKind::RESET_EMERGENCY_STOP);
  ASSERT_TRUE(cluster.until([&] {
    cluster.reset_alarms();
    return cluster.feedback.mode == DriveMode::FOLLOWING && cluster.active_alarms().empty();
  })) << cluster.active_alarms();
}

TEST(Faults, EmergencyStopStopsSwitchesOffAndNeedsAReset) {
  Cluster cluster("ac-table");
  cluster.start_text(long_program());
  ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].line >= 8; }));
  cluster.client().panel(idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP);
  ASSERT_TRUE(cluster.until([&] {
    return cluster.feedback.mode == DriveMode::OFF && cluster.has_alarm(130);
  })) << cluster.active_alarms();
  ASSERT_TRUE(cluster.until([&] { return cluster.state() == RunState::INTERRUPTED; }));
  EXPECT_THROW(cluster.client().channel(0, CommandKind::CYCLE_START), std::runtime_error);
  cluster.client().panel(idl::plc::PanelRequestKind::RELEASE_EMERGENCY_STOP);
  cluster.client().panel(idl::plc::PanelRequestKind::RESET_EMERGENCY_STOP);
  cluster.client().channel(0, CommandKind::RESET);
  ASSERT_TRUE(cluster.until([&] {
    cluster.reset_alarms();
    return cluster.feedback.mode == DriveMode::FOLLOWING && !cluster.has_alarm(130);
  })) << cluster.active_alarms();
  // States are published twenty times a second.
  ASSERT_TRUE(cluster.until([&] { return cluster.state() == RunState::IDLE; })) << cluster.active_alarms();
  cluster.start_text("G90 G0 X5\nM30\n");
  ASSERT_TRUE(cluster.finish()) << cluster.active_alarms();
  // The encoder settles on the commanded position after the last setpoint.
  EXPECT_TRUE(cluster.until([&] { return std::abs(cluster.channels[0].machine[0] - 5) < 0.01; }))
      << cluster.channels[0].machine[0];
}

TEST(Faults, AKilledLauncherTakesItsServicesWithItAndTheNextCommandSaysSo) {
  cluster::UpOptions up;
  up.machine = "ac-table";
  up.state_directory = "temporary";
  up.own_domain = true;
  up.virtual_time = true;
  up.with_gateway = false;
  const auto cluster = cluster::start_cluster(up);
  std::vector<int> pids;
  {
    cluster::Client client(cluster.run.domain);
    for (const auto& service : client.newest(topics::cluster).services) pids.push_back(service.pid);
  }
  ASSERT_EQ(pids.size(), 9u);
  ASSERT_EQ(kill(*cluster.run.launcher(), SIGKILL), 0);
  const auto alive = [](int pid) {
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string number, name, state;
    return static_cast<bool>(stat >> number >> name >> state) && state != "Z";
  };
  for (int i = 0; i < 500 && std::any_of(pids.begin(), pids.end(), alive); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(std::none_of(pids.begin(), pids.end(), alive));
  std::string message;
  try {
    cluster::find_cluster(cluster.run.domain);
  } catch (const std::exception& e) {
    message = e.what();
  }
  EXPECT_NE(message.find("was killed"), std::string::npos) << message;
  EXPECT_TRUE(cluster.run.abandoned());
  cluster.run.remove();
  EXPECT_FALSE(std::filesystem::exists(cluster.run.path()));
}

}  // namespace
}  // namespace trunnion::integration
