// The stages of the stream, by number and by name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "contracts/types.hpp"

namespace trunnion::stream {

using idl::stream::Stage;

/// The service that computes `stage`, as machine.yaml calls it.
constexpr const char* stage_name(Stage stage) {
  constexpr const char* names[] = {"channel", "kinematics", "compensation", "gantry"};
  return names[static_cast<std::size_t>(stage)];
}

/// The stage behind the channel that `service` computes; nothing when it is none.
constexpr std::optional<Stage> stage_of(std::string_view service) {
  for (const auto stage : {Stage::KINEMATICS, Stage::COMPENSATION, Stage::GANTRY})
    if (service == stage_name(stage)) return stage;
  return std::nullopt;
}

}  // namespace trunnion::stream
