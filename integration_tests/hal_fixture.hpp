// SPDX-License-Identifier: Apache-2.0
// A machine behind LinuxCNC's HAL, for its tests: a real, headless HAL with its own simulated axes and
// switches. What HAL does is also looked at from outside, with LinuxCNC's program halcmd.
#pragma once

#include <sched.h>
#include <sys/shm.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "cluster_harness.hpp"

namespace trunnion::integration {
namespace fs = std::filesystem;

inline constexpr int hal_memory = 0x48414c32;  // key of HAL's shared memory

inline std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void replace(const fs::path& path, const std::string& from, const std::string& to) {
  auto text = text_of(path);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << path << " has no '" << from << "'";
  std::ofstream(path) << text.replace(at, from.size(), to);
}

inline std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  char buffer[256];
  while (pipe != nullptr && fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
  if (pipe != nullptr) pclose(pipe);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

inline double signal(const std::string& name) {
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
  /// Why the machine is not started.
  std::string refusal_of_up() {
    try {
      cluster.emplace(directory.string(), Time::real);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "it was started";
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
  /// Until a line is refused because of `axes`: a drive that is new must have answered, and its drives be on.
  void await_refusal(const std::string& axes) {
    std::string answer;
    EXPECT_TRUE(cluster->until([&] {
      try {
        cluster->client().set_mode(0, Mode::MDI);
        cluster->client().mdi(0, "G53 G0 X5");
        answer = "accepted";
      } catch (const std::exception& e) {
        answer = e.what();
      }
      return answer.find("without a reference: " + axes + ".") != std::string::npos &&
             answer.find("(alarm 1142)") != std::string::npos;
    })) << answer
        << cluster->told();
  }
  static fs::path session_of(std::uint32_t domain) {
    return "/tmp/trunnion-hal-" + std::to_string(getuid()) + "-" + std::to_string(domain);
  }
  fs::path session() const { return session_of(cluster->running().run.domain); }
  int session_pid() const { return std::atoi(text_of(session() / "pid").c_str()); }
  int rtapi_pid() const {
    std::istringstream in(text_of(session() / "ready"));
    std::string identity;
    int pid = 0;
    in >> identity >> pid;
    EXPECT_GT(pid, 1);
    return pid;
  }
  /// HAL was loaded again: `why` is told, and nothing moves before axes are homed.
  void await_new_hal(const std::string& why) {
    EXPECT_TRUE(cluster->until([&] { return cluster->has_alarm(100, why); })) << cluster->told();
    EXPECT_TRUE(cluster->until([&] { return cluster->ready() && !cluster->channels[0].homed; }))
        << cluster->told();
    cluster->client().channel(0, CommandKind::RESET);
    EXPECT_TRUE(cluster->until([&] {
      cluster->reset_alarms();
      return !cluster->has_alarm(100);
    })) << cluster->told();
    await_door(true);
    await_refusal("X, Y, Z");
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

}  // namespace trunnion::integration
