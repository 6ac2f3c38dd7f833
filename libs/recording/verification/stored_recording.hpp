// SPDX-License-Identifier: Apache-2.0
// A recording in memory, its topics matched with the contract this program was built with.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "bus/registry.hpp"
#include "recording/mcap_reader.hpp"

namespace trunnion::verification {

struct StoredMessage {
  const bus::TopicEntry* topic = nullptr;
  std::uint64_t time = 0;      ///< ns since the epoch, the writer's clock
  std::uint32_t sequence = 0;  ///< of the topic, from 1
  bus::Bytes cdr;
};

struct StoredRecording {
  std::vector<StoredMessage> messages;  ///< in the order of the file; only of known topics and types
  std::map<std::string, std::string> metadata;
  std::set<std::string> foreign;           ///< topics this contract does not have, or has with another type
  bool complete = false;                   ///< the file has its end
  std::string problem;                     ///< why it is not complete, one line
  std::vector<recording::Damage> damages;  ///< what of the file could not be read
};

enum class Known { same, other_type, unknown_topic };

/// Whether this program's contract has the topic with exactly the recorded type; `entry` is set when it does.
Known known_topic(const recording::Channel& channel,
                  const std::map<std::uint16_t, recording::Schema>& schemas, const bus::TopicEntry*& entry);

/// Every whole chunk. With `topics` (handles or names) only those.
StoredRecording load_recording(recording::Source& source, const std::set<std::string>& topics = {});
/// The same from a file; throws std::runtime_error naming it when it cannot be opened or is no recording.
StoredRecording load_recording(const std::string& path, const std::set<std::string>& topics = {});

}  // namespace trunnion::verification
