// SPDX-License-Identifier: Apache-2.0
// What `channel status` says of the spindles of the machine.
#pragma once

#include <string>
#include <vector>

#include "bus/json.hpp"
#include "contracts/types.hpp"
#include "machine/axes.hpp"

namespace trunnion::cli {

struct SpindleStatus {
  std::string name;
  idl::stream::SpindleState state;
  double speed = 0;    // 1/min, measured
  std::string master;  // name of the spindle it follows; empty = none

  /// With the units in the names.
  bus::Json json() const;
  std::string line() const;
};

/// Of the spindles of the machine, in the order of their logical numbers, those that the feedback has.
std::vector<SpindleStatus> spindle_status(const std::vector<machine::AxisInfo>& spindles,
                                          const idl::stream::Feedback& feedback);

}  // namespace trunnion::cli
