// SPDX-License-Identifier: Apache-2.0
// Both sides of every gantry as the drive reports them, and what Auto Offset proposes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stream/gantry_synchronization.hpp"

namespace trunnion::stream {

struct GantryReport {
  std::uint16_t channel = 0;
  machine::GantryPair pair;
  std::string master_name, slave_name;
  std::string state;                               ///< in words: coupled, drives off ...
  double master_position = 0, slave_position = 0;  ///< mm; that of the slave as 10a126 shows it
  GantryDifference difference;
  machine::AutoOffset offset;

  /// Auto Offset would change its parameter by 0.1 um at least.
  bool proposes() const;
};

/// By channel. Throws std::runtime_error when the drive does not report an axis of a pair.
std::vector<GantryReport> gantry_reports(const machine::Parameters& parameters,
                                         const idl::stream::Feedback& feedback);

/// A channel moves its axes, or they are homed: Auto Offset takes positions at rest.
bool axes_move(const idl::stream::Feedback& feedback);

}  // namespace trunnion::stream
