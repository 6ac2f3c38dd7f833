// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "motion_analysis/lower_bound.hpp"

namespace trunnion::analysis {

/// Seconds of a whole path.
inline double acceleration_bound(const std::vector<PathSample>& path, const motion::Limits& limits) {
  AccelerationBound bound(limits);
  for (const PathSample& sample : path) bound.add(sample);
  return bound.finish();
}

}  // namespace trunnion::analysis
