// SPDX-License-Identifier: Apache-2.0
#include "machine/dialect_section.hpp"

#include <algorithm>

#include "canonical/program_dialect.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::machine {
namespace {

std::map<std::string, canonical::ProgramDialect> choices() {
  std::map<std::string, canonical::ProgramDialect> names;
  for (const auto name : canonical::dialect_names) names.emplace(name, *canonical::dialect_named(name));
  return names;
}

// The text of 04c800.
std::string rules(const YAML::Node& map, const YamlReader& reader) {
  std::string text;
  reader.each(map, "the endings of names", [&](const std::string& ending, const YAML::Node& dialect) {
    if (ending.empty() || ending.find_first_of(" ;") != std::string::npos)
      reader.fail(dialect, "'" + ending + "' is no ending of a name: characters but blank and semicolon");
    const auto chosen = reader.choice(dialect, choices());
    text.append(text.empty() ? "" : "; ").append(ending).append(" ").append(canonical::dialect_name(chosen));
    return true;
  });
  return text;
}

}  // namespace

std::map<std::uint32_t, ParameterValue> read_dialect_parameters(const YAML::Node& document,
                                                                const std::string& file,
                                                                std::uint32_t channels) {
  constexpr std::uint32_t most_channels = 10;  // that have parameters
  const YamlReader reader(file);
  const auto dialect = document["dialect"], names = document["program_dialects"];
  std::map<std::uint32_t, ParameterValue> values;
  for (std::uint32_t channel = 0; channel < std::min(channels, most_channels); ++channel) {
    if (dialect)
      values[parameter::program_dialect.number(channel)] = {
          static_cast<double>(reader.choice(dialect, choices())), ""};
    if (names) values[parameter::program_dialects.number(channel)] = {0, rules(names, reader)};
  }
  return values;
}

}  // namespace trunnion::machine
