// SPDX-License-Identifier: Apache-2.0
// Rigid tapping of the NUM dialect: G84 with the lead K.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "language/block_context.hpp"

namespace trunnion::language {

class NumTapping : private BlockHandler {
 public:
  explicit NumTapping(BlockContext& context) : BlockHandler(context) {}

  /// Whether the cycle of a block, which is not G80, is this one: that of NUM is the only one with its lead
  /// in K.
  bool active() const { return words_.lead_word() == 'K'; }
  /// Such a block: the whole tap. Behind G84 no axis word may come without a G function of motion or G80.
  Fault run();

 private:
  /// Levels are program coordinates of the axis, mm.
  struct Tap {
    std::size_t axis = 0;
    double depth = 0;
    double start = 0;                ///< where the spindle is coupled, and the tap comes out
    std::optional<double> approach;  ///< passed in rapid before and behind
    double lead = 0;                 ///< mm per revolution, above zero
    double retract_speed = 0;        ///< 1/min; 0 = S
  };
  Fault read(std::uint16_t at, Tap& tap);
  Fault read_levels(std::uint16_t at, Tap& tap);
  Fault read_retract(Tap& tap);
  double level(char word, std::size_t axis);
  bool stops_spindle() const;
  Fault rapid_to(const Tap& tap, double to);
  Fault stroke_to(const Tap& tap, double to, double lead, double speed);
};

}  // namespace trunnion::language
