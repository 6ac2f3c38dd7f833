// SPDX-License-Identifier: Apache-2.0
#include "storage/crc32.hpp"

#include <gtest/gtest.h>

#include <string>

namespace trunnion::storage {
namespace {

TEST(Crc32, GivesThePublishedCheckValue) {
  // The check value of CRC-32/ISO-HDLC in the catalogue of parametrised CRC algorithms.
  EXPECT_EQ(crc32("123456789"), 0xCBF43926u);
  EXPECT_EQ(crc32(""), 0u);
  EXPECT_EQ(crc32(0xCBF43926u, {}), 0xCBF43926u) << "no bytes more";
}

TEST(Crc32, IsTheRemainderOfThePolynomialForEveryLengthAndEverySplit) {
  std::string text;
  for (int i = 0; i < 40; ++i) text += static_cast<char>(i * 37 + 11);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  for (std::size_t size = 0; size <= text.size(); ++size) {
    // The definition: one bit at a time, the remainder inverted at both ends.
    std::uint32_t remainder = ~0u;
    for (std::size_t i = 0; i < size; ++i) {
      remainder ^= bytes[i];
      for (int bit = 0; bit < 8; ++bit)
        remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? 0xEDB88320u : 0u);
    }
    for (std::size_t split = 0; split <= size; ++split)
      ASSERT_EQ(crc32(crc32(0, {bytes, split}), {bytes + split, size - split}), ~remainder)
          << size << " bytes, split at " << split;
  }
}

}  // namespace
}  // namespace trunnion::storage
