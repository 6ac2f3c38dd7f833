// SPDX-License-Identifier: Apache-2.0
#include "hal_session.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "processes.hpp"

namespace trunnion::drive {
namespace fs = std::filesystem;
namespace {

constexpr auto start_timeout = std::chrono::seconds(6);  // the launcher expects a heartbeat within 7.5 s
constexpr auto end_timeout = std::chrono::milliseconds(1800);
constexpr auto poll_period = std::chrono::milliseconds(10);

std::string last_line(const std::string& path) {
  std::ifstream in(path);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

// In /tmp, where anybody may make a directory: one that belongs to another user is not ours.
bool is_ours(const std::string& directory) {
  struct stat status {};
  return lstat(directory.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == geteuid();
}

void make_directory(const std::string& directory) {
  fs::create_directories(directory);
  if (!is_ours(directory)) throw std::runtime_error(directory + " belongs to another user");
}

}  // namespace

std::string hal_session_directory(std::uint32_t domain) {
  return "/tmp/trunnion-hal-" + std::to_string(getuid()) + "-" + std::to_string(domain);
}

int hal_session_process(const std::string& directory) {
  std::ifstream in(directory + "/pid");
  int pid = 0;
  // The number may belong to another process by now.
  return in >> pid && pid > 0 && process_name(pid) == session_process ? pid : 0;
}

HalSession::HalSession(const Options& options)
    : program_(options.program), directory_(hal_session_directory(options.domain)) {
  // One that is not ready, or whose HAL has ended, is about to end: wait until it has.
  const auto until = std::chrono::steady_clock::now() + start_timeout;
  while (hal_session_process(directory_) != 0 && !ready() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(poll_period);
  if (hal_session_process(directory_) == 0) {
    make_directory(directory_);
    fs::remove(directory_ + "/ready");
    wait_until_ready(start({directory_, options.file, std::to_string(options.watched_pid)}));
  }
  watch();
}

HalSession::~HalSession() {
  for (const int descriptor : descriptors_)
    if (descriptor >= 0) close(descriptor);
}

// The file has the identity, and the number of rtapi_app below it.
bool HalSession::ready() const {
  std::ifstream in(directory_ + "/ready");
  std::string identity;
  int pid = 0;
  return in >> identity >> pid && process_name(pid) == real_time_process;
}

void HalSession::watch() {
  std::ifstream in(directory_ + "/ready");
  int pid = 0;
  in >> identity_ >> pid;
  descriptors_ = {process_descriptor(hal_session_process(directory_)), process_descriptor(pid)};
  if (const char* what = ended()) throw std::runtime_error(what);
}

const char* HalSession::ended() const {
  pollfd polled[] = {{descriptors_[0], POLLIN, 0}, {descriptors_[1], POLLIN, 0}};
  if (descriptors_[0] >= 0 && descriptors_[1] >= 0 && poll(polled, 2, 0) <= 0) return nullptr;
  return descriptors_[1] < 0 || polled[1].revents != 0 ? "LinuxCNC's real-time process rtapi_app has ended"
                                                       : "The process trunnion-hal-session has ended";
}

// Its process.
int HalSession::start(const std::vector<std::string>& arguments) const {
  if (access(program_.c_str(), X_OK) != 0) throw std::runtime_error(program_ + ": cannot be started");
  std::vector<std::string> words{program_};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
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
  return child;
}

void HalSession::wait_until_ready(int child) {
  const auto until = std::chrono::steady_clock::now() + start_timeout;
  while (!ready()) {
    const bool ended = waitpid(child, nullptr, WNOHANG) == child;
    if (ended || std::chrono::steady_clock::now() > until) {
      auto line = last_line(directory_ + "/log");
      if (ended) fs::remove_all(directory_);
      throw std::runtime_error("HAL could not be started: " + (line.empty() ? "it does not answer" : line));
    }
    std::this_thread::sleep_for(poll_period);
  }
}

// A session that was killed leaves HAL and what its .hal file has started: another one ends them.
void HalSession::end() {
  int pid = hal_session_process(directory_);
  if (pid != 0)
    kill(pid, SIGTERM);
  else if (is_ours(directory_))
    pid = start({"--end", directory_});
  const auto until = std::chrono::steady_clock::now() + end_timeout;
  while (pid != 0 && !process_name(pid).empty() && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(poll_period);
}

}  // namespace trunnion::drive
