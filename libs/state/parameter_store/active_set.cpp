// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/active_set.hpp"

#include <sstream>
#include <stdexcept>

#include "machine/yaml.hpp"

namespace trunnion::parameters {

ActiveSet read_active(const std::string& text, const std::string& file) {
  ActiveSet active;
  const auto document = machine::parse_yaml(text, file);
  try {
    active.boot = document["boot"].as<std::string>();
    active.revision = document["revision"].as<std::uint64_t>();
    active.previous = document["previous"].as<std::uint64_t>();
    for (const auto& entry : document["resets"])
      active.resets[entry.first.as<std::uint16_t>()] = entry.second.as<std::uint32_t>();
  } catch (const YAML::Exception& e) {
    throw std::runtime_error(file + ":" + std::to_string(e.mark.line + 1) + ":" +
                             std::to_string(e.mark.column + 1) + ": error: " + e.msg);
  }
  active.values = machine::read_parameter_values(document["values"], file, false);
  return active;
}

std::string write_active(const ActiveSet& active) {
  std::ostringstream out;
  out << "# Kept by the parameters service: what is active since the start of the cluster named by 'boot'.\n"
      << "boot: " << machine::scalar_text(active.boot) << "\nrevision: " << active.revision
      << "\nprevious: " << active.previous << "\nresets: {";
  const char* separator = "";
  for (const auto& [channel, count] : active.resets) {
    out << separator << channel << ": " << count;
    separator = ", ";
  }
  out << "}\nvalues:\n";
  std::istringstream lines(machine::write_parameter_text(active.values));
  for (std::string line; std::getline(lines, line);) out << "  " << line << "\n";
  return out.str();
}

}  // namespace trunnion::parameters
