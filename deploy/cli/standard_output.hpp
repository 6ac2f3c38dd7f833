// SPDX-License-Identifier: Apache-2.0
// Who reads what a command prints.
#pragma once

#include <poll.h>
#include <unistd.h>

namespace trunnion::cli {

/// False when the reader of a pipe has gone. A machine at rest sends nothing, so that no write would show it.
inline bool output_is_read() {
  pollfd output{STDOUT_FILENO, 0, 0};
  return poll(&output, 1, 0) < 0 || (output.revents & POLLERR) == 0;
}

}  // namespace trunnion::cli
