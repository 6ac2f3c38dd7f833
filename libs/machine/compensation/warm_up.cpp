// SPDX-License-Identifier: Apache-2.0
#include "compensation/warm_up.hpp"

#include <cmath>

namespace trunnion::volumetric {

void WarmUp::step(const HeatSources& sources, const std::array<double, heat_source_count>& speeds,
                  double dt) {
  for (std::size_t i = 0; i < heat_source_count; ++i) {
    const HeatSource& source = sources[i];
    const double final_rise = source.rise_per_speed * std::abs(speeds[i]) + source.constant_rise;
    rise_[i] += dt / (source.time_constant + dt) * (final_rise - rise_[i]);
  }
}

}  // namespace trunnion::volumetric
