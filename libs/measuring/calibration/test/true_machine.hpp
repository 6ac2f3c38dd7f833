// SPDX-License-Identifier: Apache-2.0
// A machine that is `real` while its control believes `model`.
#pragma once

#include <stdexcept>

#include "calibration/evaluation.hpp"
#include "calibration/sphere_check.hpp"
#include "truth/test/outline.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::calibration {

/// A probe with the nominal dimensions of the inputs.
inline touch_probe::TouchProbeTruth nominal(const MeasurementInputs& inputs,
                                            touch_probe::TouchProbeTruth probe = {}) {
  probe.length = inputs.probe_length;
  probe.ball_radius = inputs.ball_diameter / 2;
  return probe;
}
/// A sphere without a shaft.
inline std::vector<touch_probe::Solid> sphere_at(const MeasurementInputs& inputs, const Vec3& centre) {
  return {touch_probe::SphereGauge{centre, inputs.sphere_diameter / 2}};
}

struct TrueMachine {
  machine::MachineOutline outline;
  truth::PoseReport report;
  MeasuredMachine measured;

  TrueMachine(const ChainParameters& real, const ChainParameters& model, const std::string& truth = "{}")
      : outline(wide(real)),
        report(truth::make_geometry(truth::parse_truth(truth, "truth.yaml", outline).geometry, outline,
                                    "truth.yaml"),
               geometry::make(model), outline),
        measured{"test", model, outline} {}

  // Travel is not what these tests are about.
  static machine::MachineOutline wide(const ChainParameters& real) {
    auto machine = truth::outline(real);
    for (std::size_t i = 0; i < 3; ++i) machine.axes[i] = {true, -2000, 2000};
    for (const auto slot : metrology::all_slots)
      if (const auto& axis = axis_at(real, slot))
        machine.axes[3 + axis->angle] =
            axis->angle == 2 ? machine::AxisOutline{true, -1e5, 1e5} : machine::AxisOutline{true, -120, 120};
    return machine;
  }

  KinematicsResult measure(const MeasurementInputs& inputs, const touch_probe::TouchProbeTruth& probe,
                           const Vec3& sphere) const {
    const auto fault = fault_of(inputs, measured);
    if (!fault.empty()) throw std::runtime_error(fault);
    const auto plan = plan_measurement(inputs, measured);
    if (const auto* refused = std::get_if<std::string>(&plan)) throw std::runtime_error(*refused);
    return evaluate(inputs, measured,
                    touch_virtually(report, inputs, measured, std::get<MeasurementPlan>(plan),
                                    nominal(inputs, probe), sphere_at(inputs, sphere)));
  }
};

}  // namespace trunnion::calibration
