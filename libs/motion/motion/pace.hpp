// SPDX-License-Identifier: Apache-2.0
// Changes of speed where the path is curved: step by step, with what the axes permit at each place.
#pragma once

#include "motion/axis_limits.hpp"
#include "motion/phase_list.hpp"

namespace trunnion::motion {

/// Caps on a change of speed.
struct Pacing {
  double acceleration = 1e9, jerk = 1e12;  ///< lower ones where a place ahead permits less
  double ramp_down = 1.0;  ///< share of the jerk here that is assumed available for reducing the acceleration
};

struct PacePhase {
  double time = 0, jerk = 0;
  bool ramping_down = false;  ///< the acceleration ends with the change of speed
};

/// The next phase, at most `time` long, of the change to the speed `target`: jerk to the limit, the
/// acceleration that the axes permit, and jerk back so that it ends at the target. A phase of time 0 when the
/// axes allow nothing. `ramping_down`: the phase before did.
PacePhase next_phase(const PathState& state, const CellRing& cells, std::uint64_t cell, double target,
                     double time, const Pacing& pacing, bool ramping_down);

/// Why braking could not be followed to its end.
enum class Braked : std::uint8_t {
  yes,
  beyond,   ///< it would run over a stop or the end of the cells
  blocked,  ///< an axis would exceed its limits on the cell it ended at
};

/// Where braking ended.
struct BrakeEnd {
  Braked result = Braked::yes;
  PathState state;
  std::uint64_t cell = 0;
};

/// Brakes from `state` on `cell` to `target` in steps of `step` seconds and appends the phases, which are
/// proved to keep every limit as far as they go.
BrakeEnd brake(const PathState& state, const CellRing& cells, std::uint64_t cell, double target, double step,
               const Pacing& pacing, PhaseList& phases);

}  // namespace trunnion::motion
