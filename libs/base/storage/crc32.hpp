// SPDX-License-Identifier: Apache-2.0
// CRC-32 of zlib, as in gzip, MCAP and ISO 3309: reflected polynomial 0xEDB88320, start and final inversion.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace trunnion::storage {

/// Continues from `crc` of the bytes before, 0 at the start.
std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> bytes);

/// Of a whole text.
std::uint32_t crc32(std::string_view text);

}  // namespace trunnion::storage
