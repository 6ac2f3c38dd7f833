// SPDX-License-Identifier: Apache-2.0
// What the calibrate commands have in common: the machine, and where changed vectors go.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "calibration/measurement_inputs.hpp"
#include "commands.hpp"
#include "true_machine.hpp"

namespace CLI {
class App;
}

namespace trunnion::cli {

struct CalibrationTarget {
  std::string machine;  ///< as the command line names it
  std::uint16_t channel = 0;
  std::vector<std::string> set;
  std::string output;    ///< file for the changed parameters
  bool write = false;    ///< into the cluster that runs
  bool running = false;  ///< the cluster that runs makes the measurement
};

/// The options of CalibrationTarget.
void add_target_options(CLI::App& command, CalibrationTarget& target);

/// The machine of the directory; with `write` or `running` the control's model is that of the cluster that
/// runs, which must be of this machine. Throws std::runtime_error.
TrueMachine load_calibrated_machine(const CalibrationTarget& target, const Common& common);
calibration::MeasuredMachine measured_machine(const TrueMachine& machine, std::uint16_t channel);

/// Writes changed parameters into the cluster, or throws.
using ChangeWriter = std::function<void(const std::map<std::uint32_t, machine::ParameterValue>& values)>;
/// Writes what has changed into file or cluster, in one activation, and says so on standard output (not with
/// --json). `writer`: in place of an import by the parameters service. 0 or throws.
int write_change(const CalibrationTarget& target, const Common& common,
                 const calibration::ChainParameters& before, const calibration::ChainParameters& after,
                 const ChangeWriter& writer = {});

void add_calibrate_kinematics(CLI::App& calibrate, Common& common);
void add_calibrate_manual(CLI::App& calibrate, Common& common);
void add_calibrate_measurement(CLI::App& calibrate, Common& common);

/// "X,Y,Z" in mm. Throws std::runtime_error that names the option.
truth::Vec3 vector_option(const std::string& option, const std::string& text);

}  // namespace trunnion::cli
