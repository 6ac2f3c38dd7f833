// SPDX-License-Identifier: Apache-2.0
// The bodies of a machine of the command line.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "collision/bodies_file.hpp"
#include "collision/way_search.hpp"
#include "collision_guard/collision_guard.hpp"
#include "true_machine.hpp"

namespace trunnion::cli {

/// What is in the spindle.
struct CylinderTool {
  double length = 0, radius = 0;  ///< mm
};

/// Links and bodies of bodies.yaml in the machine's directory, or the derived ones; and the solids of
/// truth.yaml on the table. The chain is that of the control. Throws std::runtime_error.
collision::MachineBodies load_bodies(const TrueMachine& machine, const std::string& name,
                                     std::uint16_t channel);
/// In the place of the bodies on the tool.
void put_tool(collision::MachineBodies& bodies, const CylinderTool& tool);

/// Of `collision: warn`, to the error output; `guard` may be null.
void print_warnings(collision_guard::CollisionGuard* guard, const std::string& program);

}  // namespace trunnion::cli
