// SPDX-License-Identifier: Apache-2.0
// When each message of a recording is to be written again. No DDS, no clock.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "verification/stored_recording.hpp"

namespace trunnion::verification {

struct Due {
  const StoredMessage* message = nullptr;
  double seconds = 0;  ///< after the beginning
};

/// In the order of the writers' clocks; of one batch topic and channel in the order of epochs and cycles,
/// whatever the order the recorder heard them in. What was written before the recording began, states that
/// held then, is due at once. `topics` (handles) are left out when it is not empty and does not name them.
/// `rate` is above 0: 2 is twice as fast.
std::vector<Due> schedule(const StoredRecording& recording, const std::set<std::string>& topics, double rate);
std::vector<Due> schedule(StoredRecording&&, const std::set<std::string>&, double) = delete;

}  // namespace trunnion::verification
