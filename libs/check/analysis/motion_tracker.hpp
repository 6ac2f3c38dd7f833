// SPDX-License-Identifier: Apache-2.0
// From canonical commands to the motions somebody checks: in machine and workpiece coordinates, with feed and
// length.
#pragma once

#include <optional>

#include "language/interpreter.hpp"

namespace trunnion::analysis {

struct Motion {
  std::uint32_t program = 0;  ///< as Command::program
  std::uint32_t line = 0;
  language::CommandKind kind = language::CommandKind::rapid;
  language::AxisValues from{};  ///< machine coordinates of the control point, mm and degrees
  language::AxisValues mcs{};   ///< of its end, likewise
  language::AxisValues wcs{};   ///< of its end in the workpiece: without offsets and tool length
  double length = 0;  ///< mm of the linear axes in the frame of the command; degrees when none of them moves
  double combined = 0;  ///< root of the sum of squares of mm and degrees; with tool tip control the length
  double counted = 0;   ///< which of the two `feed` counts: parameter 04c919
  std::optional<double> feed;  ///< mm/min (degrees/min), not of a rapid nor when it cannot be known
  language::Arc arc{};         ///< of kind arc, its centre in machine coordinates
  std::uint32_t turns = 0;     ///< of kind arc: begun turns
};

/// The unit vector an arc turns about.
language::Vector3 arc_normal(const language::Arc& arc);

/// Follows the commands of one program.
class MotionTracker {
 public:
  /// `position` in machine coordinates. Both must outlive the tracker.
  MotionTracker(const language::Environment& environment, const language::Interpreter& interpreter,
                const language::AxisValues& position)
      : environment_(environment), interpreter_(interpreter), machine_(position), target_(position) {}

  /// The motion a command makes, if it makes one; to be asked right after the interpreter gave it.
  std::optional<Motion> follow(const language::Command& command);
  /// The same of a command that motion has got as `move`: with G96 the feed per revolution is that of the
  /// move.
  std::optional<Motion> follow(const language::Command& command, const language::Command& move);
  const language::AxisValues& machine() const { return machine_; }

 private:
  language::AxisValues to_machine(const language::Command& command, const language::AxisValues& point) const;

  const language::Environment& environment_;
  const language::Interpreter& interpreter_;
  language::AxisValues machine_;
  language::AxisValues target_;  // in the frame of the last command
};

}  // namespace trunnion::analysis
