// SPDX-License-Identifier: Apache-2.0
#include "cluster/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>

namespace trunnion::cluster {
namespace {

// For execv(), which does not write to them.
std::vector<char*> pointers_to(const std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  for (const auto& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

// In the child, where only what is safe in a signal handler may be called: other threads of the parent may
// hold any lock.
[[noreturn]] void execute(char* const* arguments, const ChildOptions& options, int output) {
  if (options.ends_with_parent) prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (!options.log.empty()) {
    const int log = open(options.log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    const int null = open("/dev/null", O_RDONLY);
    dup2(null, 0), dup2(log, 1), dup2(log, 2);
  }
  int last = 2;
  if (options.read_from) {
    if (output == *options.read_from)
      fcntl(output, F_SETFD, 0);
    else
      dup2(output, *options.read_from);
    last = std::max(last, *options.read_from);
  }
  for (int fd = 3; fd < last; ++fd) close(fd);
  close_range(static_cast<unsigned>(last) + 1, ~0U, 0);
  execv(arguments[0], arguments);
  dprintf(2, "%s: cannot be started\n", arguments[0]);
  _exit(127);
}

// For each thread how often it has run; nothing when one runs now. Linux: proc(5), /proc/PID/task.
std::optional<std::map<std::string, std::string>> thread_switch_counts(pid_t pid) {
  std::map<std::string, std::string> counts;
  std::error_code ignored;
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task", ignored)) {
    std::ifstream stat(task.path() / "stat"), schedule(task.path() / "schedstat");
    std::string line;
    std::getline(stat, line);
    const auto name_ends = line.rfind(") ");
    if (name_ends == std::string::npos || line[name_ends + 2] != 'S') return std::nullopt;
    if (!std::getline(schedule, counts[task.path().filename()])) return std::nullopt;
  }
  if (counts.empty()) return std::nullopt;
  return counts;
}

// CLI11 writes it behind the error, also when a process of another build does not know an argument.
constexpr const char* hint_behind_errors = "Run with --help for more information.";

}  // namespace

std::string last_line(const std::string& path) {
  std::ifstream in(path);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty() && line != hint_behind_errors) last = line;
  return last;
}

void replace_process(const std::vector<std::string>& arguments) {
  execv(arguments.at(0).c_str(), pointers_to(arguments).data());
}

ChildProcess::ChildProcess(const ChildOptions& options) : name_(options.arguments.at(0)), log_(options.log) {
  const auto arguments = pointers_to(options.arguments);
  int ends[2] = {-1, -1};
  if (options.read_from && pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(name_ + ": no pipe");
  pid_ = fork();
  if (pid_ == 0) {
    if (options.detached) {
      setsid();
      if (fork() != 0) _exit(0);
    }
    execute(arguments.data(), options, ends[1]);
  }
  if (ends[1] >= 0) close(ends[1]);
  output_ = ends[0];
  if (pid_ < 0) {
    pid_ = 0;
    release();
    throw std::runtime_error(name_ + ": no process");
  }
  if (options.detached) waitpid(std::exchange(pid_, 0), nullptr, 0);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept { *this = std::move(other); }

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  if (this == &other) return *this;
  stop();
  release();
  name_ = std::move(other.name_);
  log_ = std::move(other.log_);
  pid_ = std::exchange(other.pid_, 0);
  output_ = std::exchange(other.output_, -1);
  status_ = std::exchange(other.status_, std::nullopt);
  return *this;
}

ChildProcess::~ChildProcess() {
  stop();
  release();
}

void ChildProcess::release() {
  if (output_ >= 0) close(std::exchange(output_, -1));
}

std::optional<int> ChildProcess::status() {
  int status = 0;
  if (pid_ != 0 && waitpid(pid_, &status, WNOHANG) == pid_) {
    status_ = status;
    pid_ = 0;
  }
  return status_;
}

std::string ChildProcess::ended() {
  const auto status = this->status();
  if (!status) return "";
  auto how = name_ + (WIFSIGNALED(*status) ? " was ended by signal " + std::to_string(WTERMSIG(*status))
                                           : " ended with status " + std::to_string(WEXITSTATUS(*status)));
  if (const auto line = last_line(log_); !line.empty()) how += ": " + line;
  return how;
}

void ChildProcess::signal(int number) const {
  if (pid_ != 0) ::kill(pid_, number);
}

void ChildProcess::stop(double timeout) {
  signal(SIGTERM);
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout);
  while (!status() && pid_ != 0 && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill();
}

void ChildProcess::kill() {
  if (pid_ == 0) return;
  signal(SIGKILL);
  int status = 0;
  waitpid(std::exchange(pid_, 0), &status, 0);
  status_ = status;
}

std::string ChildProcess::read_line() {
  std::string line;
  char c = 0;
  while (read(output_, &c, 1) == 1 && c != '\n') line += c;
  return line;
}

std::string ChildProcess::read_all() {
  std::string text;
  char buffer[512];
  for (ssize_t n; (n = read(output_, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  return text;
}

bool ChildProcess::sleeps() const {
  const auto first = thread_switch_counts(pid_);
  return first && thread_switch_counts(pid_) == first;
}

}  // namespace trunnion::cluster
