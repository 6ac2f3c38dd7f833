#include "active_set.hpp"

#include <sstream>
#include <stdexcept>

#include "machine/yaml.hpp"
#include "tables.hpp"

namespace trunnion::parameters {

namespace {

/// Values that the catalogue refuses are an error when `strict`, else left out.
Values values_of(const YAML::Node& map, const std::string& file, bool strict) {
  Values result;
  if (!map || map.IsNull()) return result;
  if (!map.IsMap()) throw std::runtime_error(machine::at(file, map) + "expected lines of 'number: value'");
  const auto& catalogue = machine::Catalogue::instance();
  for (const auto& entry : map) {
    const auto key = entry.first.as<std::string>();
    if (key.size() != 6 || key.find_first_not_of("0123456789") != std::string::npos)
      throw std::runtime_error(machine::at(file, entry.first) + "'" + key +
                               "' is not a parameter number of six digits");
    const auto number = static_cast<std::uint32_t>(std::stoul(key));
    const auto* definition = catalogue.find(number);
    if (!entry.second.IsScalar())
      throw std::runtime_error(machine::at(file, entry.second) + "expected one value");
    machine::ParameterValue value;
    if (definition == nullptr || definition->type == machine::ParameterType::text)
      value.text = entry.second.as<std::string>();
    else if (!YAML::convert<double>::decode(entry.second, value.value))
      value.text = entry.second.Scalar();  // refused below with the parameter's name
    const auto error = catalogue.check(number, value.value, value.text);
    if (!error.empty() && strict) throw std::runtime_error(machine::at(file, entry.second) + error);
    if (error.empty() && !result.emplace(number, value).second)
      throw std::runtime_error(machine::at(file, entry.first) + "parameter " + key + " is given twice");
  }
  return result;
}

}  // namespace

Values read_values(const std::string& text, const std::string& file) {
  return values_of(machine::parse_yaml(text, file), file, true);
}

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
  active.values = values_of(document["values"], file, false);
  return active;
}

std::string write_active(const ActiveSet& active) {
  std::ostringstream out;
  out << "# Kept by the parameters service: what is active since the start of the cluster named by 'boot'.\n"
      << "boot: " << quoted(active.boot) << "\nrevision: " << active.revision
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
