// SPDX-License-Identifier: Apache-2.0
#include "storage/crc32.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace trunnion::storage {
namespace {

using Table = std::array<std::uint32_t, 256>;

/// Table k advances a byte over k further zero bytes, so that eight bytes need eight independent look-ups.
constexpr std::array<Table, 8> make_tables() {
  std::array<Table, 8> tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? (c >> 1) ^ 0xEDB88320u : c >> 1;
    tables[0][i] = c;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t i = 0; i < 256; ++i)
      tables[k][i] = (tables[k - 1][i] >> 8) ^ tables[0][tables[k - 1][i] & 255];
  return tables;
}

constexpr auto tables = make_tables();
static_assert(std::endian::native == std::endian::little);

}  // namespace

std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> bytes) {
  std::uint32_t c = ~crc;
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint32_t low = 0, high = 0;
    std::memcpy(&low, bytes.data() + i, 4);
    std::memcpy(&high, bytes.data() + i + 4, 4);
    low ^= c;
    c = tables[7][low & 255] ^ tables[6][(low >> 8) & 255] ^ tables[5][(low >> 16) & 255] ^
        tables[4][low >> 24] ^ tables[3][high & 255] ^ tables[2][(high >> 8) & 255] ^
        tables[1][(high >> 16) & 255] ^ tables[0][high >> 24];
  }
  for (; i < bytes.size(); ++i) c = (c >> 8) ^ tables[0][(c ^ bytes[i]) & 255];
  return ~c;
}

std::uint32_t crc32(std::string_view text) {
  return crc32(0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace trunnion::storage
