// The checksum of MCAP: CRC-32 of ISO 3309 (polynomial 0xEDB88320 reflected, as in zip).
#pragma once

#include <cstdint>
#include <span>

namespace trunnion::recording {

/// Continues `crc`, 0 at the beginning, over `bytes`.
std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> bytes);

}  // namespace trunnion::recording
