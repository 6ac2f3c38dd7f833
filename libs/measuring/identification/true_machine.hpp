// SPDX-License-Identifier: Apache-2.0
// A machine by its folder, with the errors of its truth.yaml.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "truth/pose_report.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::identification {

struct TrueMachine {
  std::string name;
  machine::MachineOutline outline;
  truth::Truth truth;
  machine::Parameters model;  ///< of the control: as delivered, with the settings
  std::unique_ptr<truth::PoseReport> report;
};

/// The report has the volumetric compensation of the parameters when they have one. Without truth.yaml the
/// machine has no errors. `settings`: NAME=VALUE of the truth (location errors, temperature rises) or of the
/// control's model. Throws std::runtime_error.
TrueMachine load_true_machine(const std::string& directory, std::uint16_t channel,
                              const std::vector<std::string>& settings);

/// From now on the control's model is that of `parameters`, without a compensation; temperatures and length
/// of the tool stay. Throws machine::KinematicsError.
void take_model(TrueMachine& machine, const machine::Parameters& parameters, std::uint16_t channel);

/// The instrument of this name in truth.yaml; without an entry an exact one.
truth::InstrumentTruth instrument(const TrueMachine& machine, const std::string& name);

}  // namespace trunnion::identification
