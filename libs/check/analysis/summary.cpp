// SPDX-License-Identifier: Apache-2.0
#include "analysis/summary.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include "language/arc_geometry.hpp"
#include "language/codes.hpp"

namespace trunnion::analysis {

using language::AxisValues;
using language::CommandKind;

void Summary::add(const language::Command& command) {
  if (command.kind == CommandKind::tool) tools_.insert(command.number);
  if (command.kind == CommandKind::auxiliary && !language::is_named_m(command.number))
    other_m_codes_.insert(command.number);
  const auto solution = command.modal.tilt.solution;
  const bool by_p = solution == 1 || solution == 2;
  if (command.kind == CommandKind::transformation && by_p && plane_line_ == 0)
    plane_line_ = command.line, plane_solution_ = solution;
  if (command.kind == CommandKind::print) ++printed_;
  if (command.kind == CommandKind::dwell) dwell_seconds_ += command.dwell_seconds;
}

void Summary::add(const Motion& motion) {
  if (motion.kind == CommandKind::rapid) {
    ++rapids_;
    rapid_length_ += motion.length;
  } else {
    ++(motion.kind == CommandKind::arc ? arcs_ : lines_);
    feed_length_ += motion.length;
    if (motion.feed && *motion.feed > 0) {
      feed_minutes_ += motion.counted / *motion.feed;
      mixed_.add(motion);
    }
  }
  if (!moved_) lowest_ = highest_ = motion.from;
  moved_ = true;
  extend(motion.from);
  extend(motion.mcs);
  if (motion.kind == CommandKind::arc) extend_over_arc(motion);
}

// Where the two ways to count F differ by no more than this nobody notices.
void Summary::MixedMoves::add(const Motion& motion) {
  constexpr double noticed = 2;
  if (!(motion.combined > noticed * motion.length)) return;
  if (moves++ == 0) line = motion.line;
  linear_minutes += motion.length / *motion.feed;
  combined_minutes += motion.combined / *motion.feed;
}

void Summary::extend(const AxisValues& point) {
  for (std::size_t axis = 0; axis < language::axis_count; ++axis) {
    lowest_[axis] = std::min(lowest_[axis], point[axis]);
    highest_[axis] = std::max(highest_[axis], point[axis]);
  }
}

// The farthest point along an axis is where the radius points most in its direction; it counts when the arc
// passes it.
void Summary::extend_over_arc(const Motion& motion) {
  using language::Vector3;
  const Vector3 normal = arc_normal(motion.arc);
  const auto dot = [](const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  Vector3 radius{};
  for (std::size_t axis = 0; axis < 3; ++axis) radius[axis] = motion.from[axis] - motion.arc.centre[axis];
  const double along = dot(radius, normal);
  for (std::size_t axis = 0; axis < 3; ++axis) radius[axis] -= along * normal[axis];
  const double turn = motion.arc.clockwise ? -1 : 1;
  const Vector3 side{turn * (normal[1] * radius[2] - normal[2] * radius[1]),
                     turn * (normal[2] * radius[0] - normal[0] * radius[2]),
                     turn * (normal[0] * radius[1] - normal[1] * radius[0])};
  const double sweep = motion.arc.sweep * std::numbers::pi / 180;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double first = std::atan2(side[axis], radius[axis]);
    // Twice a turn, the last times of each included: a helix rises between them.
    for (int half = 0; half < 2; ++half) {
      const double begin =
          std::fmod(first + half * std::numbers::pi + 2 * std::numbers::pi, 2 * std::numbers::pi);
      const double last = begin + 2 * std::numbers::pi * std::floor((sweep - begin) / (2 * std::numbers::pi));
      for (const double angle : {begin, last}) {
        if (angle > sweep || angle < 0) continue;
        AxisValues point = motion.from;
        const double share = angle / sweep;
        for (std::size_t k = 0; k < 3; ++k) {
          const double rise = dot({motion.mcs[0] - motion.from[0], motion.mcs[1] - motion.from[1],
                                   motion.mcs[2] - motion.from[2]},
                                  normal);
          point[k] = motion.arc.centre[k] + radius[k] * std::cos(angle) + side[k] * std::sin(angle) +
                     (along + rise * share) * normal[k];
        }
        extend(point);
      }
    }
  }
}

void Summary::print(std::ostream& out, std::uint64_t blocks, std::string_view warnings) const {
  out << fmt::format("blocks   {}\n", blocks);
  out << fmt::format("moves    {} rapid, {} lines, {} arcs\n", rapids_, lines_, arcs_);
  out << fmt::format("path     {:.3f} mm rapid, {:.3f} mm at feed\n", rapid_length_, feed_length_);
  out << fmt::format("time     {:.2f} min at feed, {:.2f} s dwell\n", feed_minutes_, dwell_seconds_);
  if (mixed_.moves > 0)
    out << fmt::format(
        "warning  {} moves of linear and rotary axes, the first in line {}: {:.2f} s when F counts both "
        "(04c919 = 0), {:.2f} s when it counts the linear ones (1)\n",
        mixed_.moves, mixed_.line, mixed_.combined_minutes * 60, mixed_.linear_minutes * 60);
  if (plane_line_ != 0)
    out << "warning  line " << plane_line_ << ": P" << plane_solution_
        << " of a tilted plane chooses the solution of the rotary axes; programs for Fanuc state the kind of "
           "the angles with P of G68.2: parameter 04c989 = 1\n";
  if (printed_ > 0) out << fmt::format("prints   {} lines of DPRNT\n", printed_);
  out << warnings << "tools   ";
  for (const std::uint32_t tool : tools_) out << " T" << tool;
  out << (tools_.empty() ? " none\n" : "\n");
  for (std::size_t axis = 0; axis < language::axis_count; ++axis) {
    if (((axes_ >> axis) & 1u) == 0 || !moved_) continue;
    out << fmt::format("{}        {:.4f} .. {:.4f} (machine)\n", language::axis_letters[axis], lowest_[axis],
                       highest_[axis]);
  }
}

}  // namespace trunnion::analysis
