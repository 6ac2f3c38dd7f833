// SPDX-License-Identifier: Apache-2.0
// The newest message of every key of the state topics: what a late joiner would be given, and so what a
// recording that begins in the middle has to begin with.
#pragma once

#include <map>
#include <vector>

#include "bus/registry.hpp"
#include "message_queue.hpp"

namespace trunnion::recorder {

class StateKeeper {
 public:
  /// `topics`: by the number that messages name. It must outlive the keeper.
  explicit StateKeeper(const std::vector<const bus::TopicEntry*>& topics) : topics_(topics) {}

  /// Keeps the message in place of the older one of its key; of a topic that keeps no state, nothing.
  void see(const Message& message);
  /// In the order of topics and keys.
  std::vector<const Message*> states() const;

 private:
  const std::vector<const bus::TopicEntry*>& topics_;
  std::map<std::pair<std::uint16_t, bus::KeyHash>, Message> newest_;
};

}  // namespace trunnion::recorder
