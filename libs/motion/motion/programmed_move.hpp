// SPDX-License-Identifier: Apache-2.0
// One command as motion takes it, before it joins the path.
#pragma once

#include <optional>

#include "motion/limits.hpp"
#include "motion/path_segment.hpp"

namespace trunnion::motion {

struct ProgrammedMove {
  PathSegment path;     ///< without length in a dwell
  double feed = 0;      ///< at override 1, unit of the path per second; has no meaning in a rapid
  int wait_cycles = 0;  ///< of a dwell
};

/// What is left of the rapid, line, arc or dwell `command`, from `from`, when `fraction` (0..1) of it is
/// done. Nothing when the kind is another or the numbers make no move: not finite, feed or sweep not above 0,
/// an axis without limits above 0, a dwell that is too long. `transformed`: X Y Z of the command are those of
/// the tool tip, and any axis of the machine may move for them.
std::optional<ProgrammedMove> programmed_move(const canonical::Command& command, const AxisValues& from,
                                              double fraction, const Limits& limits, bool transformed,
                                              double cycle_seconds);

}  // namespace trunnion::motion
