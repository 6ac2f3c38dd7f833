// SPDX-License-Identifier: Apache-2.0
#include "analysis/offline_run.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/lower_bound.hpp"
#include "motion/axis_motion.hpp"
#include "motion/path_segment.hpp"

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
  const geometry::Chain* active =
      transformation == language::Transformation::rtcp && machine.chain ? &*machine.chain : nullptr;
  std::vector<PathSample> samples;
  AxisValues end = start;
  double s = 0;
  samples.push_back({0, motion::machine_axes(start, active, tool_length), 1e9});
  for (const Command& command : program) {
    if (command.kind != CommandKind::line && command.kind != CommandKind::arc &&
        command.kind != CommandKind::rapid)
      continue;
    const motion::PathSegment segment = command.kind == CommandKind::arc
                                            ? motion::PathSegment::arc(end, command.target, command.arc)
                                            : motion::PathSegment::line(end, command.target);
    end = command.target;
    const double length = segment.length();
    if (!(length > 1e-6)) continue;
    const bool inverse = command.modal.feed_mode == language::FeedMode::inverse_time;
    const double feed =
        command.kind == CommandKind::rapid ? 1e9 : command.modal.feed / 60 * (inverse ? length : 1);
    samples.back().speed = std::min(samples.back().speed, feed);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / step - 1e-6)));
    for (int k = 1; k <= parts; ++k) {
      samples.push_back({s + length * k / parts,
                         motion::machine_axes(segment.position(length * k / parts), active, tool_length),
                         feed});
    }
    s += length;
  }
  return acceleration_bound(samples, machine.limits);
}

}  // namespace trunnion::analysis
