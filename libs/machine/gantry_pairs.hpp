// SPDX-License-Identifier: Apache-2.0
// The slave axes of a machine's gantries and the masters they follow (parameters 010050.., 10a100..10a131).
#pragma once

#include <cstdint>
#include <vector>

#include "machine/axes.hpp"

namespace trunnion::machine {

struct GantryPair {
  std::uint16_t master = 0, slave = 0;        ///< logical axis numbers
  double sign = 1;                            ///< -1 when mirrored
  double zero_deviation = 0;                  ///< mm, slave position when the master is at zero
  double rate = 0;                            ///< share of the error corrected in each cycle
  double maximum = 0;                         ///< mm, largest correction
  double warning = 0, limit = 0;              ///< mm, 0 = off
  int master_column = -1, slave_column = -1;  ///< in the drive's feedback

  /// Position of the slave that belongs to a position of the master, mm.
  double slave_position(double master_position) const { return sign * master_position + zero_deviation; }
};

/// Every pair of the machine. Throws std::runtime_error when a slave or its master does not exist.
std::vector<GantryPair> gantry_pairs(const Parameters& parameters);

/// Those whose master is an axis of `channel`.
std::vector<GantryPair> gantry_pairs(const Parameters& parameters, std::uint16_t channel);

/// Whether `axis` moves with `channel`: it is an axis of the channel, or the slave of one. False when the
/// gantry parameters are not valid.
bool axis_moves_with(const Parameters& parameters, std::uint16_t axis, std::uint16_t channel);

}  // namespace trunnion::machine
