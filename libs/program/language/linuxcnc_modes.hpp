// SPDX-License-Identifier: Apache-2.0
// Modal codes of LinuxCNC that mean something else, or nothing, on other controls.
#pragma once

#include "language/block_context.hpp"

namespace trunnion::language {

class LinuxcncModes : private BlockHandler {
 public:
  explicit LinuxcncModes(BlockContext& context) : BlockHandler(context) {}

  Fault dwell(std::uint16_t at);                  ///< G4
  Fault set_diameter(std::uint16_t at, bool on);  ///< G7, G8
  Fault set_surface_speed(std::uint16_t at);      ///< G96
};

}  // namespace trunnion::language
