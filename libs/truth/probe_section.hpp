// SPDX-License-Identifier: Apache-2.0
// The sections `probe` and `solids` of truth.yaml.
#pragma once

#include <vector>

#include "truth/touch_probe.hpp"
#include "truth/truth_reader.hpp"

namespace trunnion::truth {

/// Throws std::runtime_error that begins with file:line:column, as read_solids().
TouchProbeTruth read_probe(const TruthReader& reader, const YAML::Node& section);
/// Positions in the workpiece frame.
std::vector<Solid> read_solids(const TruthReader& reader, const YAML::Node& section);

}  // namespace trunnion::truth
