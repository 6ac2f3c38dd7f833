// SPDX-License-Identifier: Apache-2.0
// Other processes, by their numbers.
#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace trunnion::drive {

inline constexpr const char* session_process = "trunnion-hal-se";  // as Linux shortens it
inline constexpr const char* real_time_process = "rtapi_app";

/// What the process is called; empty when there is none with this number, or one that has ended and was not
/// waited for.
inline std::string process_name(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  std::getline(file, line);
  const auto open = line.find('('), close = line.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close + 2 >= line.size()) return "";
  return line[close + 2] == 'Z' ? "" : line.substr(open + 1, close - open - 1);
}

/// A descriptor that is readable once the process has ended; -1 when it has ended already.
inline int process_descriptor(int pid) { return static_cast<int>(syscall(SYS_pidfd_open, pid, 0)); }

}  // namespace trunnion::drive
