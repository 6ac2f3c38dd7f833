// SPDX-License-Identifier: Apache-2.0
// The bodies of a machine as JSON.
#pragma once

#include "bus/json.hpp"
#include "collision/bodies_file.hpp"

namespace trunnion::gateway {

/// {"structure", "workpiece_side", "tool_side": [axis, ...], "bodies": [...]} as MachineBodies of
/// openapi.json; mm, machine coordinates with every axis at zero.
bus::Json bodies_document(const collision::MachineBodies& machine);

}  // namespace trunnion::gateway
