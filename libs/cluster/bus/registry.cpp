// SPDX-License-Identifier: Apache-2.0
#include "bus/registry.hpp"

namespace trunnion::bus {

const TopicEntry* find_topic(const std::string& name) {
  for (const auto& entry : all_topics())
    if (entry.description.name == name || entry.handle == name) return &entry;
  return nullptr;
}

}  // namespace trunnion::bus
