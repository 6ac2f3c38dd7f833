// SPDX-License-Identifier: Apache-2.0
// Tilted planes: G68.1 .. G68.4, the swing of the tool to them, and moves along the tool.
#pragma once

#include <optional>

#include "language/block_context.hpp"

namespace trunnion::language {

class TiltedPlanes : private BlockHandler {
 public:
  explicit TiltedPlanes(BlockContext& context) : BlockHandler(context) {}

  /// A swing must be the block behind a tilt, and alone in it.
  Fault check() const;

  Fault tilt_to_stored_plane(std::uint16_t at);  ///< G68.1
  /// G68.2 (Euler angles about the turned axes Z X Z) and G68.3 (about the fixed axes X Y Z).
  Fault tilt_by_angles(std::uint16_t at, bool turned_axes);
  Fault tilt_in_plane(std::uint16_t at);   ///< G68.4: words as G68.2, in the plane that is active
  Fault clear_rotation(std::uint16_t at);  ///< G69: rotation in the plane, too
  /// G53.2 with the tip kept in place, G53.1 with the linear axes at rest in machine coordinates.
  Fault swing(std::uint16_t at, bool keep_tip);
  Fault move_along_tool(std::uint16_t at);  ///< G53.3

 private:
  /// `by_p`: P has said what the angles are.
  Fault read_angles(std::uint16_t at, bool turned_axes, Tilt& tilt, bool& by_p);
  Fault apply(const Tilt& tilt, bool angles_by_p = false);
  Fault swing_at_rest(AxisValues target);
  /// That bring the tool to a direction of the workpiece frame, by P of the plane; nothing when none do.
  std::optional<AxisValues> rotary_axes(const Vector3& direction) const;
  Vector3 tool_direction() const;
};

}  // namespace trunnion::language
