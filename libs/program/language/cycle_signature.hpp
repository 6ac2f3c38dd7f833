// SPDX-License-Identifier: Apache-2.0
// The arguments of cycles that are called by name: CYCLE1234(1, "text", , 4).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "language/block.hpp"

namespace trunnion::language {

/// Of one cycle: n a number, t a text, s a text that counts as a number when it is one.
struct CycleSignature {
  std::uint32_t number;
  std::string_view kinds;
  std::uint32_t program;  ///< that it calls
};

/// Cycles whose arguments are not all numbers. CYCLE800: retract, name of the swivel data, status, mode,
/// reference point, three angles, zero behind the rotation, direction, way of the retract, plane; its program
/// has a number that part programs do not have. CYCLE9960: S_MVAR, name of the kinematics, K_PRNUM, then the
/// inputs of its screen (Siemens, "Measuring the kinematics with CYCLE9960", sample programs).
inline constexpr std::uint32_t swivel_cycle = 800;
inline constexpr std::array cycle_signatures = {
    CycleSignature{swivel_cycle, "nsnnnnnnnnnnnnnn", 90800},
    CycleSignature{9960, "ntnnnnnnnnnnnnnnnnnnn", 9960},
};
inline constexpr std::string_view any_cycle = "nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn";
static_assert(any_cycle.size() == max_cycle_arguments);

/// What the arguments of cycle `number` are, in their sequence.
constexpr std::string_view cycle_arguments(std::uint32_t number) {
  for (const auto& signature : cycle_signatures)
    if (signature.number == number) return signature.kinds;
  return any_cycle;
}

/// The program that CYCLE`number` calls.
constexpr std::uint32_t cycle_program(std::uint32_t number) {
  for (const auto& signature : cycle_signatures)
    if (signature.number == number) return signature.program;
  return number;
}

/// Cycles of SINUMERIK that are not here, and what a program writes instead.
struct ForeignCycle {
  std::uint32_t number;
  const char* instead;
};
inline constexpr std::array foreign_cycles = {
    ForeignCycle{81, "write G81 X Y Z R F"},
    ForeignCycle{82, "write G82 X Y Z R P F"},
    ForeignCycle{83, "write G83 X Y Z R Q F"},
    ForeignCycle{84, "write G84 X Y Z R F"},
    ForeignCycle{85, "write G85 X Y Z R F"},
    ForeignCycle{86, "write G76 X Y Z R Q F"},
    ForeignCycle{87, "write G86 X Y Z R P F"},
    ForeignCycle{88, "write G88 X Y Z R P F"},
    ForeignCycle{89, "write G89 X Y Z R P F"},
    ForeignCycle{150, "trunnion calibrate status has the protocol"},
    ForeignCycle{832, "write G5.1 Q1 or Q2, G64 P"},
    ForeignCycle{840, "write G84 X Y Z R F"},
};

/// Nothing when CYCLE`number` may be called.
constexpr const char* instead_of_cycle(std::uint32_t number) {
  for (const auto& foreign : foreign_cycles)
    if (foreign.number == number) return foreign.instead;
  return nullptr;
}

}  // namespace trunnion::language
