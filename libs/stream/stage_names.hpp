// The stages of the stream, by number and by name.
#pragma once

#include <cstdint>
#include <iterator>
#include <string_view>

#include "machine/services.hpp"

namespace trunnion::stream {

inline constexpr std::uint8_t stage_channel = machine::service::channel.stage,
                              stage_kinematics = machine::service::kinematics.stage,
                              stage_compensation = machine::service::compensation.stage,
                              stage_gantry = machine::service::gantry.stage;

/// The service that computes `stage`, as machine.yaml calls it.
inline const char* stage_name(std::uint8_t stage) {
  return stage > 0 && stage <= std::size(machine::service::stages) ? machine::service::stages[stage - 1].name
                                                                   : "unknown";
}

/// The number of the stage that `service` computes from another's output, 0 when it computes none.
inline std::uint8_t stage_of(std::string_view service) {
  const auto* definition = machine::find_service(service);
  return definition != nullptr && definition->transforms() ? definition->stage : std::uint8_t{0};
}

}  // namespace trunnion::stream
