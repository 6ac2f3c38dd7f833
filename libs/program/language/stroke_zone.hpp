// SPDX-License-Identifier: Apache-2.0
// The zone that a program forbids (G22).
#pragma once

#include <array>

#include "language/canonical.hpp"

namespace trunnion::language {

/// A box in machine coordinates of the control point, mm.
struct StrokeZone {
  bool active = false;
  bool outside = false;           ///< the axes may be in the box alone; otherwise nowhere in it
  std::array<bool, 3> bounded{};  ///< X Y Z have limits; the box goes on for ever along the others
  Vector3 low{}, high{};          ///< of those that have
};

}  // namespace trunnion::language
