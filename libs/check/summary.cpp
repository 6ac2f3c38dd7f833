#include "check/summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <ostream>

#include "language/arc_geometry.hpp"

namespace trunnion::check {

using language::AxisValues;
using language::CommandKind;

void Summary::add(const language::Command& command) {
  if (command.kind == CommandKind::tool) tools_.insert(command.number);
  if (command.kind == CommandKind::dwell) dwell_seconds_ += command.dwell_seconds;
}

void Summary::add(const Motion& motion) {
  if (motion.kind == CommandKind::rapid) {
    ++rapids_;
    rapid_length_ += motion.length;
  } else {
    ++(motion.kind == CommandKind::arc ? arcs_ : lines_);
    feed_length_ += motion.length;
    if (motion.feed && *motion.feed > 0) feed_minutes_ += motion.length / *motion.feed;
  }
  if (!moved_) lowest_ = highest_ = motion.from;
  moved_ = true;
  extend(motion.from);
  extend(motion.mcs);
  if (motion.kind == CommandKind::arc) extend_over_arc(motion);
}

void Summary::extend(const AxisValues& point) {
  for (std::size_t axis = 0; axis < language::axis_count; ++axis) {
    lowest_[axis] = std::min(lowest_[axis], point[axis]);
    highest_[axis] = std::max(highest_[axis], point[axis]);
  }
}

void Summary::extend_over_arc(const Motion& motion) {
  const auto plane = language::plane_axes(motion.arc.plane);
  const double x = motion.from[plane.first] - motion.arc.centre[plane.first];
  const double y = motion.from[plane.second] - motion.arc.centre[plane.second];
  const double radius = std::hypot(x, y);
  double start = std::atan2(y, x) * 180 / std::numbers::pi;
  if (motion.arc.clockwise) start -= motion.arc.sweep;
  // The farthest points lie at the quarters the arc passes.
  AxisValues point = motion.from;
  for (int k = 0, quarter = static_cast<int>(std::ceil(start / 90));
       k < 4 && 90.0 * quarter <= start + motion.arc.sweep; ++k, ++quarter) {
    const int side = ((quarter % 4) + 4) % 4;
    point[plane.first] = motion.arc.centre[plane.first] + (side == 0 ? radius : side == 2 ? -radius : 0);
    point[plane.second] = motion.arc.centre[plane.second] + (side == 1 ? radius : side == 3 ? -radius : 0);
    extend(point);
  }
}

void Summary::print(std::ostream& out, std::uint64_t blocks) const {
  char line[160];
  std::snprintf(line, sizeof line, "blocks   %llu\n", static_cast<unsigned long long>(blocks));
  out << line;
  std::snprintf(line, sizeof line, "moves    %llu rapid, %llu lines, %llu arcs\n",
                static_cast<unsigned long long>(rapids_), static_cast<unsigned long long>(lines_),
                static_cast<unsigned long long>(arcs_));
  out << line;
  std::snprintf(line, sizeof line, "path     %.3f mm rapid, %.3f mm at feed\n", rapid_length_, feed_length_);
  out << line;
  std::snprintf(line, sizeof line, "time     %.2f min at feed, %.2f s dwell\n", feed_minutes_,
                dwell_seconds_);
  out << line;
  out << "tools   ";
  for (const std::uint32_t tool : tools_) out << " T" << tool;
  out << (tools_.empty() ? " none\n" : "\n");
  for (std::size_t axis = 0; axis < language::axis_count; ++axis) {
    if (((axes_ >> axis) & 1u) == 0 || !moved_) continue;
    std::snprintf(line, sizeof line, "%c        %.4f .. %.4f (machine)\n", language::axis_letters[axis],
                  lowest_[axis], highest_[axis]);
    out << line;
  }
}

}  // namespace trunnion::check
