// SPDX-License-Identifier: Apache-2.0
// How a rotary axis goes to an absolute position.
#pragma once

#include <cmath>
#include <cstdint>

namespace trunnion::canonical {

/// Parameter 10a949. An axis that counts modulo 360 turns without end.
enum class RotaryWay : std::uint8_t {
  linear,    ///< to the angle itself, back over every turn
  shortest,  ///< modulo 360 by the shorter way, half a turn in the positive direction
  by_sign,   ///< modulo 360: the sign of the word is the direction, its amount the angle
};

/// Where the axis at `position` goes for the absolute `word`, both in degrees and in the same coordinates.
inline double rotary_target(RotaryWay way, double word, double position) {
  // Degrees. A position that is reached within slack is no turn away: words have few digits.
  constexpr double turn = 360, slack = 1e-4;
  if (way == RotaryWay::linear) return word;
  if (way == RotaryWay::shortest) return word + turn * std::floor((position - word) / turn + 0.5);
  const double angle = std::abs(word);
  return std::signbit(word) ? angle + turn * std::floor((position - angle + slack) / turn)
                            : angle + turn * std::ceil((position - angle - slack) / turn);
}

/// The word that brings the axis from `position` to `target`, less than a turn away (shortest: less than half
/// a turn), both in degrees and in the same coordinates.
inline double rotary_word(RotaryWay way, double target, double position) {
  if (way != RotaryWay::by_sign) return target;
  const double angle = target - 360 * std::floor(target / 360);
  return target < position ? -angle : angle;
}

/// `position` as it is shown: 0 up to 360 where the axis counts modulo 360.
inline double shown_angle(RotaryWay way, double position) {
  if (way == RotaryWay::linear) return position;
  const double angle = position - 360 * std::floor(position / 360);
  return angle < 360 ? angle : 0;
}

}  // namespace trunnion::canonical
