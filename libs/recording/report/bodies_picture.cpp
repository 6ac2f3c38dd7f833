// SPDX-License-Identifier: Apache-2.0
#include "report/bodies_picture.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"
#include "report/plot.hpp"

namespace trunnion::report {
namespace {

using collision::Vec3;

constexpr double view_side = 300, view_left = 85, view_gap = 90, view_top = 90;  // pixels
constexpr int around = 36, rings = 18;                                           // points of a round outline
constexpr double margin = 0.05;                                                  // share of the extent
constexpr const char* colours[]{"#0969da", "#1a7f37", "#9a6700", "#8250df", "#bc4c00", "#57606a"};

// Points of the surface whose hull is the body's outline.
std::vector<Vec3> points_of(const collision::Shape& shape) {
  if (const auto* hull = std::get_if<collision::Hull>(&shape)) return hull->points;
  std::vector<Vec3> points;
  if (const auto* box = std::get_if<collision::Box>(&shape)) {
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0}) points.push_back(box->half_lengths.cwiseProduct(Vec3(x, y, z)));
    return points;
  }
  const auto ring = [&](double radius, double z) {
    for (int i = 0; i < around; ++i) {
      const auto t = geometry::sine_cosine(360.0 * i / around);
      points.emplace_back(radius * t.cosine, radius * t.sine, z);
    }
  };
  if (const auto* cylinder = std::get_if<collision::Cylinder>(&shape)) {
    ring(cylinder->radius, -cylinder->half_height);
    ring(cylinder->radius, cylinder->half_height);
    return points;
  }
  const double radius = std::get<collision::Sphere>(shape).radius;
  for (int i = 0; i <= rings; ++i) {
    const auto t = geometry::sine_cosine(180.0 * i / rings - 90);
    ring(radius * t.cosine, radius * t.sine);
  }
  return points;
}

// Of points in the plane, counter-clockwise (Andrew, 1979).
std::vector<PlotPoint> hull_of(std::vector<PlotPoint> points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto turns_right = [](const PlotPoint& a, const PlotPoint& b, const PlotPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0;
  };
  std::vector<PlotPoint> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t first = hull.size();
    for (const auto& point : points) {
      while (hull.size() >= first + 2 && turns_right(hull[hull.size() - 2], hull.back(), point))
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  if (!hull.empty()) hull.push_back(hull.front());
  return hull;
}

}  // namespace

std::string bodies_picture(const collision::CollisionModel& model, const collision::AxisPosition& position,
                           const std::string& title) {
  std::array<std::vector<collision::Placement>, 2> links;
  for (const bool workpiece : {false, true})
    model.links().place(position, workpiece, links[workpiece ? 1 : 0]);
  std::vector<std::vector<Vec3>> bodies;
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (const auto& body : model.bodies()) {
    auto& points = bodies.emplace_back(points_of(body.shape));
    const auto& link = links[body.link.workpiece ? 1 : 0][body.link.depth];
    for (Vec3& point : points) {
      point = link * Vec3(body.rotation * point + body.position);
      low = low.cwiseMin(point), high = high.cwiseMax(point);
    }
  }
  const double extent = std::max(1.0, (high - low).maxCoeff()) * (1 + 2 * margin);
  const Vec3 middle = (low + high) / 2;
  const auto range = [&](int axis) { return Range{middle[axis] - extent / 2, middle[axis] + extent / 2}; };
  const auto nearest = model.nearest(position);
  struct View {
    int across, up;
    const char *title, *across_name, *up_name;
  };
  constexpr View views[]{{0, 2, "from the front", "X mm", "Z mm"},
                         {1, 2, "from the side (+X)", "Y mm", "Z mm"},
                         {0, 1, "from above", "X mm", "Y mm"}};
  std::string content = text(view_left, 24, escaped(title), "font-size=\"15\" font-weight=\"600\"");
  if (nearest)
    content += text(view_left, 44, escaped("nearest pair: " + model.text_of(*nearest)), "fill=\"#cf222e\"");
  double x = view_left;
  for (const View& view : views) {
    Plot plot(x, view_top, view_side, view_side, range(view.across), range(view.up));
    plot.title(view.title);
    plot.labels(view.across_name, view.up_name);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      std::vector<PlotPoint> flat;
      for (const Vec3& point : bodies[i]) flat.push_back({point[view.across], point[view.up]});
      const auto* colour = colours[i % std::size(colours)];
      plot.curve(hull_of(std::move(flat)), std::string("stroke=\"") + colour +
                                               "\" stroke-width=\"1.2\" style=\"fill: " + colour +
                                               "; fill-opacity: 0.12\"");
    }
    if (nearest)
      plot.curve({{nearest->on_first[view.across], nearest->on_first[view.up]},
                  {nearest->on_second[view.across], nearest->on_second[view.up]}},
                 "stroke=\"#cf222e\" stroke-width=\"2\"");
    content += plot.svg();
    x += view_side + view_gap;
  }
  double at = view_left, row = view_top + view_side + 60;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& name = model.bodies()[i].name;
    const double width = 30 + 8.0 * static_cast<double>(name.size());
    if (at + width > x) at = view_left, row += 20;
    content += line(at, row - 4, at + 14, row - 4,
                    std::string("stroke=\"") + colours[i % std::size(colours)] + "\" stroke-width=\"6\"");
    content += text(at + 18, row, escaped(name));
    at += width;
  }
  return document(x, row + 20, content);
}

}  // namespace trunnion::report
