#include "planning/lower_bound.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::planning {
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

double acceleration_bound(const std::vector<PathSample>& path, const motion::Limits& limits) {
  const std::size_t n = path.size();
  if (n < 2) return 0;
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
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double h = path[k + 1].s - path[k].s;
    x[k + 1] = std::min(x[k + 1], x[k] + 2 * h * path_acceleration(rates[k], x[k], limits, 1));
  }
  double time = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double speed = std::sqrt(x[k]) + std::sqrt(x[k + 1]);
    if (speed > 0) time += 2 * (path[k + 1].s - path[k].s) / speed;
  }
  return time;
}

}  // namespace trunnion::planning
