// SPDX-License-Identifier: Apache-2.0
#include "calibration/virtual_gauges.hpp"

#include <algorithm>
#include <variant>

namespace trunnion::calibration {

touch_probe::TouchProbeTruth true_probe(const truth::Truth& truth, const MeasurementInputs& inputs,
                                        const GaugeChanges& changes) {
  touch_probe::TouchProbeTruth probe;
  probe.length = inputs.probe_length, probe.ball_radius = inputs.ball_diameter / 2;
  if (truth.probe) probe = *truth.probe;
  if (changes.repeatability) probe.repeatability = *changes.repeatability;
  if (changes.pre_travel) probe.pre_travel = *changes.pre_travel;
  if (changes.lobing) probe.lobing = *changes.lobing;
  if (changes.seed) probe.seed = *changes.seed;
  return probe;
}

std::vector<touch_probe::Solid> true_solids(const truth::Truth& truth, const MeasurementInputs& inputs,
                                            const GaugeChanges& changes) {
  auto solids = truth.solids;
  const auto first = std::find_if(solids.begin(), solids.end(), [](const auto& solid) {
    return std::holds_alternative<touch_probe::SphereGauge>(solid);
  });
  auto& sphere = std::get<touch_probe::SphereGauge>(
      first == solids.end()
          ? solids.emplace_back(touch_probe::SphereGauge{inputs.sphere, inputs.sphere_diameter / 2})
          : *first);
  if (changes.sphere) sphere.centre = *changes.sphere;
  return solids;
}

}  // namespace trunnion::calibration
