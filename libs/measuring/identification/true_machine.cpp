// SPDX-License-Identifier: Apache-2.0
#include "identification/true_machine.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "compensation/model_parameters.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine.hpp"
#include "machine/parameter_setting.hpp"
#include "machine/yaml.hpp"
#include "text/quantity.hpp"

namespace trunnion::identification {
namespace {

double number_of(const std::string& setting, const std::string& text, double most) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  if (used != text.size() || text.empty() || !(std::abs(value) <= most))
    throw std::runtime_error("--set " + setting + ": expected a number within " + text::quantity(-most) +
                             " .. " + text::quantity(most));
  return value;
}

// A location error or a temperature; false when it is another setting.
bool apply_truth_setting(truth::GeometryTruth& truth, truth::Temperatures& temperatures,
                         const machine::MachineOutline& outline, const std::string& setting) {
  const auto equals = std::min(setting.find('='), setting.size());
  const auto name = setting.substr(0, equals), value = setting.substr(std::min(equals + 1, setting.size()));
  if (const auto error = truth::location_error(truth, outline, name)) {
    *error->value = number_of(setting, value, 1e5) * (error->angle ? 1e-6 : 1e-3);
    return true;
  }
  if (!name.starts_with("rise.")) return false;
  const auto source =
      name.size() == 6 ? std::string_view("XYZABCUVWS").find(name[5]) : std::string_view::npos;
  if (source == std::string_view::npos)
    throw std::runtime_error("--set " + setting +
                             ": expected rise. and an axis letter, or rise.S of the spindle");
  temperatures[source] = number_of(setting, value, 100);
  return true;
}

}  // namespace

TrueMachine load_true_machine(const std::string& directory, std::uint16_t channel,
                              const std::vector<std::string>& settings) {
  const auto config = machine::load_machine(directory);
  machine::Parameters delivered;
  delivered.values = machine::machine_parameters(config);
  TrueMachine machine;
  machine.name = config.name;
  machine.outline = machine::outline_of(delivered, channel);
  const auto file = directory + "/truth.yaml";
  if (std::filesystem::exists(file))
    machine.truth = truth::parse_truth(machine::read_text(file), file, machine.outline);
  auto model = delivered;
  truth::Temperatures temperatures{};
  for (const auto& setting : settings)
    if (!apply_truth_setting(machine.truth.geometry, temperatures, machine.outline, setting))
      machine::apply_setting(model, channel, setting);
  machine.report =
      std::make_unique<truth::PoseReport>(truth::make_geometry(machine.truth.geometry, machine.outline, file),
                                          machine::make_chain(model, channel), machine.outline);
  machine.report->temperatures = temperatures;
  if (auto compensation = volumetric::compensation_of(model, channel))
    machine.report->compensation =
        std::make_shared<volumetric::VolumetricCompensation>(*std::move(compensation));
  machine.model = std::move(model);
  return machine;
}

void take_model(TrueMachine& machine, const machine::Parameters& parameters, std::uint16_t channel) {
  auto report = std::make_unique<truth::PoseReport>(
      machine.report->geometry(), machine::make_chain(parameters, channel), machine.outline);
  report->tool_length = machine.report->tool_length;
  report->temperatures = machine.report->temperatures;
  machine.report = std::move(report);
  machine.model = parameters;
}

truth::InstrumentTruth instrument(const TrueMachine& machine, const std::string& name) {
  const auto found = machine.truth.instruments.find(name);
  return found == machine.truth.instruments.end() ? truth::InstrumentTruth{} : found->second;
}

}  // namespace trunnion::identification
