// SPDX-License-Identifier: Apache-2.0
// What a service manager sees of the launcher and of a service. Some tests play systemd: the socket of
// Type=notify and the watchdog. One has a systemd of its own.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "cluster/cluster_files.hpp"
#include "cluster_harness.hpp"
#include "service/node.hpp"

namespace trunnion::integration {
namespace {

constexpr double watchdog = 0.4;  // s, what WATCHDOG_USEC says; a ping is due twice in it

/// A process with a service manager's environment, and what it tells the manager.
class Unit {
 public:
  explicit Unit(std::vector<std::string> arguments)
      : path_(std::filesystem::temp_directory_path() / ("trunnion-notify-" + std::to_string(getpid()))) {
    std::filesystem::remove(path_);
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      setenv("NOTIFY_SOCKET", path_.c_str(), 1);
      setenv("WATCHDOG_USEC", std::to_string(static_cast<int>(watchdog * 1e6)).c_str(), 1);
      setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
      const int null = open("/dev/null", O_RDWR);
      dup2(null, 0), dup2(null, 1), dup2(null, 2);
      execv(argv[0], argv.data());
      _exit(127);
    }
  }
  ~Unit() {
    if (pid_ > 0) kill(pid_, SIGCONT);  // 0 would be the whole process group, other tests among it
    stop();
    close(socket_);
    std::filesystem::remove(path_);
  }
  int pid() const { return pid_; }
  int stop() {
    if (pid_ <= 0) return -1;
    kill(pid_, SIGTERM);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return status;
  }
  /// Messages that arrive within `seconds`, until one is `wanted` (when it is not empty).
  std::vector<std::string> messages(double seconds, const std::string& wanted = "") {
    std::vector<std::string> all;
    const double until = service::monotonic_seconds() + seconds;
    for (double left = 0; (left = until - service::monotonic_seconds()) > 0;) {
      timeval timeout{static_cast<time_t>(left),
                      static_cast<suseconds_t>((left - static_cast<long>(left)) * 1e6)};
      if (timeout.tv_sec == 0 && timeout.tv_usec == 0) break;
      setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
      std::array<char, 512> buffer;
      const auto n = recv(socket_, buffer.data(), buffer.size(), 0);
      if (n <= 0) break;
      all.emplace_back(buffer.data(), static_cast<std::size_t>(n));
      if (!wanted.empty() && all.back() == wanted) break;
    }
    return all;
  }
  bool told(const std::string& wanted, double seconds) {
    const auto all = messages(seconds, wanted);
    return !all.empty() && all.back() == wanted;
  }

