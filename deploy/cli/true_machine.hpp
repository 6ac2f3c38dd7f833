// SPDX-License-Identifier: Apache-2.0
// A machine of the command line with its truth.yaml.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "truth/pose_report.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::cli {

struct TrueMachine {
  std::string name;
  machine::MachineOutline outline;
  truth::Truth truth;
  machine::Parameters model;  ///< of the control: as delivered, with the settings
  std::unique_ptr<truth::PoseReport> report;
};

/// The report has the volumetric compensation of the parameters when they have one.
/// `settings`: NAME=VALUE of the truth (location errors, temperature rises) or of the control's model. Throws
/// std::runtime_error.
TrueMachine load_true_machine(const std::string& machine, std::uint16_t channel,
                              const std::vector<std::string>& settings);

/// Whether the machine's directory has a truth.yaml.
bool has_truth(const std::string& machine);

/// The instrument of this name in truth.yaml; without an entry an exact one.
truth::InstrumentTruth instrument(const TrueMachine& machine, const std::string& name);

/// X,Y,Z in mm. Throws std::runtime_error that names the option.
truth::Vec3 coordinates(const std::string& option, const std::string& text);

}  // namespace trunnion::cli
