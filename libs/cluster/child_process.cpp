#include "cluster/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <thread>

namespace trunnion::cluster {

std::string last_line(const std::string& path) {
  std::ifstream in(path);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

ChildProcess::ChildProcess(std::vector<std::string> arguments, std::string log)
    : name_(arguments.at(0)), log_(std::move(log)) {
  if (access(name_.c_str(), X_OK) != 0) throw std::runtime_error(name_ + ": cannot be started");
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error(name_ + ": no process");
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int out = open(log_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    const int null = open("/dev/null", O_RDONLY);
    dup2(null, 0), dup2(out, 1), dup2(out, 2);
    for (int fd = 3; fd < 256; ++fd) close(fd);
    execv(argv[0], argv.data());
    _exit(127);
  }
}

ChildProcess::~ChildProcess() {
  if (!ended().empty()) return;
  kill(pid_, SIGTERM);
  for (int i = 0; i < 300 && ended().empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (how_.empty()) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
}

std::string ChildProcess::ended() {
  int status = 0;
  if (how_.empty() && waitpid(pid_, &status, WNOHANG) == pid_) {
    how_ = name_ + (WIFSIGNALED(status) ? " was ended by signal " + std::to_string(WTERMSIG(status))
                                        : " ended with status " + std::to_string(WEXITSTATUS(status)));
    if (const auto line = last_line(log_); !line.empty()) how_ += ": " + line;
  }
  return how_;
}

namespace {

// For each thread how often it has run; nothing when one runs now. Linux: proc(5), /proc/PID/task.
std::optional<std::map<std::string, std::string>> turns_of_sleepers(int pid) {
  std::map<std::string, std::string> turns;
  std::error_code ignored;
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task", ignored)) {
    std::ifstream stat(task.path() / "stat"), schedule(task.path() / "schedstat");
    std::string line;
    std::getline(stat, line);
    const auto name_ends = line.rfind(") ");
    if (name_ends == std::string::npos || line[name_ends + 2] != 'S') return std::nullopt;
    if (!std::getline(schedule, turns[task.path().filename()])) return std::nullopt;
  }
  if (turns.empty()) return std::nullopt;
  return turns;
}

}  // namespace

bool ChildProcess::sleeps() const {
  const auto first = turns_of_sleepers(pid_);
  return first && turns_of_sleepers(pid_) == first;
}

}  // namespace trunnion::cluster
