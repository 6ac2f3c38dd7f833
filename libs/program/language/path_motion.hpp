// SPDX-License-Identifier: Apache-2.0
// Moves by axis words: rapid, straight lines, arcs and helices.
#pragma once

#include "language/block_context.hpp"
#include "language/tool_vector_motion.hpp"

namespace trunnion::language {

class PathMotion : private BlockHandler {
 public:
  PathMotion(BlockContext& context, ToolVectorMotion& vectors) : BlockHandler(context), vectors_(vectors) {}

  void start() { radius_deviation_ = environment_.radius_deviation(); }

  /// The move that the modal motion code and the words of the block mean, if any.
  Fault move();

 private:
  /// In contour coordinates.
  Fault find_arc(const AxisValues& target, std::uint16_t at, Arc& arc);
  Fault find_circle(const AxisValues& target, std::uint16_t& at, Arc& arc);
  /// What the block asks for at the end of its move.
  Fault read_corner(std::optional<Corner>& corner);
  Fault set_turns(const AxisValues& target, Arc& arc);
  Fault move_on_arc(const Arc& arc, const AxisValues& target);

  ToolVectorMotion& vectors_;
  double radius_deviation_ = 0;
};

}  // namespace trunnion::language
