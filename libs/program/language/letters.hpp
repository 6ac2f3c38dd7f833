// SPDX-License-Identifier: Apache-2.0
// Sets of letters of a block.
#pragma once

#include "language/block.hpp"
#include "language/canonical.hpp"

namespace trunnion::language {

constexpr std::uint32_t letter_bits(std::string_view letters) {
  std::uint32_t bits = 0;
  for (const char letter : letters) bits |= Block::bit(letter);
  return bits;
}
inline constexpr std::uint32_t axis_bits = letter_bits(axis_letters);

}  // namespace trunnion::language
