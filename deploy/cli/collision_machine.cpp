// SPDX-License-Identifier: Apache-2.0
#include "collision_machine.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "machine/chain_parameters.hpp"
#include "machine/yaml.hpp"
#include "machine_settings.hpp"

namespace trunnion::cli {

collision::MachineBodies load_bodies(const TrueMachine& machine, const std::string& name,
                                     std::uint16_t channel) {
  const auto chain = machine::chain_parameters(machine.model, channel);
  const auto file = machine_directory(name) + "/bodies.yaml";
  const bool described = std::filesystem::exists(file);
  auto bodies = collision::parse_bodies(described ? machine::read_text(file) : "", file, chain,
                                        machine.truth.geometry.structure);
  if (!described) bodies.set = collision::derived_bodies(bodies.links);
  collision::add_solids(bodies.links, machine.truth.solids, bodies.set);
  return bodies;
}

void put_tool(collision::MachineBodies& bodies, const CylinderTool& tool) {
  std::erase_if(bodies.set.bodies, [](const auto& body) { return body.tool; });
  bodies.set.bodies.push_back(collision::tool_body(bodies.links, tool.length, tool.radius));
}

void put_probe(collision::MachineBodies& bodies, const truth::TouchProbeTruth& probe) {
  const auto& all = bodies.set.bodies;
  if (std::none_of(all.begin(), all.end(), [](const auto& body) { return body.tool; }))
    collision::add_probe(bodies.links, probe, bodies.set);
}

}  // namespace trunnion::cli
