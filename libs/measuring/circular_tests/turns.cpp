// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/turns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "geometry/angle.hpp"

namespace trunnion::circular_tests {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double on_circle = 0.01;   // of the radius
constexpr double least_sweep = 360;  // deg
constexpr std::size_t spread = 50;   // samples between the points of a trial circle

double angle_of(const PlanePoint& p, const PlanePoint& centre) {
  return geometry::arc_tangent(p.second - centre.second, p.first - centre.first) * degrees;
}

double radius_of(const PlanePoint& p, const PlanePoint& centre) {
  return std::hypot(p.first - centre.first, p.second - centre.second);
}

double turned(double from, double to) {
  const double difference = to - from;
  return difference - 360 * std::round(difference / 360);
}

// The circle through three points; none when they are on a line.
std::optional<ProgrammedCircle> through(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const double bx = b.first - a.first, by = b.second - a.second, cx = c.first - a.first,
               cy = c.second - a.second;
  const double area = 2 * (bx * cy - by * cx), bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  if (std::abs(area) < 1e-9 * std::sqrt(bb * cc) || area == 0) return std::nullopt;
  const double x = (cy * bb - by * cc) / area, y = (bx * cc - cx * bb) / area;
  return ProgrammedCircle{{a.first + x, a.second + y}, std::hypot(x, y)};
}

}  // namespace

std::vector<Turn> turns_on(const std::vector<PlanePoint>& commanded, const ProgrammedCircle& circle) {
  std::vector<Turn> turns;
  std::vector<double> swept;  // deg since the start of the stretch, by sample
  std::size_t begin = 0;
  int sense = 0;
  const auto close = [&](std::size_t end) {
    const double sweep = swept.empty() ? 0 : swept.back();
    if (sense != 0 && std::abs(sweep) >= least_sweep - 1e-6) {
      const double overrun = (std::abs(sweep) - least_sweep) / 2;
      Turn turn;
      turn.sense = sense, turn.overrun = overrun;
      const auto first =
          std::find_if(swept.begin(), swept.end(), [&](double s) { return std::abs(s) >= overrun - 1e-9; });
      const auto last = std::find_if(first, swept.end(),
                                     [&](double s) { return std::abs(s) >= overrun + least_sweep - 1e-9; });
      turn.begin = begin + static_cast<std::size_t>(first - swept.begin());
      turn.end = std::min(end, begin + static_cast<std::size_t>(last - swept.begin()));
      const double start = angle_of(commanded[turn.begin], circle.centre);
      turn.start = start < 0 ? start + 360 : start;
      turns.push_back(turn);
    }
    swept.clear(), sense = 0;
  };
  for (std::size_t i = 0; i < commanded.size(); ++i) {
    const double r = radius_of(commanded[i], circle.centre);
    if (std::abs(r - circle.radius) > on_circle * circle.radius) {
      close(i);
      continue;
    }
    if (swept.empty()) {
      begin = i, swept.push_back(0);
      continue;
    }
    const double step =
        turned(angle_of(commanded[i - 1], circle.centre), angle_of(commanded[i], circle.centre));
    const int now = std::abs(step) < 1e-7 ? 0 : step > 0 ? 1 : -1;
    if (now != 0 && sense != 0 && now != sense) {
      close(i);
      begin = i - 1, swept.push_back(0);
    }
    if (now != 0) sense = now;
    swept.push_back(swept.back() + (now == 0 ? 0 : step));
  }
  close(commanded.size());
  return turns;
}

ProgrammedCircle find_circle(const std::vector<PlanePoint>& commanded, double tolerance) {
  for (std::size_t i = 0; i + 2 * spread < commanded.size(); i += spread) {
    const auto circle = through(commanded[i], commanded[i + spread], commanded[i + 2 * spread]);
    if (!circle || circle->radius > 1e5) continue;
    // The three points are near each other, so the tolerance of the trial is wider than that of the circle
    // through points that are a third of a turn apart.
    double sweep = 0;
    std::size_t k = i;
    std::vector<std::size_t> thirds;
    while (k + 1 < commanded.size() && std::abs(sweep) < 360 &&
           std::abs(radius_of(commanded[k + 1], circle->centre) - circle->radius) <
               std::max(tolerance, on_circle * circle->radius)) {
      sweep += turned(angle_of(commanded[k], circle->centre), angle_of(commanded[k + 1], circle->centre));
      ++k;
      if (std::abs(sweep) >= 120.0 * static_cast<double>(thirds.size() + 1)) thirds.push_back(k);
    }
    if (std::abs(sweep) < 360 || thirds.size() < 3) continue;
    const auto exact = through(commanded[thirds[0]], commanded[thirds[1]], commanded[thirds[2]]);
    if (exact && std::all_of(commanded.begin() + static_cast<std::ptrdiff_t>(i),
                             commanded.begin() + static_cast<std::ptrdiff_t>(k), [&](const auto& p) {
                               return std::abs(radius_of(p, exact->centre) - exact->radius) <= tolerance;
                             }))
      return *exact;
  }
  throw std::runtime_error("there is no circle of a whole turn in this plane");
}

std::vector<RadialReading> readings_of(const std::vector<PlanePoint>& actual, const Turn& turn,
                                       const ProgrammedCircle& circle) {
  std::vector<RadialReading> readings;
  for (std::size_t i = turn.begin; i < std::min(turn.end, actual.size()); ++i)
    readings.push_back(
        {angle_of(actual[i], circle.centre), radius_of(actual[i], circle.centre) - circle.radius});
  return readings;
}

double feed_reached(const std::vector<PlanePoint>& commanded, const Turn& turn, double interval) {
  double way = 0;
  for (std::size_t i = turn.begin; i + 1 < turn.end; ++i)
    way += std::hypot(commanded[i + 1].first - commanded[i].first,
                      commanded[i + 1].second - commanded[i].second);
  return way / (static_cast<double>(turn.end - turn.begin - 1) * interval) * 60;
}

}  // namespace trunnion::circular_tests
