// CRC-32 as in zlib, gzip and ISO 3309: reflected polynomial 0xEDB88320, start and final inversion.
#pragma once

#include <cstdint>
#include <span>

namespace trunnion::program {

/// Goes on from `crc` of the bytes before, 0 at the start.
std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> bytes);

}  // namespace trunnion::program
