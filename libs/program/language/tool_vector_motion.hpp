// SPDX-License-Identifier: Apache-2.0
// Moves whose words I J K give the direction of the tool (G43.5).
#pragma once

#include <optional>

#include "language/block_context.hpp"

namespace trunnion::language {

class ToolVectorMotion : private BlockHandler {
 public:
  explicit ToolVectorMotion(BlockContext& context) : BlockHandler(context) {}

  /// The direction from the tip to the spindle in the workpiece frame that the block gives, if any, and the
  /// place of its words.
  Fault read(std::optional<Vector3>& direction, std::uint16_t& at);
  /// The rotary axes of `target` (program coordinates) for the direction, without regard to the path there.
  Fault point(const Vector3& direction, std::uint16_t at, AxisValues& target);
  /// Leads the tool to the direction while the tip moves to `end` (frame of the commands): the beginning of
  /// an activity.
  Fault lead(CommandKind kind, const Arc& arc, const Vector3& direction, std::uint16_t at,
             const AxisValues& end);
  Fault next_piece();

 private:
  struct Move {
    CommandKind kind = CommandKind::line;
    AxisValues start{}, end{};  // frame of the commands; of `end` all but the rotary axes
    Arc arc{};                  // the whole one
    Vector3 direction{};        // workpiece frame
    std::uint32_t piece = 0, pieces = 1;
  };
  Move move_;
};

/// The alarm for a direction that Environment::orient() refuses.
Fault refuse_orientation(BlockContext& context, const Vector3& direction, std::uint16_t at);

}  // namespace trunnion::language
