// SPDX-License-Identifier: Apache-2.0
// Ctrl+C in a command that still has to stop axes or a cluster before it ends.
#pragma once

namespace trunnion::cli {

/// While one lives, SIGINT and SIGTERM are only noted, with `hangup` SIGHUP as well.
class InterruptWatch {
 public:
  explicit InterruptWatch(bool hangup = false);
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  static bool requested();

 private:
  bool hangup_;
};

}  // namespace trunnion::cli
