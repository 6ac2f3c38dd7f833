// CRC-32 as zlib computes it: reflected polynomial 0xEDB88320, all ones at both ends.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace trunnion::gateway {

class Crc32 {
 public:
  void add(std::span<const std::uint8_t> bytes) {
    for (const auto byte : bytes) state_ = table[(state_ ^ byte) & 0xFF] ^ (state_ >> 8);
  }
  std::uint32_t value() const { return ~state_; }

 private:
  static constexpr auto table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t remainder = i;
      for (int bit = 0; bit < 8; ++bit)
        remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? 0xEDB88320u : 0u);
      made[i] = remainder;
    }
    return made;
  }();
  std::uint32_t state_ = ~0u;
};

}  // namespace trunnion::gateway
