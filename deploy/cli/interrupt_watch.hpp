// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trunnion::cli {

/// While one lives, SIGINT and SIGTERM are only noted.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  static bool requested();
};

}  // namespace trunnion::cli
