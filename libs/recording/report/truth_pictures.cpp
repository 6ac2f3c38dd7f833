// SPDX-License-Identifier: Apache-2.0
#include "report/truth_pictures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"
#include "report/plot.hpp"

namespace trunnion::report {
namespace {

constexpr int cells = 8, steps = 5;  // steps of a curve in each cell
constexpr double side = 300, left = 85, gap = 90, top = 60,
                 longest_error = 0.08;            // pixels; share of the travel
constexpr std::size_t most_circle_points = 1440;  // that are drawn of a circle
constexpr const char* ideal_style = "stroke=\"#afb8c1\" stroke-width=\"1\"";
constexpr const char* true_style = "stroke=\"#cf222e\" stroke-width=\"1.3\"";
constexpr const char* second_style = "stroke=\"#0969da\" stroke-width=\"1.3\"";

struct PicturePlane {
  std::size_t across, up;
  const char *across_name, *up_name;
};

struct GridPoint {
  double x, y, error_x, error_y;
};

GridPoint point(const truth::PoseReport& report, const machine::MachineOutline& machine,
                const PicturePlane& plane, double u, double v) {
  truth::MachinePose pose;
  for (std::size_t i = 0; i < 3; ++i) pose.positions[i] = (machine.axes[i].low + machine.axes[i].high) / 2;
  const auto at = [&](std::size_t axis, double share) {
    return machine.axes[axis].low + share * (machine.axes[axis].high - machine.axes[axis].low);
  };
  pose.positions[plane.across] = at(plane.across, u);
  pose.positions[plane.up] = at(plane.up, v);
  pose.tool_length = report.tool_length;
  pose.temperatures = report.temperatures;
  const auto tip = report.at(pose).deviation.tip;
  return {pose.positions[plane.across], pose.positions[plane.up],
          tip[static_cast<Eigen::Index>(plane.across)], tip[static_cast<Eigen::Index>(plane.up)]};
}

}  // namespace

std::string truth_picture(const truth::PoseReport& report, const machine::MachineOutline& machine,
                          const std::string& title) {
  constexpr PicturePlane planes[] = {{0, 1, "X mm", "Y mm"}, {0, 2, "X mm", "Z mm"}, {1, 2, "Y mm", "Z mm"}};
  const auto every_line = [&](const PicturePlane& plane, auto&& visit) {
    for (const bool along : {true, false})
      for (int i = 0; i <= cells; ++i) {
        std::vector<GridPoint> points;
        for (int k = 0; k <= cells * steps; ++k) {
          const double fixed = static_cast<double>(i) / cells,
                       moving = static_cast<double>(k) / (cells * steps);
          points.push_back(point(report, machine, plane, along ? moving : fixed, along ? fixed : moving));
        }
        visit(points);
      }
  };
  double largest = 0, smallest_travel = 1e9;
  for (const auto& plane : planes) {
    every_line(plane, [&](const std::vector<GridPoint>& points) {
      for (const auto& p : points) largest = std::max(largest, std::hypot(p.error_x, p.error_y));
    });
    smallest_travel = std::min(smallest_travel, machine.axes[plane.up].high - machine.axes[plane.up].low);
  }
  const double magnification =
      largest > 1e-9 ? round_down(longest_error * std::max(smallest_travel, 1.0) / largest) : 1;
  std::string content = text(left, 24, title, "font-size=\"15\" font-weight=\"600\"");
  const auto line = fmt::format("deviation of the tip magnified {:.0f} times; largest in a plane: {:.1f} um",
                                magnification, largest * 1e3);
  content += text(left, 42, line);
  double x = left;
  for (const auto& plane : planes) {
    const auto range = [&](std::size_t axis) {
      const double margin = 0.12 * std::max(machine.axes[axis].high - machine.axes[axis].low, 1.0);
      return Range{machine.axes[axis].low - margin, machine.axes[axis].high + margin};
    };
    Plot plot(x, top, side, side, range(plane.across), range(plane.up));
    plot.labels(plane.across_name, plane.up_name);
    every_line(plane, [&](const std::vector<GridPoint>& points) {
      std::vector<PlotPoint> ideal, actual;
      for (const auto& p : points) {
        ideal.push_back({p.x, p.y});
        actual.push_back({p.x + magnification * p.error_x, p.y + magnification * p.error_y});
      }
      plot.curve(ideal, ideal_style);
      plot.curve(actual, true_style);
    });
    content += plot.svg();
    x += side + gap;
  }
  return document(x - gap + 30, top + side + 60, content);
}

std::string ballbar_picture(const truth::BallbarMeasurement& measured, const std::string& title) {
  double largest = 1e-9;
  for (const auto* circle : {&measured.ccw, &measured.cw})
    for (const auto& reading : *circle) largest = std::max(largest, std::abs(reading.deviation));
  // Of a radius of 1 the largest deviation takes a third.
  const double division = round_down(largest * 1e3), magnification = 0.33 / largest;
  Plot plot(40, 60, 460, 460, {-1.45, 1.45}, {-1.45, 1.45});
  const auto circle = [&](double radius, const char* style) {
    std::vector<PlotPoint> points;
    for (int i = 0; i <= 180; ++i) {
      const auto [s, c] = geometry::sine_cosine(2.0 * i);
      points.push_back({radius * c, radius * s});
    }
    plot.curve(points, style);
  };
  for (int k = -3; k <= 3; ++k) circle(1 + 1e-3 * division * k * magnification, ideal_style);
  const auto trace = [&](const std::vector<geometry::RadialReading>& readings, const char* style) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < readings.size(); i += readings.size() / most_circle_points + 1) {
      const auto& reading = readings[i];
      const auto [s, c] = geometry::sine_cosine(reading.angle);
      const double radius = 1 + magnification * reading.deviation;
      points.push_back({radius * c, radius * s});
    }
    if (!points.empty()) points.push_back(points.front());
    plot.curve(points, style);
  };
  trace(measured.ccw, true_style);
  trace(measured.cw, second_style);
  const auto line =
      fmt::format("red counter-clockwise, blue clockwise; {:g} um for each circle of the grid", division);
  return document(
      540, 580,
      text(40, 24, title, "font-size=\"15\" font-weight=\"600\"") + text(40, 42, line) + plot.svg());
}

std::string laser_picture(const truth::LaserMeasurement& measured, const std::string& title, double unit,
                          const std::string& unit_name) {
  Range x{measured.targets.front().position, measured.targets.back().position}, y{0, 0};
  for (const auto& target : measured.targets)
    for (const auto* values : {&target.up, &target.down})
      for (const double value : *values) y = {std::min(y.low, value * unit), std::max(y.high, value * unit)};
  const double margin = std::max(0.1 * y.span(), 1e-3);
  y = {y.low - margin, y.high + margin};
  Plot plot(80, 60, 620, 320, x, y);
  plot.labels("mm", unit_name);
  for (std::size_t run = 0; run < measured.targets.front().up.size(); ++run) {
    std::vector<PlotPoint> up, down;
    for (const auto& target : measured.targets) {
      up.push_back({target.position, target.up[run] * unit});
      down.push_back({target.position, target.down[run] * unit});
    }
    plot.curve(up, true_style);
    plot.curve(down, second_style);
  }
  return document(740, 440,
                  text(80, 24, title, "font-size=\"15\" font-weight=\"600\"") +
                      text(80, 42, "red up, blue down") + plot.svg());
}

}  // namespace trunnion::report
