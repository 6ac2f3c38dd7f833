// SPDX-License-Identifier: Apache-2.0
// How coarsely the coordinates of a program are rounded.
#pragma once

#include <array>
#include <cstdint>

#include "motion/blended_path.hpp"

namespace trunnion::motion {

/// Step of which the coordinates are multiples; 0: none is known.
struct Grain {
  double linear = 0, rotary = 0;  ///< mm, degrees
};

/// Finds the last decimal of the coordinates of lines as the greatest common divisor of what they change by:
/// that needs neither the words of the program nor their unit, and work offsets do not matter. Coordinates
/// that were rotated or scaled have none.
class Decimals {
 public:
  void clear() {
    groups_ = {};
    newest_ = 0;
  }
  /// The block with this number is the newest; numbers are given in sequence.
  void begin(std::uint64_t number);
  /// It is a line that changes the coordinates by `change`.
  void add(const AxisValues& change);
  /// Of the lines about a number, at least 16 before and 16 behind it as far as they are known. A step far
  /// above the tolerance is no rounding and counts as none.
  Grain about(std::uint64_t number, const BlendRules& rules) const;

 private:
  static constexpr std::uint64_t group_size = 16, groups = 64;
  struct Divisors {
    std::uint64_t linear = 0, rotary = 0;
  };
  std::array<Divisors, groups> groups_{};
  std::uint64_t newest_ = 0;
};

}  // namespace trunnion::motion
