// A process that is stopped when its owner is done with it.
#pragma once

#include <string>
#include <vector>

namespace trunnion::cluster {

/// The last line of the file `path` that is not empty.
std::string last_line(const std::string& path);

class ChildProcess {
 public:
  /// Standard output and standard error go to `log`. Throws std::runtime_error when there is no such program.
  ChildProcess(std::vector<std::string> arguments, std::string log);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Empty while it runs; then how it ended and what it wrote last, in one line.
  std::string ended();
  /// Every thread sleeps and none has run while this was looked at: what the process was sent over the
  /// loopback it has taken. False when that cannot be seen.
  bool sleeps() const;

 private:
  std::string name_, log_;
  int pid_ = 0;
  std::string how_;
};

}  // namespace trunnion::cluster
