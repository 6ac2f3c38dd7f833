// SPDX-License-Identifier: Apache-2.0
// The services of a machine, from services.yaml.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "machine/service_constants.hpp"

namespace trunnion::machine {

/// Null when no service has that name.
constexpr const ServiceDefinition* find_service(std::string_view name) {
  for (const auto& definition : service::all)
    if (name == definition.name) return &definition;
  return nullptr;
}

/// The stages that compute from another's output, in the order of the stream.
inline std::vector<std::string> transforming_stages() {
  std::vector<std::string> names;
  for (const auto& stage : service::stages)
    if (stage.transforms()) names.emplace_back(stage.name);
  return names;
}

}  // namespace trunnion::machine
