// SPDX-License-Identifier: Apache-2.0
// The AC trunnion machine of configs/machines with errors drawn by a seed.
#pragma once

#include "identification/geometry_fit.hpp"
#include "identification/improvement.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine.hpp"
#include "machine/yaml.hpp"
#include "truth/random_machine.hpp"

namespace trunnion::identification {

struct DrawnMachine {
  machine::Parameters parameters;
  machine::MachineOutline outline;
  truth::GeometryTruth truth;
  truth::PoseReport report;

  DrawnMachine(const std::string& name, const std::string& grade, std::uint64_t seed)
      : parameters(parameters_of(name)),
        outline(machine::outline_of(parameters, 0)),
        truth(draw(grade, seed, outline)),
        report(truth::make_geometry(truth, outline, name), machine::make_chain(parameters, 0), outline) {
    report.tool_length = 100;
  }

  static machine::Parameters parameters_of(const std::string& name) {
    machine::Parameters p;
    p.values = machine::machine_parameters(
        machine::load_machine(std::string(TRUNNION_SOURCE) + "/configs/machines/" + name));
    return p;
  }
  static truth::GeometryTruth draw(const std::string& name, std::uint64_t seed,
                                   const machine::MachineOutline& outline) {
    for (const auto& grade : truth::grades())
      if (grade.name == name) return truth::draw_machine(grade, seed, outline);
    throw std::runtime_error(name);
  }
};

}  // namespace trunnion::identification
