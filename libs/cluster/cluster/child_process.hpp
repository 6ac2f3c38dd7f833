// SPDX-License-Identifier: Apache-2.0
// A program that this process starts: the one class for services, the recorder, the launcher and what is
// verified.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace trunnion::cluster {

/// The last line of the file `path` that is neither empty nor only the hint at --help.
std::string last_line(const std::string& path);

/// Puts `arguments` in the place of this process. Returns only when there is no such program.
void replace_process(const std::vector<std::string>& arguments);

struct ChildOptions {
  std::vector<std::string> arguments;  ///< the first is the path of the executable
  /// Standard output and standard error are appended to this file, and standard input is empty. Without it
  /// the child has those of this process.
  std::string log;
  /// A file descriptor of the child, 1 or 3, whose output read_line() and read_all() return.
  std::optional<int> read_from;
  bool ends_with_parent = false;  ///< SIGTERM when the thread that started it ends
  /// In a session of its own: it outlives this process, and only its output can be followed.
  bool detached = false;
};

class ChildProcess {
 public:
  ChildProcess() = default;  ///< no process
  /// Forks and executes. A program that cannot be executed ends with status 127 and says so on its standard
  /// error. Throws std::runtime_error when the system gives no process.
  explicit ChildProcess(const ChildOptions& options);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  /// Ends a process that runs, as stop() does.
  ~ChildProcess();

  /// 0 when there is none, it has ended or it is detached.
  pid_t pid() const { return pid_; }
  /// The status of waitpid() once it has ended, and from then on.
  std::optional<int> status();
  /// Empty while it runs; then how it ended and the last line of its log, in one line.
  std::string ended();
  void signal(int number) const;
  /// SIGTERM, and SIGKILL when it still runs after `timeout` seconds. Returns when it has ended.
  void stop(double timeout = 3);
  /// SIGKILL. Returns when it has ended.
  void kill();

  /// Of what it writes to `read_from`: the next line without its end, or what comes before the end of it all.
  std::string read_line();
  std::string read_all();

  /// Every thread sleeps and none has run between two looks at them: what the process was sent over the
  /// loopback it has taken. False when that cannot be seen.
  bool sleeps() const;

 private:
  void release();
  std::string name_, log_;
  pid_t pid_ = 0;
  int output_ = -1;
  std::optional<int> status_;
};

}  // namespace trunnion::cluster
