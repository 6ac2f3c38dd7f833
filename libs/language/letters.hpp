// SPDX-License-Identifier: Apache-2.0
// Sets of letters of a block.
#pragma once

#include "language/block.hpp"
#include "language/canonical.hpp"

namespace trunnion::language {

constexpr std::uint32_t letter_bits(const char* letters) {
  std::uint32_t bits = 0;
  for (; *letters != '\0'; ++letters) bits |= Block::bit(*letters);
  return bits;
}
inline constexpr std::uint32_t axis_bits = letter_bits(axis_letters);

}  // namespace trunnion::language
