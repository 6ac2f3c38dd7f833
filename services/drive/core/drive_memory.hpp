// SPDX-License-Identifier: Apache-2.0
// The content of encoders.bin in the state directory, which DriveService saves.
#pragma once

#include <array>
#include <cstdint>

namespace trunnion::drive {

/// What must survive the process: where the axes are and which cycle is next.
struct Memory {
  static constexpr std::uint32_t magic_value = 0x54524e31;
  struct Channel {
    std::uint32_t epoch = 0, request = 0;
    std::uint32_t begun = 0;  ///< the start of the epoch was seen: a start within it is no old message
  };
  std::uint32_t magic = 0;
  std::uint32_t axes = 0;
  std::uint32_t epoch = 0;  ///< newest of any channel
  std::uint64_t next = 0, tick = 0;
  std::array<double, 32> position{};
  std::array<Channel, 32> channels{};
  std::array<std::uint8_t, 32> homed{};    ///< the position has its reference
  std::array<std::uint16_t, 32> number{};  ///< logical number of each axis
};

}  // namespace trunnion::drive
