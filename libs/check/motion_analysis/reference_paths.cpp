// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/reference_paths.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace trunnion::analysis {
namespace {

using language::Command;
using language::CommandKind;
using std::numbers::pi;

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Command line_to(const AxisValues& target, double feed_per_minute, std::size_t number) {
  Command command;
  command.kind = CommandKind::line;
  command.line = command.sequence = static_cast<std::uint32_t>(number);
  command.target = target;
  command.modal.feed = feed_per_minute;
  return command;
}

geometry::Chain trunnion_table() {
  geometry::ChainParameters p;
  p.table_1 = geometry::RotaryAxis{{-1, 0, 0}, {0, 0, 0}, 0};
  p.table_2 = geometry::RotaryAxis{{0, 0, -1}, {0, 0, -60}, 2};
  return std::get<geometry::Chain>(geometry::Chain::make(p));
}

struct Place {
  double x, y, z, slope_x, slope_y;
};

// The cap z = -r^2 / 160 with waves of 0.4 mm every 24 mm, along the winding line (20 + 8 sin 3f)(cos f, sin
// f).
Place cap(double f) {
  const double r = 20 + 8 * std::sin(3 * f);
  const double x = r * std::cos(f), y = r * std::sin(f);
  const double k = 2 * pi / 24;
  return {x, y, -(x * x + y * y) / 160 + 0.4 * std::sin(k * x) * std::cos(k * y),
          -x / 80 + 0.4 * k * std::cos(k * x) * std::cos(k * y),
          -y / 80 - 0.4 * k * std::sin(k * x) * std::sin(k * y)};
}

// The tool along the surface normal seen from the workpiece: (sin A sin C, -sin A cos C, cos A).
AxisValues pose(double f, bool five_axis, double& c_before) {
  const Place p = cap(f);
  AxisValues q{rounded(p.x), rounded(p.y), rounded(p.z)};
  if (!five_axis) return q;
  // Leaning the tool outwards by at least the slope keeps A away from 0, where C would be free.
  const double lean = 0.35;
  const double radius = std::hypot(p.x, p.y);
  const double nx = -p.slope_x + lean * p.x / radius, ny = -p.slope_y + lean * p.y / radius;
  q[language::A] = rounded(std::atan(std::hypot(nx, ny)) * 180 / pi);
  double c = std::atan2(nx, -ny) * 180 / pi;
  c += 360 * std::round((c_before - c) / 360);
  c_before = c;
  q[language::C] = rounded(c);
  return q;
}

ReferencePath along_cap(const std::string& name, double length, bool five_axis) {
  ReferencePath path;
  path.name = name;
  path.machine.limits = reference_limits();
  constexpr double feed = 2000, step = 0.1;
  double c = 0, f = 0;
  path.start = pose(f, five_axis, c);
  if (five_axis) {
    path.machine.chain = trunnion_table();
    path.transformation = language::Transformation::rtcp;
    path.tool_length = 100;
  }
  const auto count = static_cast<std::size_t>(std::lround(length / step));
  double travelled = 0;
  AxisValues before = path.start;
  for (std::size_t k = 1; k <= count; ++k) {
    // Steps of equal tip travel, to second order.
    const double h = 1e-5;
    const Place a = cap(f), b = cap(f + h);
    double df = step * h / std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
    const Place m = cap(f + df / 2), n = cap(f + df / 2 + h);
    df = step * h / std::hypot(n.x - m.x, n.y - m.y, n.z - m.z);
    f += df;
    const AxisValues q = pose(f, five_axis, c);
    travelled += std::hypot(q[0] - before[0], q[1] - before[1], q[2] - before[2]);
    before = q;
    path.program.push_back(line_to(q, feed, k));
  }
  path.feed_time = travelled / (feed / 60);
  return path;
}

}  // namespace

motion::Limits reference_limits() {
  motion::Limits limits;
  limits.axes.fill({500, 500, 3000, 60000});
  for (std::size_t i = language::A; i <= language::C; ++i) limits.axes[i] = {360, 360, 3000, 60000};
  limits.smoothing_cycles = 1;
  return limits;
}

ReferencePath single_line() {
  ReferencePath path;
  path.name = "line 100 mm";
  path.machine.limits = reference_limits();
  path.program = {line_to({100}, 30000, 1)};
  path.feed_time = 0.2;
  return path;
}

