// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "machine/parameters.hpp"

namespace trunnion::drive {

/// X and Y; 1 mm/cycle is the fastest, 4 m/s2 the acceleration: from 0.1 mm/cycle it takes 25 cycles to stop.
inline machine::Parameters two_axes() {
  machine::Parameters p;
  p.revision = 1;
  p.values[40001] = {0, ""}, p.values[40002] = {1, ""};
  for (std::uint32_t a = 0; a < 2; ++a) {
    p.values[100000 + a * 1000] = {0, a == 0 ? "X" : "Y"};
    p.values[100034 + a * 1000] = {60000, ""};
    p.values[100036 + a * 1000] = {4000, ""};
  }
  return p;
}

}  // namespace trunnion::drive
