// SPDX-License-Identifier: Apache-2.0
// The sections `probe` and `solids` of truth.yaml.
#pragma once

#include <vector>

#include "machine/yaml_reader.hpp"
#include "touch_probe/touch_probe.hpp"

namespace trunnion::truth {

/// Throws std::runtime_error that begins with file:line:column, as read_solids().
touch_probe::TouchProbeTruth read_probe(const machine::YamlReader& reader, const YAML::Node& section);
/// Positions in the workpiece frame.
std::vector<touch_probe::Solid> read_solids(const machine::YamlReader& reader, const YAML::Node& section);

}  // namespace trunnion::truth
