// SPDX-License-Identifier: Apache-2.0
#include "report/servo_pictures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "geometry/angle.hpp"
#include "report/plot.hpp"

namespace trunnion::report {

using servo_analysis::BodeDiagram;
using servo_analysis::Curve;
using servo_analysis::Diagram;

namespace {

constexpr const char* curve_colours[] = {"#0969da", "#cf222e", "#1a7f37", "#9a6700", "#8250df"};
constexpr std::size_t most_curve_points = 4000;
constexpr const char* title_style = "font-size=\"15\" font-weight=\"600\"";

std::string style(std::size_t i) {
  return std::string("stroke=\"") + curve_colours[i % std::size(curve_colours)] + "\" stroke-width=\"1.3\"";
}

Range widened(Range r) {
  const double margin = std::max({0.05 * r.span(), 1e-9, 1e-6 * std::abs(r.high)});
  return {r.low - margin, r.high + margin};
}

std::vector<PlotPoint> thinned(const std::vector<servo_analysis::CurvePoint>& points) {
  const std::size_t step = points.size() / most_curve_points + 1;
  std::vector<PlotPoint> out;
  for (std::size_t i = 0; i < points.size(); i += step) out.push_back({points[i].x, points[i].y});
  return out;
}

std::string drawn(double top, double height, const Diagram& diagram) {
  const auto& curves = diagram.curves;
  Range rx{1e300, -1e300}, ry = rx;
  for (const auto& c : curves)
    for (const auto& p : c.points) {
      rx = {std::min(rx.low, p.x), std::max(rx.high, p.x)};
      ry = {std::min(ry.low, p.y), std::max(ry.high, p.y)};
    }
  if (rx.low > rx.high) rx = ry = {0, 1};
  Plot plot(80, top, 640, height, widened(rx), widened(ry));
  plot.labels(diagram.x, diagram.y);
  std::string legend;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    plot.curve(thinned(curves[i].points), style(i));
    legend += text(90 + 130.0 * static_cast<double>(i), top - 6, escaped(curves[i].name),
                   std::string("fill=\"") + curve_colours[i % std::size(curve_colours)] + "\"");
  }
  return plot.svg() + legend;
}

}  // namespace

std::string picture_of(const std::string& title, const Diagram& diagram) {
  return document(760, 450, text(80, 24, escaped(title), title_style) + drawn(60, 330, diagram));
}

std::string stacked_picture(const std::string& title, const std::vector<Diagram>& diagrams) {
  constexpr double height = 220, pitch = 290;
  std::string content = text(80, 24, title, title_style);
  double top = 60;
  for (const auto& d : diagrams) content += drawn(top, height, d), top += pitch;
  return document(760, top, content);
}

std::string picture_of(const std::string& title, const BodeDiagram& bode) {
  const auto magnitude = [](const std::string& name, const servo_analysis::Response& r) {
    Curve c{name, {}};
    for (const auto& p : r) c.points.push_back({std::log10(p.frequency), 20 * std::log10(std::abs(p.value))});
    return c;
  };
  const auto phase = [](const std::string& name, const servo_analysis::Response& r) {
    Curve c{name, {}};
    double before = 0;
    for (const auto& p : r) {
      double angle = std::arg(p.value) * 180 / std::numbers::pi;
      if (!c.points.empty()) angle -= 360 * std::round((angle - before) / 360);
      c.points.push_back({std::log10(p.frequency), before = angle});
    }
    return c;
  };
  const char* x = "log10 of the frequency in Hz";
  const Diagram magnitudes{
      x, "dB", {magnitude("closed loop", bode.closed), magnitude("open loop", bode.open)}};
  const Diagram phases{x, "deg", {phase("closed loop", bode.closed), phase("open loop", bode.open)}};
  return document(
      760, 640,
      text(80, 24, escaped(title), title_style) + drawn(60, 230, magnitudes) + drawn(350, 230, phases));
}

std::string picture_of(const std::string& title, const servo_analysis::RoundnessFigures& figures) {
  double largest = 1e-9;
  for (const auto& p : figures.points) largest = std::max(largest, std::abs(p.deviation));
  const double division = round_down(largest * 1e3), magnification = 0.33 / largest;
  Plot plot(40, 60, 460, 460, {-1.45, 1.45}, {-1.45, 1.45});
  const auto add = [&](auto&& radius_at, const char* stroke) {
    std::vector<PlotPoint> points;
    const std::size_t step = figures.points.size() / most_curve_points + 1;
    for (std::size_t i = 0; i < figures.points.size(); i += step) {
      const auto [s, c] = geometry::sine_cosine(figures.points[i].angle);
      const double r = radius_at(figures.points[i]);
      points.push_back({r * c, r * s});
    }
    plot.curve(points, stroke);
  };
  for (int k = -3; k <= 3; ++k)
    add([&](const auto&) { return 1 + 1e-3 * division * k * magnification; }, "stroke=\"#afb8c1\"");
  add([&](const auto& p) { return 1 + magnification * p.deviation; }, style(1).c_str());
  // Where an axis reverses: a line across the circle and the jump of the deviation there.
  std::string jumps;
  for (std::size_t q = 0; q < figures.quadrant_jump.size(); ++q) {
    const auto [s, c] = geometry::sine_cosine(90 * static_cast<double>(q));
    plot.curve({{0.6 * c, 0.6 * s}, {1.4 * c, 1.4 * s}}, "class=\"quadrant\" stroke=\"#57606a\"");
    const auto value = fmt::format("{:.1f} um", figures.quadrant_jump[q] * 1e3);
    jumps += text(plot.pixel_x(0.45 * c), plot.pixel_y(0.45 * s), value, "text-anchor=\"middle\"");
  }
  const auto line =
      fmt::format("{:g} um for each circle of the grid; inside: the jumps at the quadrants", division);
  return document(540, 560,
                  text(40, 24, escaped(title), title_style) + text(40, 42, line) + plot.svg() + jumps);
}

std::string picture_of(const servo_analysis::TestPicture& picture) {
  return std::visit([&](const auto& content) { return picture_of(picture.title, content); }, picture.content);
}

}  // namespace trunnion::report
