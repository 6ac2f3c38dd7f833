// SPDX-License-Identifier: Apache-2.0
#include "owner.hpp"

#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace trunnion::launcher {

// Debian 12's header of pidfd_open() does not declare it for C++.
Owner::Owner(std::optional<int> pid)
    : owned_(pid.has_value()), process_(pid ? static_cast<int>(syscall(SYS_pidfd_open, *pid, 0)) : -1) {}

Owner::~Owner() {
  if (process_ >= 0) close(process_);
}

bool Owner::ended() const {
  if (!owned_) return false;
  pollfd process{process_, POLLIN, 0};
  return process_ < 0 || poll(&process, 1, 0) > 0;
}

}  // namespace trunnion::launcher
