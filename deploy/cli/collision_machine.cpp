// SPDX-License-Identifier: Apache-2.0
#include "collision_machine.hpp"

#include <algorithm>
#include <cstdio>

#include "machine/chain_parameters.hpp"
#include "machine_directory.hpp"

namespace trunnion::cli {

collision::MachineBodies load_bodies(const TrueMachine& machine, const std::string& name,
                                     std::uint16_t channel) {
  auto bodies =
      collision::load_bodies(machine_directory(name), machine::chain_parameters(machine.model, channel),
                             machine.truth.geometry.structure);
  collision::add_solids(bodies.links, machine.truth.solids, bodies.set);
  return bodies;
}

void put_tool(collision::MachineBodies& bodies, const CylinderTool& tool) {
  std::erase_if(bodies.set.bodies, [](const auto& body) { return body.tool; });
  bodies.set.bodies.push_back(collision::tool_body(bodies.links, tool.length, tool.radius));
}

void print_warnings(collision_guard::CollisionGuard* guard, const std::string& program) {
  if (guard == nullptr) return;
  for (const auto& line : guard->take_warnings())
    std::fprintf(stderr, "%s:%s\n", program.c_str(), line.c_str());
}

}  // namespace trunnion::cli
