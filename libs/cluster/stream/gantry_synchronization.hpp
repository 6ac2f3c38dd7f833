// SPDX-License-Identifier: Apache-2.0
// What differs between the sides of a gantry, and which limits it exceeds.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "machine/alarm_definition.hpp"
#include "machine/gantry_pairs.hpp"

namespace trunnion::stream {

/// The part of each slave's offset from its master that the compensation of the two axes accounts for, mm,
/// from the state of the gantry stage of a channel with `pairs` pairs: 0 for each when no slave is
/// compensated.
std::vector<double> compensated_offsets(std::size_t pairs, std::span<const double> state);

/// Slave less master, in the coordinates of the slave.
struct GantryDifference {
  double position = 0;  ///< mm, without what compensation accounts for
  double speed = 0;     ///< mm/min
  double current = 0;   ///< A
};

/// False in an emergency stop and while the slave is taken off: then nothing is compared.
bool is_coupled(const machine::GantryPair& pair, const idl::stream::Feedback& feedback);

/// `offset` mm: what the compensation of both axes accounts for. The feedback must have the pair's columns.
GantryDifference gantry_difference(const machine::GantryPair& pair, const idl::stream::Feedback& feedback,
                                   double offset);

struct GantryFinding {
  const machine::AlarmDefinition* alarm = nullptr;
  std::optional<std::string> text;  ///< nothing: the limit is kept or off
};
/// The limits of position, speed and current, in this order.
std::vector<GantryFinding> gantry_findings(const machine::GantryPair& pair,
                                           const GantryDifference& difference);

}  // namespace trunnion::stream