ReferencePath corner(double tolerance) {
  ReferencePath path;
  path.name = fmt::format("corner, tolerance {:g}", tolerance);
  path.machine.limits = reference_limits();
  path.machine.limits.contour_tolerance = tolerance;
  path.program = {line_to({50}, 6000, 1), line_to({50, 50}, 6000, 2)};
  path.feed_time = 1;
  return path;
}

ReferencePath circle(double feed) {
  ReferencePath path;
  path.name = fmt::format("circle R10 at {:g} mm/s", feed);
  path.machine.limits = reference_limits();
  path.start = {10};
  Command command = line_to({10}, feed * 60, 1);
  command.kind = CommandKind::arc;
  command.arc = {language::Plane::xy, false, {0, 0, 0}, 360};
  path.program = {command};
  path.feed_time = 20 * pi / feed;
  return path;
}

ReferencePath wavy_cap(double length) { return along_cap("five-axis wavy cap", length, true); }

ReferencePath dense_three_axis(double length) { return along_cap("dense three-axis", length, false); }

ReferencePath relief(int points, bool five_axis) {
  ReferencePath path;
  path.name = five_axis ? "five-axis relief" : "relief";
  path.machine.limits = reference_limits();
  if (five_axis) {
    path.machine.chain = trunnion_table();
    path.transformation = language::Transformation::rtcp;
    path.tool_length = 100;
  }
  constexpr int in_row = 101;
  constexpr double step = 0.12, feed = 6000;
  const auto place = [&](int k) {
    const int row = k / in_row, at = k % in_row;
    const double x = step * (row % 2 == 0 ? at : in_row - at), y = 0.25 * row;
    AxisValues q{x, y, 1.2 * std::sin(1.3 * x + y) + 0.15 * std::sin(4.1 * x - y)};
    if (five_axis) {
      q[language::A] = 20 + 10 * std::sin(0.4 * x);
      q[language::C] = 10 * std::sin(0.3 * x) + 20 * std::sin(0.05 * y);
    }
    for (double& v : q) v = std::round(v * 100) / 100;
    return q;
  };
  path.start = place(0);
  for (int k = 1; k < points; ++k)
    path.program.push_back(line_to(place(k), feed, static_cast<std::size_t>(k)));
  return path;
}

ReferencePath lines_and_arcs(int count) {
  ReferencePath path;
  path.name = "lines and arcs";
  path.machine.limits = reference_limits();
  AxisValues at{};
  for (int k = 1; k <= count; ++k) {
    // Along X, to the left, along Y, to the right.
    const int part = (k - 1) % 4;
    AxisValues to = at;
    if (part == 0) to[0] += 2;
    if (part == 2) to[1] += 2;
    if (part % 2 == 1) to[0] += 1, to[1] += 1;
    Command command = line_to(to, 6000, static_cast<std::size_t>(k));
    if (part % 2 == 1) {
      command.kind = CommandKind::arc;
      const bool right = part == 3;
      command.arc = {language::Plane::xy, right, {right ? to[0] : at[0], right ? at[1] : to[1], 0}, 90};
    }
    path.program.push_back(command);
    at = to;
  }
  return path;
}

std::string program_text(const ReferencePath& path) {
  std::string text = "G90 G94 G64\n";
  if (path.transformation == language::Transformation::rtcp) text += "T1 M6\nG43.4 H1\n";
  std::array<bool, language::axis_count> moves{true, true, true};
  for (const Command& command : path.program) {
    for (std::size_t i = 0; i < moves.size(); ++i) moves[i] = moves[i] || command.target[i] != path.start[i];
  }
  double feed = -1;
  for (const Command& command : path.program) {
    const bool arc = command.kind == CommandKind::arc;
    text += arc ? (command.arc.clockwise ? "G2" : "G3") : "G1";
    for (std::size_t i = 0; i < language::axis_count; ++i) {
      if (moves[i]) text += fmt::format(" {}{:.4f}", language::axis_letters[i], command.target[i]);
    }
    if (arc) {
      const AxisValues from = &command == &path.program.front() ? path.start : (&command - 1)->target;
      text +=
          fmt::format(" I{:.4f} J{:.4f}", command.arc.centre[0] - from[0], command.arc.centre[1] - from[1]);
    }
    if (command.modal.feed != feed) {
      feed = command.modal.feed;
      text += fmt::format(" F{:g}", feed);
    }
    text += '\n';
  }
  return text + "M30\n";
}

}  // namespace trunnion::analysis
