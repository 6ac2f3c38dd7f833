// SPDX-License-Identifier: Apache-2.0
#include "analysis/motion_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "language/arc_geometry.hpp"
#include "program_execution/thread_path.hpp"

namespace trunnion::analysis {
namespace {

using language::AxisValues;
using language::Command;
using language::CommandKind;

/// A move shorter than this (mm, degrees) on every axis is rounding, not motion.
constexpr double no_distance = 1e-9;

constexpr bool is_rotary(std::size_t axis) {
  return axis == language::A || axis == language::B || axis == language::C;
}

double rotary_length(const AxisValues& from, const AxisValues& to) {
  return std::hypot(to[language::A] - from[language::A], to[language::B] - from[language::B],
                    to[language::C] - from[language::C]);
}

double linear_length(const AxisValues& from, const AxisValues& to) {
  double square = 0;
  for (std::size_t axis = 0; axis < language::axis_count; ++axis) {
    const double way = is_rotary(axis) ? 0 : to[axis] - from[axis];
    square += way * way;
  }
  return std::sqrt(square);
}

double straight_length(const AxisValues& from, const AxisValues& to) {
  const double linear = linear_length(from, to);
  return linear > no_distance ? linear : rotary_length(from, to);
}

double arc_length(const AxisValues& from, const AxisValues& to, const language::Arc& arc) {
  const language::Vector3 normal = arc_normal(arc);
  double along = 0;
  double rise = 0;
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double offset = from[axis] - arc.centre[axis];
    along += offset * normal[axis];
    rise += (to[axis] - from[axis]) * normal[axis];
    square += offset * offset;
  }
  const double radius = std::sqrt(std::max(0.0, square - along * along));
  return std::hypot(radius * arc.sweep * std::numbers::pi / 180, rise);
}

std::optional<double> feed_of(const Command& command, double length) {
  const language::ModalState& modal = command.modal;
  if (command.kind == CommandKind::rapid) return std::nullopt;
  if (command.kind == CommandKind::tap) {
    const double speed = stroke_speed(command);
    return speed > 0 ? std::optional(std::abs(command.value) * speed) : std::nullopt;
  }
  switch (modal.feed_mode) {
    case language::FeedMode::inverse_time:
      return modal.feed * length;
    case language::FeedMode::per_revolution:
      if (modal.spindle_speed > 0) return modal.feed * modal.spindle_speed;
      return std::nullopt;
    case language::FeedMode::per_minute:
      break;
  }
  return modal.feed;
}

}  // namespace

language::Vector3 arc_normal(const language::Arc& arc) {
  if (arc.normal != language::Vector3{}) return arc.normal;
  language::Vector3 normal{};
  normal[language::plane_axes(arc.plane).normal] = 1;
  return normal;
}

AxisValues MotionTracker::to_machine(const Command& command, const AxisValues& point) const {
  return command.modal.transformation == language::Transformation::rtcp
             ? environment_.machine_from_tip(point, command.modal.tool_length)
             : point;
}

std::optional<Motion> MotionTracker::follow(const Command& command) {
  switch (command.kind) {
    case CommandKind::rapid:
    case CommandKind::line:
    case CommandKind::arc:
    case CommandKind::skip:
    case CommandKind::tap:
    case CommandKind::thread:
      break;
    case CommandKind::transformation:
    case CommandKind::home:
      target_ = command.target;
      machine_ = to_machine(command, command.target);
      return std::nullopt;
    default:
      return std::nullopt;
  }
  Motion motion;
  motion.program = command.program;
  motion.line = command.line;
  motion.kind = command.kind;
  motion.from = machine_;
  motion.mcs = to_machine(command, command.target);
  motion.wcs = interpreter_.workpiece(command);
  if (command.kind == CommandKind::arc) {
    motion.length = arc_length(target_, command.target, command.arc);
    motion.arc = command.arc;
    motion.turns = static_cast<std::uint32_t>(std::ceil(command.arc.sweep / 360 - 1e-9));
    AxisValues centre = command.target;
    for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = command.arc.centre[axis];
    centre = to_machine(command, centre);
    for (std::size_t axis = 0; axis < 3; ++axis) motion.arc.centre[axis] = centre[axis];
  } else {
    motion.length = straight_length(target_, command.target);
  }
  // Without a linear axis the length is that of the rotary ones already.
  const bool both =
      command.modal.transformation == language::Transformation::none &&
      (command.kind == CommandKind::arc || linear_length(target_, command.target) > no_distance);
  motion.combined = both ? std::hypot(motion.length, rotary_length(target_, command.target)) : motion.length;
  motion.feed = command.kind == CommandKind::thread
                    ? program_execution::thread_line(command, target_).modal.feed
                    : feed_of(command, motion.length);
  const bool combines = environment_.combined_feed() && command.kind != CommandKind::tap &&
                        command.modal.feed_mode != language::FeedMode::inverse_time;
  motion.counted = combines ? motion.combined : motion.length;
  target_ = command.target;
  machine_ = motion.mcs;
  if (motion.length <= no_distance) return std::nullopt;
  return motion;
}

std::optional<Motion> MotionTracker::follow(const Command& command, const Command& move) {
  const bool turns = command.modal.spindle_mode == language::SpindleMode::surface &&
                     command.modal.feed_mode == language::FeedMode::per_revolution &&
                     move.modal.feed_mode == language::FeedMode::per_minute;
  if (!turns) return follow(command);
  Command turned = command;
  turned.modal.feed = move.modal.feed, turned.modal.feed_mode = move.modal.feed_mode;
  return follow(turned);
}

}  // namespace trunnion::analysis
