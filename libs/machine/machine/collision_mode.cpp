// SPDX-License-Identifier: Apache-2.0
#include "machine/collision_mode.hpp"

#include <stdexcept>

#include "machine/yaml.hpp"

namespace trunnion::machine {

CollisionMode read_collision_mode(const YAML::Node& document, const std::string& file) {
  const auto node = document["collision"];
  if (!node) return CollisionMode::off;
  const auto mode = node.IsScalar() ? node.Scalar() : "";
  if (mode == "off") return CollisionMode::off;
  if (mode == "warn") return CollisionMode::warn;
  if (mode == "stop") return CollisionMode::stop;
  throw std::runtime_error(at(file, node) + "collision must be 'off', 'warn' or 'stop'");
}

CollisionMode load_collision_mode(const std::string& directory) {
  const auto file = directory + "/machine.yaml";
  return read_collision_mode(parse_yaml(read_text(file), file), file);
}

}  // namespace trunnion::machine
