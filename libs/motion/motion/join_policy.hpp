// SPDX-License-Identifier: Apache-2.0
// Whether motion runs through a join of two segments on a rounding or stops there.
#pragma once

#include "motion/blended_path.hpp"
#include "motion/limits.hpp"

namespace trunnion::motion {

/// True when stopping at the start of `block`, which follows `before` on the path, is right: the join must be
/// exact or running through its rounding would take longer than stopping. An estimate from the frame of the
/// command; what follows from it is exact. The join of `block` must have been rated.
bool stops_at_join(const PathBlock& before, const PathBlock& block, const Limits& limits);

}  // namespace trunnion::motion
