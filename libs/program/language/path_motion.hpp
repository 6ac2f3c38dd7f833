// SPDX-License-Identifier: Apache-2.0
// Moves by axis words: rapid, straight lines, arcs, helices and threads.
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

  /// A straight thread to `target` (program coordinates), `lead` mm per revolution of the axis that goes
  /// farthest. It begins at the index mark or continues the thread before it.
  Fault thread_to(std::uint16_t at, double lead, const AxisValues& target, bool begins);
  /// What the program has set allows a thread of ProgramState::thread_lead.
  Fault check_thread(std::uint16_t at) const;

 private:
  /// G33 and G34.
  Fault cut_thread();
  /// The start angle of a thread to `target` that is in phase with the one that J, EX or EZ and EC describe
  /// (NUM).
  Fault resume_thread(const AxisValues& target, double& start_angle);
  /// The lead over the whole way to `target`, in the frame of the commands.
  Fault check_lead(std::uint16_t at, const AxisValues& target, const StraightMove& move);
  /// In contour coordinates.
  Fault find_arc(const AxisValues& target, std::uint16_t at, Arc& arc);
  Fault find_circle(const AxisValues& target, std::uint16_t& at, Arc& arc);
  /// What is to be known of a line with ,A, or behind one: its end, or that it waits for the next one.
  struct DrawnEnd {
    AxisValues target{};
    bool waits = false;
  };
  /// `drawn`: the block has ,A; `axes` those that it names; `end` has its target by the words alone.
  Fault complete_line(std::uint16_t at, bool drawn, std::uint32_t axes, const std::optional<Corner>& corner,
                      DrawnEnd& end);
  Fault open_line(std::uint32_t axes, const std::optional<Corner>& corner);
  /// Makes the move that waits, up to where it meets the line to `target`.
  Fault close_line(std::uint16_t at, std::uint32_t axes, const AxisValues& target);
  Fault move_to_corner(const OpenLine& open, Vector2 corner);
  /// What the block asks for at the end of its move.
  Fault read_corner(std::optional<Corner>& corner);
  /// For the alarm: the radii of a circle at its start and at `target`, which differ.
  void note_radii(const AxisValues& target, const Arc& arc);
  Fault set_turns(const AxisValues& target, Arc& arc);
  Fault move_on_arc(const Arc& arc, const AxisValues& target);

  ToolVectorMotion& vectors_;
  double radius_deviation_ = 0;
};

}  // namespace trunnion::language
