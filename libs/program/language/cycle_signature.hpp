// SPDX-License-Identifier: Apache-2.0
// The arguments of cycles that are called by name: CYCLE1234(1, "text", , 4).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "language/block.hpp"

namespace trunnion::language {

/// Of one cycle: n a number, t a text.
struct CycleSignature {
  std::uint32_t number;
  std::string_view kinds;
};

/// Cycles whose arguments are not all numbers. CYCLE9960: S_MVAR, name of the kinematics, K_PRNUM, then the
/// inputs of its screen (Siemens, "Measuring the kinematics with CYCLE9960", sample programs).
inline constexpr std::array cycle_signatures = {
    CycleSignature{9960, "ntnnnnnnnnnnnnnnnnnnn"},
};
inline constexpr std::string_view any_cycle = "nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn";
static_assert(any_cycle.size() == max_cycle_arguments);

/// What the arguments of cycle `number` are, in their sequence.
constexpr std::string_view cycle_arguments(std::uint32_t number) {
  for (const auto& signature : cycle_signatures)
    if (signature.number == number) return signature.kinds;
  return any_cycle;
}

}  // namespace trunnion::language
