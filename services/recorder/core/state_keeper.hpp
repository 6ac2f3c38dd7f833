// SPDX-License-Identifier: Apache-2.0
// The newest message of every key of the state topics, and the drive's newest feedback: what a late joiner
// would be given, and so what a recording that begins in the middle has to begin with.
#pragma once

#include <deque>
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
  /// In the order of topics and keys; then the feedback.
  std::vector<const Message*> states() const;

 private:
  const std::vector<const bus::TopicEntry*>& topics_;
  void see_feedback(const Message& message);

  std::map<std::pair<std::uint16_t, bus::KeyHash>, Message> newest_;
  struct Feedback {
    Message message;
    std::uint32_t rows = 0;
  };
  std::deque<Feedback> feedback_;
  std::uint64_t rows_ = 0;
};

}  // namespace trunnion::recorder
