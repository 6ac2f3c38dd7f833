// SPDX-License-Identifier: Apache-2.0
// The stages of the stream: enum Stage of the contracts, and their names in the registry of services.
#pragma once

#include <iterator>
#include <optional>
#include <string_view>

#include "contracts/types.hpp"
#include "machine/services.hpp"

namespace trunnion::stream {

using idl::stream::Stage;

static_assert(std::size(machine::service::stages) == bus::enum_size<Stage>(),
              "enum Stage of idl/stream.idl and the stages of libs/machine/machine/services.yaml differ");

/// The service that computes `stage`, as machine.yaml calls it.
constexpr const char* stage_name(Stage stage) {
  const auto index = static_cast<std::size_t>(stage);
  return index < std::size(machine::service::stages) ? machine::service::stages[index].name : "unknown";
}

/// The stage of this row of the registry, which must be one.
constexpr Stage stage_of(const machine::ServiceDefinition& definition) {
  return static_cast<Stage>(definition.stage - 1);
}

/// The stage that `service` computes from another's output; nothing when it computes none.
constexpr std::optional<Stage> stage_of(std::string_view service) {
  const auto* definition = machine::find_service(service);
  if (definition == nullptr || !definition->transforms()) return std::nullopt;
  return stage_of(*definition);
}

}  // namespace trunnion::stream
