// SPDX-License-Identifier: Apache-2.0
// A changed chain as parameters.
#pragma once

#include <map>

#include "machine/parameters.hpp"
#include "metrology/chain_vectors.hpp"

namespace trunnion::calibration {

/// The parameters of `channel` in which `after` differs from `before`: offsets, corrections, directions,
/// chain_origin, chain_open. Throws std::runtime_error when the catalogue refuses a value: number and limits.
std::map<std::uint32_t, machine::ParameterValue> changed_parameters(const metrology::ChainParameters& before,
                                                                    const metrology::ChainParameters& after,
                                                                    std::uint16_t channel);

/// Slots whose correction has a name in the machine's chain: it takes what a measurement finds.
std::array<bool, metrology::slot_count> named_corrections(const machine::Parameters& parameters,
                                                          std::uint16_t channel);

/// The parameter of the first component of offset (or correction) and direction of a slot.
std::uint32_t offset_number(metrology::Slot slot, bool correction, std::uint16_t channel);
std::uint32_t direction_number(metrology::Slot slot, std::uint16_t channel);

}  // namespace trunnion::calibration
