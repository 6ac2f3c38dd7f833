// SPDX-License-Identifier: Apache-2.0
// `collision` in machine.yaml: what happens when a move would lead bodies of the machine into each other.
#pragma once

#include <cstdint>
#include <string>

namespace YAML {
class Node;
}

namespace trunnion::machine {

enum class CollisionMode : std::uint8_t {
  off,   ///< nothing is checked
  warn,  ///< an alarm is shown, and the motion goes on
  stop,  ///< the motion stops before
};

/// `document` is that of machine.yaml in `file`. Throws std::runtime_error with file:line:column.
CollisionMode read_collision_mode(const YAML::Node& document, const std::string& file);
/// Of machine.yaml in `directory`. Throws std::runtime_error.
CollisionMode load_collision_mode(const std::string& directory);

}  // namespace trunnion::machine
