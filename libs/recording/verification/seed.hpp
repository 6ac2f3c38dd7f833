// SPDX-License-Identifier: Apache-2.0
// The state from which a service is verified: a snapshot of it in the recording. No DDS, no clock.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "snapshot/assembly.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

struct Seed {
  snapshot::Snapshot snapshot;
  std::string refused;      ///< why the service had not given its state when it was asked; empty = it had
  std::uint64_t time = 0;   ///< ns: what the service wrote later is compared
  std::uint64_t until = 0;  ///< ns: from then on another process was the service
  std::uint64_t begin = 0;  ///< ns: when this process was heard of first
  std::map<const bus::TopicEntry*, std::uint64_t> taken;

  /// The service had taken this message, so its effect is in the state.
  bool had_taken(const StoredMessage& message) const;
  /// Written by the service while it was the process of the snapshot and after the snapshot.
  bool covers(const StoredMessage& message) const { return message.time > time && message.time < until; }
  /// What a service has to know before it can continue: parameters, tools, offsets and programs as it had
  /// them. With `older_parameters` also the sets before, the newest last.
  std::vector<const StoredMessage*> needed_to_start(const StoredRecording& recording,
                                                    bool older_parameters) const;
};

/// The snapshots of `instance`, first those after which its process lived longest in the recording. None when
/// the recording was made without snapshots, or the service needs none. Throws std::runtime_error with one
/// line when the service could not give its state during the whole recording.
std::vector<Seed> find_seeds(const StoredRecording& recording, std::uint32_t instance);

}  // namespace trunnion::verification
