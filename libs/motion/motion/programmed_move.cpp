// SPDX-License-Identifier: Apache-2.0
#include "motion/programmed_move.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trunnion::motion {
namespace {

using canonical::Command;
using canonical::CommandKind;

constexpr double longest_dwell_cycles = 1e9;

template <class Values>
bool all_finite(const Values& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// Every axis that has to move needs limits above zero; through a chain any move may move X Y Z.
bool movable(const AxisValues& from, const AxisValues& to, const Limits& limits, bool transformed) {
  for (std::size_t i = 0; i < canonical::axis_count; ++i) {
    if (from[i] == to[i] && (!transformed || i > canonical::Z)) continue;
    const AxisLimits& axis = limits.axes[i];
    if (!(axis.velocity > 0 && axis.rapid_velocity > 0 && axis.acceleration > 0 && axis.jerk > 0))
      return false;
  }
  return true;
}

bool set_dwell(ProgrammedMove& move, const Command& command, const AxisValues& from, double fraction,
               double cycle_seconds) {
  const double cycles = std::ceil(command.dwell_seconds * (1 - fraction) / cycle_seconds - 1e-9);
  if (!(cycles >= 0) || cycles > longest_dwell_cycles) return false;
  move.path = PathSegment::line(from, from);
  move.wait_cycles = static_cast<int>(cycles);
  return true;
}

bool set_path(ProgrammedMove& move, const Command& command, const AxisValues& from, double fraction) {
  if (!all_finite(command.target)) return false;
  if (command.kind == CommandKind::rapid || command.kind == CommandKind::line) {
    move.path = PathSegment::line(from, command.target);
    return true;
  }
  if (command.kind != CommandKind::arc) return false;
  canonical::Arc arc = command.arc;
  if (!(arc.sweep >= 0) || !std::isfinite(arc.sweep)) return false;
  if (fraction > 0) arc.sweep = remaining_sweep(from, command.target, arc, fraction);
  if (!all_finite(arc.centre)) return false;
  move.path =
      arc.sweep > 0 ? PathSegment::arc(from, command.target, arc) : PathSegment::line(from, command.target);
  return true;
}

bool set_feed(ProgrammedMove& move, const Command& command, double fraction, bool combined) {
  const bool inverse = command.modal.feed_mode == canonical::FeedMode::inverse_time;
  const double length = move.path.length();
  // Inverse time is the feed of the whole command: what is left of it takes its share of the time.
  const double whole = fraction < 1 ? length / (1 - fraction) : length;
  move.feed = command.modal.feed / 60 *
              (inverse    ? whole
               : combined ? move.path.combined_feed_scale()
                          : move.path.feed_scale());
  if (!std::isfinite(length)) return false;
  return !(length > 0) || command.kind == CommandKind::rapid || (move.feed > 0 && std::isfinite(move.feed));
}

}  // namespace

std::optional<ProgrammedMove> programmed_move(const Command& command, const AxisValues& from, double fraction,
                                              const Limits& limits, bool transformed, double cycle_seconds) {
  std::optional<ProgrammedMove> move(std::in_place);
  if (command.modal.smoothing >= path_modes || !std::isfinite(command.modal.path_tolerance)) {
    move.reset();
  } else if (command.kind == CommandKind::dwell) {
    if (!set_dwell(*move, command, from, fraction, cycle_seconds)) move.reset();
  } else if (!set_path(*move, command, from, fraction) ||
             !set_feed(*move, command, fraction, limits.combined_feed && !transformed) ||
             !movable(from, command.target, limits, transformed)) {
    move.reset();
  }
  return move;
}

}  // namespace trunnion::motion
