// The stages of the stream, by number and by name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace trunnion::stream {

inline constexpr std::uint8_t stage_channel = 1, stage_kinematics = 2, stage_compensation = 3,
                              stage_gantry = 4;

/// The service that computes `stage`, as machine.yaml calls it.
inline const char* stage_name(std::uint8_t stage) {
  constexpr const char* names[] = {"channel", "kinematics", "compensation", "gantry"};
  return stage >= stage_channel && stage <= stage_gantry ? names[stage - stage_channel] : "unknown";
}

/// The number of the stage that `service` computes, 0 when it is none of kinematics, compensation, gantry.
inline std::uint8_t stage_of(std::string_view service) {
  for (std::uint8_t stage = stage_kinematics; stage <= stage_gantry; ++stage)
    if (service == stage_name(stage)) return stage;
  return 0;
}

}  // namespace trunnion::stream
