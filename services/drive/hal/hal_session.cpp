// SPDX-License-Identifier: Apache-2.0
#include "hal_session.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

namespace trunnion::drive {
namespace fs = std::filesystem;
namespace {

constexpr auto start_timeout = std::chrono::seconds(6);  // the launcher expects a heartbeat within 7.5 s
constexpr auto end_timeout = std::chrono::milliseconds(1800);
constexpr auto poll_period = std::chrono::milliseconds(10);

std::string first_line(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

std::string last_line(const std::string& path) {
  std::ifstream in(path);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

// In /tmp, where anybody may make a directory: one that belongs to another user is not ours.
void make_directory(const std::string& directory) {
  fs::create_directories(directory);
  struct stat status {};
  if (lstat(directory.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid())
    throw std::runtime_error(directory + " belongs to another user");
}

}  // namespace

std::string hal_session_directory(std::uint32_t domain) {
  return "/tmp/trunnion-hal-" + std::to_string(getuid()) + "-" + std::to_string(domain);
}

int hal_session_process(const std::string& directory) {
  std::ifstream in(directory + "/pid");
  int pid = 0;
  if (!(in >> pid) || pid <= 0) return 0;
  // The number may belong to another process by now, or to one that has ended and was not waited for.
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  const bool runs = stat >> number >> name >> state && name == "(trunnion-hal-se)" && state != "Z";
  return runs ? pid : 0;
}

HalSession::HalSession(const Options& options) : directory_(hal_session_directory(options.domain)) {
  // One that has no longer got its file `ready` is about to end: wait until it has.
  const auto until = std::chrono::steady_clock::now() + start_timeout;
  while (hal_session_process(directory_) != 0 && first_line(directory_ + "/ready").empty() &&
         std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(poll_period);
  if (hal_session_process(directory_) == 0) start(options);
  identity_ = first_line(directory_ + "/ready");
}

void HalSession::start(const Options& options) {
  make_directory(directory_);
  fs::remove(directory_ + "/ready");
  if (access(options.program.c_str(), X_OK) != 0)
    throw std::runtime_error(options.program + ": cannot be started");
  std::vector<std::string> arguments{options.program, directory_, options.file,
                                     std::to_string(options.watched_pid)};
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const auto log = directory_ + "/log";
  const int child = fork();
  if (child < 0) throw std::runtime_error("no process for HAL");
  if (child == 0) {
    setsid();
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, 0644);
    const int null = open("/dev/null", O_RDONLY);
    dup2(null, 0), dup2(out, 1), dup2(out, 2);
    for (int fd = 3; fd < 256; ++fd) close(fd);
    execv(argv[0], argv.data());
    _exit(127);
  }
  wait_until_ready(child);
}

void HalSession::wait_until_ready(int child) {
  const auto until = std::chrono::steady_clock::now() + start_timeout;
  while (first_line(directory_ + "/ready").empty()) {
    const bool ended = waitpid(child, nullptr, WNOHANG) == child;
    if (ended || std::chrono::steady_clock::now() > until) {
      auto line = last_line(directory_ + "/log");
      if (ended) fs::remove_all(directory_);
      throw std::runtime_error("HAL could not be started: " + (line.empty() ? "it does not answer" : line));
    }
    std::this_thread::sleep_for(poll_period);
  }
}

void HalSession::end() {
  const int pid = hal_session_process(directory_);
  if (pid == 0) return;
  kill(pid, SIGTERM);
  const auto until = std::chrono::steady_clock::now() + end_timeout;
  while (hal_session_process(directory_) == pid && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(poll_period);
}

}  // namespace trunnion::drive
