// SPDX-License-Identifier: Apache-2.0
// A way of the axes between two positions on which no bodies meet. OMPL is behind this file.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "collision/collision_model.hpp"

namespace trunnion::collision {

struct SearchOptions {
  std::uint64_t seed = 1;
  std::size_t most_samples = 20000;  ///< of the search; then there is no way
  std::size_t shortcuts = 150;       ///< trials to shorten the way
  std::size_t smoothing = 2;         ///< rounds in which corners are cut off
};

/// Positions of the axes from start to end; between two of them every axis goes evenly. A direct move is
/// taken where it is free, then one by an end of the travel of a linear axis, then one that RRT-Connect
/// (Kuffner and LaValle, 2000) finds in the space of the axes, shortened and with its corners cut off. Every
/// move is checked continuously with the clearance of the model. The same inputs give the same way. An error
/// is one line: which bodies, where, and that it is the start, the end, or that no way was found.
std::variant<std::vector<AxisPosition>, std::string> find_way(const CollisionModel& model,
                                                              const Travel& travel, const AxisPosition& from,
                                                              const AxisPosition& to,
                                                              const SearchOptions& options = {});

}  // namespace trunnion::collision
