// SPDX-License-Identifier: Apache-2.0
// The real executable with real DDS on one side and real sockets on the other; the rest of the cluster is a
// fake.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "http_client/client.hpp"
#include "test/fake_cluster.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::gateway {

using http_client::free_port;
using http_client::Response;
using nlohmann::json;
using testing_support::eventually;

inline constexpr std::uint32_t domain = 51;

/// A child process; its standard error goes to a file.
class Process {
 public:
  Process(const std::vector<std::string>& arguments, const std::string& error_file) {
    pid_ = fork();
    if (pid_ != 0) return;
    const int fd = ::open(error_file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
    dup2(fd, 2);
    std::vector<char*> argv;
    for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  ~Process() {
    if (pid_ > 0) {
      kill(pid_, SIGTERM);
      wait();
    }
  }
  pid_t pid() const { return pid_; }
  int wait() {
    int status = 0;
    if (pid_ > 0) waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_ = -1;
};

/// The state directory is beside the directory of the page.
inline std::vector<std::string> command_line(std::uint16_t port, const std::string& web) {
  return {
      GATEWAY,  "--machine",          MACHINE, "--state", web + "_state", "--domain", std::to_string(domain),
      "--port", std::to_string(port), "--web", web,       "--instance",   "20"};
}

class Gateway : public testing::Test {
 protected:
  void SetUp() override {
    web_ = testing::TempDir() + "/gateway_web_" + std::to_string(getpid());
    std::filesystem::create_directories(web_);
    std::filesystem::create_directories(state_ = web_ + "_state");
    std::ofstream(web_ + "/index.html") << "<p>the page</p>";
    auto arguments = command_line(port_, web_);
    arguments[2] = machine_directory_;
    process_ = std::make_unique<Process>(arguments, web_ + "/stderr.txt");
    stepper_ = std::thread([this] {
      while (!stop_) {
        {
          const std::lock_guard lock(mutex_);
          cluster_.step();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    });
    ASSERT_TRUE(eventually([&] {
      return get("/api/channels/0").status == 200 && get("/api/programs").status == 200 &&
             get("/api/parameters/100034").status == 200 && get("/api/work-offsets").status == 200 &&
             get("/api/tools").status == 200 && get("/api/plc/image").status == 200;
    }));
  }
  void TearDown() override {
    stop_ = true;
    stepper_.join();
    process_.reset();
    std::filesystem::remove_all(web_);
    std::filesystem::remove_all(state_);
  }

  Response get(const std::string& target) const { return http_client::request(port_, "GET", target); }
  Response post(const std::string& target, const json& body = json::object()) const {
    return http_client::request(port_, "POST", target, body.dump());
  }
  /// `look(cluster)` while the cluster stands still.
  template <class Look>
  auto cluster(Look look) {
    const std::lock_guard lock(mutex_);
    return look(cluster_);
  }
  /// Returns when the gateway lists them.
  void publish_4000_programs() {
    cluster([](auto& c) {
      for (int i = 0; i < 4000; ++i) c.programs["PART-" + std::to_string(i) + ".NC"] = {'M', '2', '\n'};
      c.publish_programs();
    });
    const auto listed = [&] { return get("/api/programs?offset=4000").headers["x-total-count"]; };
    EXPECT_TRUE(eventually([&] { return listed().size() == 4; }));
  }

  const std::uint16_t port_ = free_port();
  std::string web_, state_, machine_directory_ = MACHINE;
  std::mutex mutex_;
  FakeCluster cluster_{{domain}};
  std::atomic<bool> stop_ = false;
  std::thread stepper_;
  std::unique_ptr<Process> process_;
};

}  // namespace trunnion::gateway
