// SPDX-License-Identifier: Apache-2.0
// The order of a machine's axes in the notation of ISO 10791: [w C' A' b X Y Z (S) t].
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "compensation/error_model.hpp"

namespace trunnion::volumetric {

/// Axes from the workpiece w over the bed b to the tool t; those with ' carry the workpiece. Brackets and the
/// spindle (S) may be left out. Otherwise one line that says what is wrong.
std::variant<std::vector<StructureAxis>, std::string> parse_structure(const std::string& text);

}  // namespace trunnion::volumetric
