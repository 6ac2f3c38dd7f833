// SPDX-License-Identifier: Apache-2.0
// The sections `drives` and `spindle_drives` of truth.yaml.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "machine/yaml_reader.hpp"
#include "truth/drive_truth.hpp"

namespace trunnion::truth {

/// By the names of the servo axes; `turning` are those that turn. Throws std::runtime_error that begins with
/// file:line:column.
std::map<std::string, DriveTruth> read_drives(const machine::YamlReader& reader, const YAML::Node& section,
                                              const std::vector<std::string>& names,
                                              const std::vector<std::string>& turning);

/// The section `spindle_drives`, by the names of the spindles. Throws as read_drives().
std::map<std::string, SpindleTruth> read_spindle_drives(const machine::YamlReader& reader,
                                                        const YAML::Node& section,
                                                        const std::vector<std::string>& names);

}  // namespace trunnion::truth
