// SPDX-License-Identifier: Apache-2.0
#include "motion_analysis/lower_bound.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::analysis {
namespace {

struct Rates {
  AxisValues first{}, second{};
};

// Largest |x'| / 2 = |path acceleration| the axes leave at x in the direction `sign`.
double path_acceleration(const Rates& rates, double x, const motion::Limits& limits, double sign) {
  double u = 1e12;
  for (std::size_t i = 0; i < rates.first.size(); ++i) {
    const double a = limits.axes[i].acceleration;
    const double q1 = rates.first[i] * sign, q2 = rates.second[i] * x;
    if (q1 > 0) u = std::min(u, (a - q2) / q1);
    if (q1 < 0) u = std::min(u, (a + q2) / -q1);
  }
  return std::max(u, 0.0);
}

}  // namespace

void AccelerationBound::add(const PathSample& sample) {
  constexpr std::size_t window_samples = 20000;
  window_.push_back(sample);
  if (window_.size() >= window_samples) sweep(false);
}

void AccelerationBound::slow(double speed) {
  if (!window_.empty()) window_.back().speed = std::min(window_.back().speed, speed);
}

double AccelerationBound::finish() {
  sweep(true);
  window_.clear();
  continues_ = false;
  const double time = time_;
  time_ = 0;
  return time;
}

// Of a window that does not end the path only the part in front of its last third is kept: braking to rest at
// its end reaches less far.
void AccelerationBound::sweep(bool ends) {
  const std::vector<PathSample>& path = window_;
  const motion::Limits& limits = limits_;
  const std::size_t n = path.size();
  if (n < 2) return;
  std::vector<Rates> rates(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t a = k == 0 ? 0 : k - 1, c = k + 1 == n ? k : k + 1;
    const double h0 = path[k].s - path[a].s, h1 = path[c].s - path[k].s;
    for (std::size_t i = 0; i < path[k].machine.size(); ++i) {
      const double d0 = h0 > 0 ? (path[k].machine[i] - path[a].machine[i]) / h0 : 0;
      const double d1 = h1 > 0 ? (path[c].machine[i] - path[k].machine[i]) / h1 : 0;
      rates[k].first[i] = (path[c].machine[i] - path[a].machine[i]) / (h0 + h1);
      rates[k].second[i] = h0 > 0 && h1 > 0 ? (d1 - d0) / ((h0 + h1) / 2) : 0;
    }
  }
  std::vector<double> x(n);
  for (std::size_t k = 0; k < n; ++k) {
    x[k] = path[k].speed * path[k].speed;
    for (std::size_t i = 0; i < path[k].machine.size(); ++i) {
      const double q1 = std::abs(rates[k].first[i]), q2 = std::abs(rates[k].second[i]);
      if (q1 > 0) x[k] = std::min(x[k], std::pow(limits.axes[i].velocity / q1, 2));
      if (q2 > 0) x[k] = std::min(x[k], limits.axes[i].acceleration / q2);
    }
  }
  x.front() = x.back() = 0;
  for (std::size_t k = n - 1; k-- > 0;) {
    const double h = path[k + 1].s - path[k].s;
    x[k] = std::min(x[k], x[k + 1] + 2 * h * path_acceleration(rates[k + 1], x[k + 1], limits, -1));
  }
  if (continues_) x[0] = first_, x[1] = second_;
  for (std::size_t k = continues_ ? 1 : 0; k + 1 < n; ++k) {
    const double h = path[k + 1].s - path[k].s;
    x[k + 1] = std::min(x[k + 1], x[k] + 2 * h * path_acceleration(rates[k], x[k], limits, 1));
  }
  const std::size_t kept = ends ? n - 1 : n - n / 3;
  for (std::size_t k = continues_ ? 1 : 0; k < kept; ++k) {
    const double speed = std::sqrt(x[k]) + std::sqrt(x[k + 1]);
    if (speed > 0) time_ += 2 * (path[k + 1].s - path[k].s) / speed;
  }
  if (ends) return;
  // The place before the first goes along: its rates need it.
  first_ = x[kept - 1];
  second_ = x[kept];
  continues_ = true;
  window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(kept - 1));
}

// The ramp in the plane of speed v and acceleration u: backwards from (top, 0) with the strongest decrease of
// u that the jerk allows, forwards from (0, 0) with the strongest increase below that curve. The way down is
// the same in reverse.
double circle_time(double radius, double acceleration, double jerk) {
  const double top = std::min(std::sqrt(acceleration * radius), 0.999 * std::cbrt(jerk * radius * radius));
  const double step = 2e-6;
  const auto along = [&](double v, double u) {  // jerk left along the path by what it is across
    const double across = 3 * v * u / radius;
    return std::sqrt(std::max(0.0, jerk * jerk - across * across));
  };
  const auto most = [&](double v) {
    const double normal = v * v / radius;
    return std::min(std::sqrt(std::max(0.0, acceleration * acceleration - normal * normal)),
                    v > 0 ? 0.999 * jerk * radius / (3 * v) : acceleration);
  };
  constexpr std::size_t parts = 4096;
  std::vector<double> last(parts + 1, acceleration);  // the curve of the end over v
  std::size_t filled = parts;
  for (double v = top, u = 0; filled > 0;) {
    const double falls = along(v, u) - v * v * v / (radius * radius);
    u = std::min(u + std::max(falls, 1e-3 * jerk) * step, most(v));
    v = std::max(0.0, v - std::max(u, 1e-4 * acceleration) * step);
    const auto index = static_cast<std::size_t>(v / top * parts);
    while (filled > index) last[--filled] = u;
  }
  double v = 0, u = 0, time = 0, way = 0;
  while (v < top * (1 - 1e-5)) {
    u += std::min(jerk, v * v * v / (radius * radius) + along(v, u)) * step;
    u = std::min({u, most(v), last[static_cast<std::size_t>(v / top * parts)]});
    way += v * step;
    v += std::max(u, 1e-3 * acceleration) * step;
    time += step;
  }
  constexpr double pi = 3.14159265358979323846;
  return 2 * time + std::max(0.0, 2 * pi * radius - 2 * way) / top;
}

}  // namespace trunnion::analysis
