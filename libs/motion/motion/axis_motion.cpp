// SPDX-License-Identifier: Apache-2.0
#include "motion/axis_motion.hpp"

#include <algorithm>

namespace trunnion::motion {
AxisValues machine_axes(const AxisValues& position, const geometry::Chain* chain, double tool_length) {
  AxisValues axes = position;
  if (chain == nullptr) return axes;
  const geometry::Vec3 machine = chain->machine_from_tip({position[0], position[1], position[2]},
                                                         geometry::angles_of(position.data()), tool_length);
  std::copy_n(machine.data(), 3, axes.begin());
  return axes;
}

PathRates machine_rates(const AxisValues& position, const PathRates& rates, const geometry::Chain* chain,
                        double tool_length) {
  PathRates result = rates;
  if (chain == nullptr) return result;
  geometry::TipMotion motion;
  const auto take = [&](std::size_t order, const AxisValues& row) {
    motion.tip[order] = {row[0], row[1], row[2]};
    motion.angles[order] = geometry::angles_of(row.data());
  };
  take(0, position);
  for (std::size_t n = 0; n < 3; ++n) take(n + 1, rates[n]);
  const auto machine = chain->machine_derivatives(motion, tool_length);
  for (std::size_t n = 0; n < 3; ++n) std::copy_n(machine[n + 1].data(), 3, result[n].begin());
  return result;
}

}  // namespace trunnion::motion
