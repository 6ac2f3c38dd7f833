// SPDX-License-Identifier: Apache-2.0
// Mechanics of servo axes drawn by a seed, of a stated grade (grades.yaml).
#pragma once

#include <map>
#include <string>

#include "truth/drive_truth.hpp"
#include "truth/random_machine.hpp"

namespace trunnion::truth {

/// The mechanics of every servo axis of `machine`, by its name. The same bits for the same arguments on every
/// host.
std::map<std::string, DriveTruth> draw_drives(const Grade& grade, std::uint64_t seed,
                                              const machine::MachineOutline& machine);

/// The beam of a gantry that moves along linear axis `axis` (0 .. 2): its misalignment, and the vibration of
/// one side against the other. Its feet are at the ends of the travel of the axis across it (X, or Y of a
/// gantry along X).
BeamTruth draw_beam(const Grade& grade, std::uint64_t seed, const machine::MachineOutline& machine,
                    std::size_t axis);

}  // namespace trunnion::truth
