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

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("cycle", self.cycle), visit("line", self.line), visit("feed", self.feed);
    visit("distance_to_go", self.distance_to_go), visit("position", self.position);
    visit("machine", self.machine), visit("rapid", self.rapid), visit("sequence", self.sequence);
  }
};

/// A point of a program's path, as a restart needs it.
struct PathPoint {
  std::uint32_t sequence = 0, line = 0;
  double fraction = 0;  ///< of the command that is done

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("sequence", self.sequence), visit("line", self.line), visit("fraction", self.fraction);
  }
};

struct PathProgress {
  PathPoint point;            ///< that the newest setpoint has reached
  WrittenSetpoint executed;   ///< the newest that the drive has executed
  std::uint32_t reached = 0;  ///< command that is carried out with the axes at rest

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("point", self.point), visit("executed", self.executed), visit("reached", self.reached);
  }
};

}  // namespace trunnion::channel