 private:
  std::string path_;
  int socket_ = -1, pid_ = 0;
};

// A thread stops when it is next about to run, so one that is just sending does so still.
bool stands_still(int pid) {
  const auto tasks = std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task");
  return std::all_of(begin(tasks), end(tasks), [](const auto& task) {
    std::ifstream in(task.path() / "stat");
    std::string stat((std::istreambuf_iterator<char>(in)), {});
    return stat.find(") T ") != std::string::npos;
  });
}

void expect_pings_until_it_hangs(Unit& unit) {
  ASSERT_TRUE(unit.told("WATCHDOG=1", 10));
  EXPECT_TRUE(unit.told("WATCHDOG=1", 10)) << "again and again";
  ASSERT_EQ(kill(unit.pid(), SIGSTOP), 0);
  for (int i = 0; i < 1000 && !stands_still(unit.pid()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  unit.messages(0.1);  // what was on its way
  EXPECT_THAT(unit.messages(3 * watchdog), testing::IsEmpty())
      << "a process that hangs does not ping: systemd would kill it";
  ASSERT_EQ(kill(unit.pid(), SIGCONT), 0);
  EXPECT_TRUE(unit.told("WATCHDOG=1", 10));
}

TEST(Systemd, TheLauncherSaysReadyOncePingsStopsWhenItHangsAndSaysThatItStops) {
  const auto domain = cluster::free_domain();
  const auto directory =
      std::filesystem::temp_directory_path() / ("trunnion-systemd-" + std::to_string(getpid()));
  Unit unit({cluster::binary_directory() + "/trunnion", "up", "ac-table", "--foreground", "--time", "virtual",
             "--domain", std::to_string(domain), "--port", std::to_string(http_client::free_port()),
             "--state", directory.string()});
  const auto start = unit.messages(30, "READY=1");
  ASSERT_FALSE(start.empty());
  ASSERT_EQ(start.back(), "READY=1");
  // The services must not speak for the launcher: exactly one READY in a time in which all of them are
  // active.
  const auto later = unit.messages(2 * watchdog);
  EXPECT_EQ(std::count(later.begin(), later.end(), "READY=1"), 0);
  expect_pings_until_it_hangs(unit);
  kill(unit.pid(), SIGTERM);
  EXPECT_TRUE(unit.told("STOPPING=1", 10));
  EXPECT_EQ(unit.stop(), 0) << "a stop that was asked for is no failure";
  std::filesystem::remove_all(directory);
}

TEST(Systemd, AServiceStartedAloneSaysReadyWhenItIsActiveAndPings) {
  const auto domain = cluster::free_domain();
  const auto directory =
      std::filesystem::temp_directory_path() / ("trunnion-systemd-" + std::to_string(getpid()));
  Unit unit({cluster::binary_directory() + "/trunnion-parameters", "--machine",
             cluster::find_machine("ac-table"), "--state", directory.string(), "--domain",
             std::to_string(domain)});
  EXPECT_TRUE(unit.told("READY=1", 20));
  expect_pings_until_it_hangs(unit);
  kill(unit.pid(), SIGTERM);
  EXPECT_TRUE(unit.told("STOPPING=1", 10));
  EXPECT_EQ(unit.stop(), 0);
  std::filesystem::remove_all(directory);
  cluster::RunDirectory{domain}.remove();
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The unit as it is, but for the places of the program and of what it keeps.
void install_unit(const std::filesystem::path& directory, const std::string& kept) {
  std::filesystem::create_directories(directory);
  auto text = content(TRUNNION_UNITS "/trunnion@.service");
  for (const auto& [installed, here] :
       {std::pair<std::string, std::string>{"/usr/bin/trunnion", cluster::binary_directory() + "/trunnion"},
        {"/var/lib/trunnion", kept}}) {
    ASSERT_NE(text.find(installed), std::string::npos);
    text.replace(text.find(installed), installed.size(), here);
  }
  std::ofstream(directory / "trunnion@.service") << text;
}

std::string output_of(const std::string& command, int* status = nullptr) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string text;
  std::array<char, 512> buffer;
  while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  const int ended = pclose(pipe);
  if (status != nullptr) *status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
  return text;
}

class Directory {
 public:
  explicit Directory(const std::string& name)
      : path(std::filesystem::temp_directory_path() / (name + std::to_string(getpid()))) {
    std::filesystem::remove_all(path);
  }
  ~Directory() { std::filesystem::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  const std::filesystem::path path;
};

// systemd-analyze ends with status 0 whatever it finds, so any output is a finding.
TEST(Systemd, TheUnitIsOneThatSystemdUnderstands) {
  if (output_of("command -v systemd-analyze").empty()) GTEST_SKIP() << "no systemd-analyze here";
  const Directory directory("trunnion-unit-");
  install_unit(directory.path, directory.path.string());
  EXPECT_EQ(output_of("systemd-analyze verify " + (directory.path / "trunnion@.service").string()), "");
  // In tenths: 2.1 with all of the hardening, 8.7 without. One of its larger lines less is above 25.
  EXPECT_THAT(output_of("systemd-analyze security --offline=true --threshold=25 " +
                        (directory.path / "trunnion@.service").string() + " && echo kept"),
              testing::EndsWith("kept\n"));
}

TEST(Systemd, ASystemdStartsTheUnitKillsAndRestartsItWhenItHangsAndStopsIt) {
  const Directory directory("trunnion-instance-");
  const auto units = directory.path / "config" / "systemd" / "user";
  install_unit(units, directory.path.string() + "/state");
  const auto domain = std::to_string(cluster::free_domain());
  std::filesystem::create_directories(units / "trunnion@.service.d");
  const auto results = directory.path / "results";
  // A user's systemd cannot become another user or shield devices and the kernel, /etc/trunnion is not this
  // test's, and the programs may lie in somebody's home.
  std::ofstream(units / "trunnion@.service.d" / "test.conf")
      << "[Service]\nUser=\nStateDirectory=\nProtectHome=no\nPrivateDevices=no\nProtectClock=no\n"
         "ProtectControlGroups=no\nProtectHostname=no\nProtectKernelLogs=no\nProtectKernelModules=no\n"
         "ProtectKernelTunables=no\nExecStopPost=/bin/sh -c 'echo $$SERVICE_RESULT "
         ">>"
      << results.string() << "'\nEnvironment=TRUNNION_CONFIGS="
      << std::filesystem::path(cluster::find_machine("ac-table")).parent_path().string()
      << "\nEnvironment=\"TRUNNION_OPTIONS=--time virtual --port " << http_client::free_port() << " --domain "
      << domain << "\"\n";
  int status = 0;
  const auto told = output_of(std::string(TRUNNION_TESTS) + "/systemd_instance.sh " +
                                  directory.path.string() + " " + TRUNNION_TESTS + "/systemd_unit.sh " +
                                  cluster::binary_directory() + "/trunnion " + domain,
                              &status);
  cluster::RunDirectory{static_cast<std::uint32_t>(std::stoul(domain))}.remove();
  if (status == 77) GTEST_SKIP() << told;
  ASSERT_EQ(status, 0) << told;
  EXPECT_NE(told.find("started 0 active ready 0\n"), std::string::npos) << told;
  EXPECT_NE(told.find("hung active ready 1 another\n"), std::string::npos) << told;
  EXPECT_NE(told.find("stopped 0 inactive success 0\n"), std::string::npos) << told;
  EXPECT_EQ(content(results), "watchdog\nsuccess\n") << "why systemd says that the unit ended, each time";
  std::printf("%s", told.c_str());
}

}  // namespace
}  // namespace trunnion::integration
