// SPDX-License-Identifier: Apache-2.0
#include "state_keeper.hpp"

namespace trunnion::recorder {

void StateKeeper::see(const Message& message) {
  const auto& topic = *topics_.at(message.topic);
  if (topic.qos != bus::QosKind::state) return;
  bus::KeyHash key{};
  // Bytes that are not of the type have no key; they are in the recording all the same.
  if (topic.description.keyed && !topic.description.key_of(message.cdr, key)) return;
  newest_[{message.topic, key}] = message;
}

std::vector<const Message*> StateKeeper::states() const {
  std::vector<const Message*> result;
  for (const auto& [key, message] : newest_) result.push_back(&message);
  return result;
}

}  // namespace trunnion::recorder
