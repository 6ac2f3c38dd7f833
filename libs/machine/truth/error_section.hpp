// SPDX-License-Identifier: Apache-2.0
// The terms of an error function in truth.yaml.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "machine/yaml_reader.hpp"
#include "truth/true_geometry.hpp"

namespace trunnion::truth {

/// A list of terms, each a map: polynomial_um with origin_mm and unit_mm, harmonic_um with period_mm and
/// phase_deg, table_um with positions_mm, interpolation and modulo_mm, or reversal_um; and `approach`,
/// `position_of`. Angles have _urad in place of _um, positions of rotary axes _deg in place of _mm. One
/// ComponentError for each axis whose position decides. `axis_of` finds the axis of a name or throws;
/// `rotary` says whether an axis turns. Throws std::runtime_error that begins with file:line:column.
std::vector<ComponentError> read_errors(
    const machine::YamlReader& reader, const YAML::Node& list, std::size_t axis, std::size_t component,
    const std::function<std::size_t(const YAML::Node&, const std::string&)>& axis_of,
    const std::function<bool(std::size_t)>& rotary);

}  // namespace trunnion::truth
