// SPDX-License-Identifier: Apache-2.0
// The drive's end of a HAL session: a process of its own (session_main.cpp) that loads the .hal file,
// outlives a drive that is killed, so that HAL can brake and switch off, and ends HAL when the cluster ends.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::drive {

class HalSession {
 public:
  struct Options {
    std::string program;       ///< path of trunnion-hal-session
    std::string file;          ///< the .hal file
    std::uint32_t domain = 0;  ///< DDS domain of the cluster
    int watched_pid = 0;       ///< the session ends with this process
  };
  /// Finds the session of an earlier process of this drive, or starts one, and waits until HAL runs. Throws
  /// std::runtime_error with the reason, the last line HAL has printed.
  explicit HalSession(const Options& options);
  ~HalSession();
  HalSession(const HalSession&) = delete;
  HalSession& operator=(const HalSession&) = delete;

  /// Of this session and no other: positions and references of another one are void.
  const std::string& identity() const { return identity_; }
  /// Which of its processes has ended, null while all run. Cyclic: one system call.
  const char* ended() const;
  /// Ends HAL and waits until it has ended, at most 1.8 s.
  void end();

 private:
  bool ready() const;
  int start(const std::vector<std::string>& arguments) const;
  void wait_until_ready(int child);
  void watch();

  std::string program_, directory_;
  std::string identity_;
  std::array<int, 2> descriptors_{-1, -1};  // of the session's process and of rtapi_app
};

/// Files of the session of a domain; gone when it has ended.
std::string hal_session_directory(std::uint32_t domain);
/// The process of the session in `directory`, 0 when none runs.
int hal_session_process(const std::string& directory);

}  // namespace trunnion::drive
