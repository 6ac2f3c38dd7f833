// SPDX-License-Identifier: Apache-2.0
#include "bus/contract.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string_view>

namespace trunnion::bus {
namespace {

constexpr std::array<const char*, 4> qos_names{"batch", "state", "event", "history"};  // by QosKind

bool names(const std::vector<std::string>& services, const std::string& service) {
  return std::any_of(services.begin(), services.end(),
                     [&](const std::string& name) { return name == service || name == "all"; });
}

}  // namespace

std::string contract_of(const std::string& service, const std::vector<TopicEntry>& topics) {
  std::vector<std::string> lines;
  for (const auto& topic : topics)
    if (names(topic.writers, service) || names(topic.readers, service))
      lines.push_back(topic.description.name + " " + topic.description.wire_type + " " +
                      qos_names.at(static_cast<std::size_t>(topic.qos)) + "\n");
  std::sort(lines.begin(), lines.end());
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const auto& line : lines)
    for (const char c : line) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3;
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace trunnion::bus
