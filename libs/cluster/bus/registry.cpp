// SPDX-License-Identifier: Apache-2.0
#include "bus/registry.hpp"

#include "bus/former_names.hpp"

namespace trunnion::bus {

const TopicEntry* find_topic(const std::string& name) {
  const auto today = with_names_of_today(name);
  for (const auto& entry : all_topics())
    if (entry.description.name == today || entry.handle == today) return &entry;
  return nullptr;
}

}  // namespace trunnion::bus
