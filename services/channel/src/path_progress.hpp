// SPDX-License-Identifier: Apache-2.0
// How far a channel's path was planned, written and executed.
#pragma once

#include <cstdint>

#include "language/canonical.hpp"

namespace trunnion::channel {

using language::AxisValues;

/// A setpoint that was written, for the display when it is executed.
struct WrittenSetpoint {
  std::uint64_t cycle = ~0ull;
  std::uint32_t line = 0;
  double feed = 0;  ///< mm/s or degrees/s along the path
  AxisValues distance_to_go{};
  AxisValues position{};  ///< of the path, in its frame
  AxisValues machine{};   ///< the same in machine coordinates, when an axis is locked or offset
  bool rapid = false;
  std::uint32_t sequence = 0;
};

/// A point of a program's path, as a restart needs it.
struct PathPoint {
  std::uint32_t sequence = 0, line = 0;
  double fraction = 0;  ///< of the command that is done
};

struct PathProgress {
  PathPoint point;            ///< that the newest setpoint has reached
  WrittenSetpoint executed;   ///< the newest that the drive has executed
  std::uint32_t reached = 0;  ///< command that is carried out with the axes at rest
};

}  // namespace trunnion::channel
