// SPDX-License-Identifier: Apache-2.0
// Mechanics of servo axes drawn by a seed, of a stated grade (grades.yaml).
#pragma once

#include "truth/drive_truth.hpp"
#include "truth/random_machine.hpp"

namespace trunnion::truth {

/// Draws the mechanics of axis `axis` (any number that tells the axes apart). Frequencies stay where the
/// steps of the simulation permit them. `turns`: backlash in deg. The same bits for the same arguments on
/// every host.
MechanicsTruth draw_mechanics(const Grade& grade, std::uint64_t seed, std::uint32_t axis, bool turns);

}  // namespace trunnion::truth
