// SPDX-License-Identifier: Apache-2.0
#include "true_machine.hpp"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "compensation/model_parameters.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine.hpp"
#include "machine/yaml.hpp"
#include "machine_settings.hpp"
#include "text/quantity.hpp"

namespace trunnion::cli {
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

TrueMachine load_true_machine(const std::string& name, std::uint16_t channel,
                              const std::vector<std::string>& settings) {
  const auto directory = machine_directory(name);
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
      apply_setting(model, channel, setting);
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

bool has_truth(const std::string& machine) {
  return std::filesystem::exists(machine_directory(machine) + "/truth.yaml");
}

truth::InstrumentTruth instrument(const TrueMachine& machine, const std::string& name) {
  const auto found = machine.truth.instruments.find(name);
  return found == machine.truth.instruments.end() ? truth::InstrumentTruth{} : found->second;
}

truth::Vec3 coordinates(const std::string& option, const std::string& text) {
  std::istringstream in(text);
  truth::Vec3 v;
  char comma[2], more = 0;
  if (!(in >> v[0] >> comma[0] >> v[1] >> comma[1] >> v[2]) || comma[0] != ',' || comma[1] != ',' ||
      in >> more || !v.allFinite() || !(v.cwiseAbs().maxCoeff() <= 1e6))
    throw std::runtime_error(option + " " + text + ": expected X,Y,Z in mm");
  return v;
}

}  // namespace trunnion::cli
