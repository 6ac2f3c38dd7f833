// SPDX-License-Identifier: Apache-2.0
// For tests of what other threads and processes do.
#pragma once

#include <chrono>
#include <thread>

namespace trunnion::testing_support {

/// Waits until `condition` holds, asking every millisecond. The limit of a minute only ends a hang.
template <class Condition>
bool eventually(Condition condition) {
  for (int i = 0; i < 60000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace trunnion::testing_support
