// SPDX-License-Identifier: Apache-2.0
// A service's executable as a child process on a machine of its own in a temporary directory.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "machine/services.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::testing_support {

class RunningService {
 public:
  RunningService(std::string executable, const std::string& name, int domain)
      : executable_(std::move(executable)),
        root_(testing::TempDir() + "trunnion_" + name + "_" + std::to_string(getpid())),
        domain_(domain) {
    std::filesystem::remove_all(root_);
    std::filesystem::create_directories(machine());
    std::filesystem::create_directories(state());
    std::string text = "name: test\nservices:\n";
    for (const auto& service : machine::service::all)
      text += std::string("  - {service: ") + service.name + "}\n";
    write("machine/machine.yaml", text);
  }
  ~RunningService() {
    kill_hard();
    std::filesystem::remove_all(root_);
  }
  RunningService(const RunningService&) = delete;
  RunningService& operator=(const RunningService&) = delete;

  std::string machine() const { return root_ + "/machine"; }
  std::string state() const { return root_ + "/state"; }
  void write(const std::string& path, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(root_ + "/" + path).parent_path());
    std::ofstream(root_ + "/" + path, std::ios::binary) << text;
  }
  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {executable_, "--machine", machine(),
                                          "--state",   state(),     "--instance",
                                          "1",         "--domain",  std::to_string(domain_)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<char*> pointers;
    for (auto& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) {
      execv(executable_.c_str(), pointers.data());
      _exit(127);
    }
  }
  void kill_hard() {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
      process_ = 0;
    }
  }
  /// Waits for the end; returns the exit status.
  int wait() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  std::string executable_, root_;
  int domain_;
  pid_t process_ = 0;
};

}  // namespace trunnion::testing_support
