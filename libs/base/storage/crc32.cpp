// SPDX-License-Identifier: Apache-2.0
#include "storage/crc32.hpp"

#include <zlib.h>

namespace trunnion::storage {

// zlib takes a null pointer, which no bytes may have, for the request of the initial value.
std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> bytes) {
  return bytes.empty() ? crc : static_cast<std::uint32_t>(crc32_z(crc, bytes.data(), bytes.size()));
}

std::uint32_t crc32(std::string_view text) {
  return crc32(0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace trunnion::storage
