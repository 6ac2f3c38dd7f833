// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/offline_run.hpp"

#include <algorithm>
#include <cmath>

#include "motion/axis_motion.hpp"
#include "motion/path_segment.hpp"
#include "motion_analysis/lower_bound.hpp"

namespace trunnion::analysis {

using language::Command;
using language::CommandKind;

RunReport run_commands(const MachineModel& machine, const AxisValues& start,
                       language::Transformation transformation, double tool_length,
                       const std::vector<Command>& program, const OverrideHistory& overrides,
                       std::size_t most_cycles, bool check_contour) {
  const geometry::Chain* chain = machine.chain ? &*machine.chain : nullptr;
  const geometry::Chain* active = transformation == language::Transformation::rtcp ? chain : nullptr;
  motion::Trajectory trajectory(machine.limits, chain, machine.cycle_seconds);
  trajectory.start(start, transformation, tool_length);
  LimitCheck limits(machine.limits, motion::machine_axes(start, active, tool_length), machine.cycle_seconds);
  ContourCheck contour(start, machine.limits.contour_tolerance, machine.limits.orientation_tolerance);
  if (check_contour) {
    for (const Command& command : program) contour.add(command);
  }
  RunReport report;
  std::size_t next = 0;
  bool finished = false;
  while (report.cycles < most_cycles) {
    while (next < program.size() && trajectory.can_accept()) {
      if (!trajectory.push(program[next++])) return report;
    }
    if (next == program.size() && !finished) {
      trajectory.finish();
      finished = true;
    }
    const motion::Overrides o = overrides ? overrides(report.cycles) : motion::Overrides{};
    const motion::Setpoint setpoint = trajectory.step(o.feed, o.rapid, o.hold);
    ++report.cycles;
    limits.add(motion::machine_axes(setpoint.position, active, tool_length), setpoint.rapid);
    if (check_contour) {
      const Deviation d = contour.of(setpoint.position, setpoint.sequence);
      report.deviation.contour = std::max(report.deviation.contour, d.contour);
      report.deviation.orientation = std::max(report.deviation.orientation, d.orientation);
    }
    if (finished && setpoint.at_rest) {
      report.stopped = program.empty() || setpoint.position == trajectory.end_position();
      break;
    }
  }
  report.motion_time = static_cast<double>(limits.moving_cycles()) * machine.cycle_seconds;
  report.axes = limits.axes();
  report.worst = limits.worst();
  return report;
}

double command_bound(const MachineModel& machine, const AxisValues& start,
                     language::Transformation transformation, double tool_length,
                     const std::vector<Command>& program, double step) {
  CommandBound bound(machine);
  bound.begin(start, transformation, tool_length);
  for (const Command& command : program) bound.add(command, step);
  return bound.finish();
}

void CommandBound::begin(const AxisValues& start, language::Transformation transformation,
                         double tool_length) {
  active_ = transformation == language::Transformation::rtcp && machine_.chain ? &*machine_.chain : nullptr;
  tool_length_ = tool_length;
  end_ = start;
  s_ = 0;
  bound_.add({0, motion::machine_axes(start, active_, tool_length_), 1e9});
}

void CommandBound::add(const Command& command, double step) {
  if (command.kind != CommandKind::line && command.kind != CommandKind::arc &&
      command.kind != CommandKind::rapid)
    return;
  const motion::PathSegment segment = command.kind == CommandKind::arc
                                          ? motion::PathSegment::arc(end_, command.target, command.arc)
                                          : motion::PathSegment::line(end_, command.target);
  end_ = command.target;
  const double length = segment.length();
  if (!(length > 1e-6)) return;
  const bool inverse = command.modal.feed_mode == language::FeedMode::inverse_time;
  const bool combined = machine_.limits.combined_feed && active_ == nullptr;
  const double scale = inverse ? length : combined ? segment.combined_feed_scale() : segment.feed_scale();
  const double feed = command.kind == CommandKind::rapid ? 1e9 : command.modal.feed / 60 * scale;
  bound_.slow(feed);
  const int parts = std::max(1, static_cast<int>(std::ceil(length / step - 1e-6)));
  for (int k = 1; k <= parts; ++k)
    bound_.add({s_ + length * k / parts,
                motion::machine_axes(segment.position(length * k / parts), active_, tool_length_), feed});
  s_ += length;
}

}  // namespace trunnion::analysis
