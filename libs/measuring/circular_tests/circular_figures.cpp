// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/circular_figures.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/angle.hpp"
#include "geometry/decompositions.hpp"

namespace trunnion::circular_tests {
namespace {

constexpr std::size_t least_readings = 8;
constexpr int fit_steps = 6, section_steps = 40;

std::vector<Eigen::Vector2d> points_of(Readings readings, double radius) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(readings.size());
  for (const auto& reading : readings) {
    const auto [s, c] = geometry::sine_cosine(reading.angle);
    points.emplace_back((radius + reading.deviation) * c, (radius + reading.deviation) * s);
  }
  return points;
}

struct Zone {
  double least = 1e300, largest = -1e300;
  double span() const { return largest - least; }
};

Zone zone_about(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& centre) {
  Zone zone;
  for (const auto& point : points) {
    const double r = (point - centre).norm();
    zone.least = std::min(zone.least, r), zone.largest = std::max(zone.largest, r);
  }
  return zone;
}

// Minimum of a convex function within low .. high.
template <class Function>
double golden_section(double low, double high, Function&& value) {
  constexpr double share = 0.6180339887498949;
  double a = high - share * (high - low), b = low + share * (high - low);
  double at_a = value(a), at_b = value(b);
  for (int i = 0; i < section_steps; ++i) {
    if (at_a <= at_b) {
      high = b, b = a, at_b = at_a;
      a = high - share * (high - low), at_a = value(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + share * (high - low), at_b = value(b);
    }
  }
  return (low + high) / 2;
}

// Of a path in the order of its angles: the deviation at `angle` by interpolation.
class PathByAngle {
 public:
  explicit PathByAngle(Readings readings) {
    for (const auto& r : readings)
      sorted_.push_back({r.angle - 360 * std::floor(r.angle / 360), r.deviation});
    std::sort(sorted_.begin(), sorted_.end(), [](const auto& a, const auto& b) { return a.angle < b.angle; });
  }

  double at(double angle) const {
    angle -= 360 * std::floor(angle / 360);
    const auto above = std::upper_bound(sorted_.begin(), sorted_.end(), angle,
                                        [](double a, const RadialReading& r) { return a < r.angle; });
    auto after = above == sorted_.end() ? sorted_.front() : *above;
    auto before = above == sorted_.begin() ? sorted_.back() : *(above - 1);
    if (above == sorted_.end()) after.angle += 360;
    if (above == sorted_.begin()) before.angle -= 360;
    const double gap = after.angle - before.angle;
    const double share = gap > 0 ? (angle - before.angle) / gap : 0;
    return before.deviation + share * (after.deviation - before.deviation);
  }

 private:
  std::vector<RadialReading> sorted_;
};

std::pair<double, double> range_of(Readings readings) {
  double least = 1e300, largest = -1e300;
  for (const auto& r : readings)
    least = std::min(least, r.deviation), largest = std::max(largest, r.deviation);
  return {least, largest};
}

void check(Readings readings, double radius) {
  if (!(radius > 0)) throw std::invalid_argument("the radius of a circle must be above zero");
  if (!readings.empty() && readings.size() < least_readings)
    throw std::invalid_argument("a circular test needs at least eight readings of each path");
  for (const auto& r : readings)
    if (!std::isfinite(r.angle) || !(std::abs(r.deviation) < radius / 2))
      throw std::invalid_argument("a reading of a circular test is not near the programmed circle");
}

}  // namespace

ReferenceCircle least_squares_circle(Readings readings, double radius) {
  const auto points = points_of(readings, radius);
  Eigen::Vector3d x(0, 0, radius);
  for (int step = 0; step < fit_steps; ++step) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const auto& point : points) {
      const Eigen::Vector2d from = point - x.head<2>();
      const double r = from.norm();
      const Eigen::Vector3d row(from[0] / r, from[1] / r, 1);
      normal += row * row.transpose();
      right += row * (r - x[2]);
    }
    x += geometry::solve_symmetric(normal, right);
  }
  const auto zone = zone_about(points, x.head<2>());
  return {x[0], x[1], x[2] - radius, zone.least - x[2], zone.largest - x[2]};
}

ReferenceCircle minimum_zone_circle(Readings readings, double radius) {
  const auto points = points_of(readings, radius);
  const auto start = least_squares_circle(readings, radius);
  // The centre is nearer to that of the least squares than the range about it.
  const double reach = std::max(2 * start.span(), 1e-9);
  const auto best_second = [&](double first) {
    return golden_section(start.second - reach, start.second + reach, [&](double second) {
      return zone_about(points, {first, second}).span();
    });
  };
  const double first = golden_section(start.first - reach, start.first + reach, [&](double x) {
    return zone_about(points, {x, best_second(x)}).span();
  });
  const double second = best_second(first);
  const auto zone = zone_about(points, {first, second});
  const double mean = (zone.least + zone.largest) / 2;
  return {first, second, mean - radius, zone.least - mean, zone.largest - mean};
}

CircularFigures circular_figures(Readings ccw, Readings cw, double radius) {
  check(ccw, radius), check(cw, radius);
  CircularFigures f;
  if (!ccw.empty()) {
    f.deviation_ccw = minimum_zone_circle(ccw, radius).span();
    f.squares_ccw = least_squares_circle(ccw, radius).span();
    std::tie(f.radial_least_ccw, f.radial_largest_ccw) = range_of(ccw);
  }
  if (!cw.empty()) {
    f.deviation_cw = minimum_zone_circle(cw, radius).span();
    f.squares_cw = least_squares_circle(cw, radius).span();
    std::tie(f.radial_least_cw, f.radial_largest_cw) = range_of(cw);
  }
  std::vector<RadialReading> both(ccw.begin(), ccw.end());
  both.insert(both.end(), cw.begin(), cw.end());
  if (both.empty()) return f;
  f.fitted = least_squares_circle(both, radius);
  f.mean_radial = f.fitted.radius;
  if (ccw.empty() || cw.empty()) return f;
  f.bidirectional = minimum_zone_circle(both, radius).span();
  f.squares_both = f.fitted.span();
  const PathByAngle other(cw);
  for (const auto& r : ccw) {
    const double difference = std::abs(r.deviation - other.at(r.angle));
    if (difference <= f.hysteresis) continue;
    f.hysteresis = difference;
    f.hysteresis_angle = r.angle - 360 * std::floor(r.angle / 360);
  }
  return f;
}

}  // namespace trunnion::circular_tests
