// SPDX-License-Identifier: Apache-2.0
#include "machine/parameter_setting.hpp"

#include <sstream>
#include <stdexcept>

#include "machine/kinematics.hpp"

namespace trunnion::machine {
namespace {

// The vector of a correction, as its element in machine.yaml has it.
bool apply_correction(Parameters& parameters, std::uint16_t channel, const std::string& name,
                      const std::string& text) {
  for (const auto& element : correction_elements(parameters, channel)) {
    if (element.name != name) continue;
    std::istringstream in(text);
    double v[3];
    char comma[2];
    if (!(in >> v[0] >> comma[0] >> v[1] >> comma[1] >> v[2]) || comma[0] != ',' || comma[1] != ',' ||
        in >> comma[0])
      throw std::runtime_error("--set " + name + ": expected NAME=X,Y,Z");
    for (std::uint32_t i = 0; i < 3; ++i) {
      const double value = element.sign * v[i];
      const auto refused = Catalogue::instance().check(element.number + i, value, "");
      if (!refused.empty()) throw std::runtime_error(refused);
      parameters.values[element.number + i] = {value, ""};
    }
    return true;
  }
  return false;
}

}  // namespace

void apply_setting(Parameters& parameters, std::uint16_t channel, const std::string& setting) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos)
    throw std::runtime_error("--set " + setting + ": expected NUMBER=VALUE or NAME=X,Y,Z");
  if (apply_correction(parameters, channel, setting.substr(0, equals), setting.substr(equals + 1))) return;
  std::string number = setting.substr(0, equals);
  if (!number.empty() && number.size() < 6) number.insert(0, 6 - number.size(), '0');
  // As a line of parameters.yaml, so that the same limits hold.
  const auto values =
      read_parameter_text("\"" + number + "\": " + setting.substr(equals + 1), "--set " + setting);
  for (const auto& [key, value] : values) parameters.values[key] = value;
}

}  // namespace trunnion::machine
