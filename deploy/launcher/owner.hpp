// SPDX-License-Identifier: Apache-2.0
// The command whose cluster this is: a cluster that belongs to one command does not outlive it.
#pragma once

#include <optional>

namespace trunnion::launcher {

class Owner {
 public:
  /// Without a process nobody owns the cluster, and it ends on SIGTERM only.
  explicit Owner(std::optional<int> pid);
  ~Owner();
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;

  /// In whatever way it ended: by SIGKILL and by a closed pipe too.
  bool ended() const;

 private:
  bool owned_;
  int process_ = -1;  ///< a file descriptor of the process; -1 with an owner: it had ended before
};

}  // namespace trunnion::launcher
