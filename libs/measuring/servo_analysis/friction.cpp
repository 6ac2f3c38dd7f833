// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/friction.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "geometry/decompositions.hpp"
#include "servo_analysis/motion_figures.hpp"

namespace trunnion::servo_analysis {
namespace {

struct Solution {
  Eigen::VectorXd values;
  double squares = 0;
};

// Columns: coulomb sign, viscous, gravity, and the Stribeck part for a speed above zero.
Solution solve(const std::vector<FrictionPoint>& points, double stribeck_speed) {
  const auto n = static_cast<Eigen::Index>(points.size());
  const bool stribeck = stribeck_speed > 0;
  Eigen::MatrixXd rows(n, stribeck ? 4 : 3);
  Eigen::VectorXd torque(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& p = points[static_cast<std::size_t>(i)];
    const double sign = p.speed > 0 ? 1 : -1;
    rows(i, 0) = sign, rows(i, 1) = p.speed, rows(i, 2) = 1;
    if (stribeck) rows(i, 3) = sign / (1 + std::pow(p.speed / stribeck_speed, 2));
    torque[i] = p.torque;
  }
  Solution s;
  s.values = geometry::least_squares(rows, torque);
  s.squares = (torque - rows * s.values).squaredNorm();
  return s;
}

}  // namespace

std::vector<FrictionPoint> friction_points(const AxisTrace& t, double settling) {
  std::vector<FrictionPoint> points;
  const auto settle = static_cast<std::size_t>(settling / t.interval);
  for (const auto& p : constant_phases(t, settling + 0.02)) {
    double sum = 0;
    for (std::size_t i = p.begin + settle; i < p.end; ++i) sum += t.torque[i];
    points.push_back({p.speed, sum / static_cast<double>(p.end - p.begin - settle)});
  }
  return points;
}

FrictionModel identify_friction(const std::vector<FrictionPoint>& points) {
  std::set<long> speeds;
  bool up = false, down = false;
  double slowest = 1e300, fastest = 0;
  for (const auto& p : points) {
    speeds.insert(std::lround(std::log(std::abs(p.speed)) * 50));
    up = up || p.speed > 0, down = down || p.speed < 0;
    slowest = std::min(slowest, std::abs(p.speed)), fastest = std::max(fastest, std::abs(p.speed));
  }
  if (!up || !down || speeds.size() < 2)
    throw std::runtime_error("friction needs constant speeds in both directions, two at least");
  auto best = solve(points, 0);
  double stribeck = 0;
  if (speeds.size() >= 4) {
    // One local minimum is searched by a grid and refined; the other values are linear.
    const double low = std::log(slowest / 4), high = std::log(fastest);
    const auto squares = [&](double x) { return solve(points, std::exp(x)).squares; };
    constexpr int steps = 60;
    int at = 0;
    for (int i = 1; i <= steps; ++i)
      if (squares(low + (high - low) * i / steps) < squares(low + (high - low) * at / steps)) at = i;
    double a = low + (high - low) * (at - 1) / steps, b = low + (high - low) * (at + 1) / steps;
    for (int i = 0; i < 60; ++i) {
      const double third = (b - a) / 3;
      squares(a + third) < squares(b - third) ? b -= third : a += third;
    }
    const auto found = solve(points, std::exp((a + b) / 2));
    // A Stribeck effect is one when it explains much of what is left.
    if (found.squares < 0.5 * best.squares && found.values[3] > 0 && best.squares > 1e-16)
      best = found, stribeck = std::exp((a + b) / 2);
  }
  FrictionModel m;
  m.coulomb = best.values[0], m.viscous = best.values[1], m.gravity = best.values[2];
  m.breakaway = m.coulomb + (stribeck > 0 ? best.values[3] : 0);
  m.stribeck_speed = stribeck;
  m.residual = std::sqrt(best.squares / static_cast<double>(points.size()));
  return m;
}

double identify_inertia(const AxisTrace& t) {
  const auto window = static_cast<std::size_t>(std::max(1.0, std::round(0.004 / t.interval)));
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i + window < t.size(); ++i) {
    const double v = t.speed[i + window / 2];
    if (std::abs(v) < 0.5) continue;
    double torque = 0;
    for (std::size_t k = 0; k < window; ++k) torque += t.torque[i + k];
    const double a = (t.speed[i + window] - t.speed[i]) / (static_cast<double>(window) * t.interval);
    const Eigen::Vector4d row(a, v > 0 ? 1 : -1, v, 1);
    normal += row * row.transpose();
    right += row * (torque / static_cast<double>(window));
  }
  const Eigen::Vector4d s = geometry::solve_symmetric(normal, right);
  if (!s.allFinite() || !(s[0] > 0))
    throw std::runtime_error("the motion has no accelerations from which the inertia follows");
  return s[0];
}

}  // namespace trunnion::servo_analysis
