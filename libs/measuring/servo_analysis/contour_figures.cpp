// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/contour_figures.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/decompositions.hpp"

namespace trunnion::servo_analysis {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

double speed_at(const AxisTrace& t, std::size_t i) {
  return (t.setpoint[i + 1] - t.setpoint[i]) / t.interval;
}

// Centre x, y and radius by least squares of x^2 + y^2 = 2 x a + 2 y b + c.
Eigen::Vector3d fit_circle(const std::vector<double>& x, const std::vector<double>& y, std::size_t from,
                           std::size_t to) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = from; i < to; ++i) {
    const Eigen::Vector3d row(2 * (x[i] - x[from]), 2 * (y[i] - y[from]), 1);
    const double value = std::pow(x[i] - x[from], 2) + std::pow(y[i] - y[from], 2);
    normal += row * row.transpose();
    right += row * value;
  }
  const Eigen::Vector3d s = geometry::solve_symmetric(normal, right);
  return {s[0] + x[from], s[1] + y[from], std::sqrt(std::max(0.0, s[2] + s[0] * s[0] + s[1] * s[1]))};
}

}  // namespace

double time_lag(const AxisTrace& t) {
  double both = 0, square = 0;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double v = speed_at(t, i);
    both += (t.setpoint[i] - t.feedback[i]) * v;
    square += v * v;
  }
  return square > 0 ? both / square : 0;
}

RoundnessFigures roundness(const AxisTrace& a, const AxisTrace& b) {
  const std::size_t n = std::min(a.size(), b.size());
  // The longest stretch of constant speed along the path.
  std::size_t begin = 0, end = 0, from = 0;
  double speed = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double v = std::hypot(speed_at(a, i), speed_at(b, i));
    if (v > 1e-3 && std::abs(v - speed) <= 2e-3 * speed) {
      if (i + 1 - from > end - begin) begin = from, end = i + 1;
    } else {
      from = i, speed = v;
    }
  }
  const auto none = [] {
    return std::runtime_error("the axes have not made a whole turn at constant speed");
  };
  if (end < begin + 16) throw none();
  const auto circle = fit_circle(a.setpoint, b.setpoint, begin, end);
  const double omega = std::hypot(speed_at(a, begin), speed_at(b, begin)) / circle[2];
  const auto turn = static_cast<std::size_t>(std::llround(2 * std::numbers::pi / (omega * a.interval)));
  if (end - begin < turn + turn / 20) throw none();
  RoundnessFigures f;
  f.radius = circle[2];
  const auto angle_at = [&](std::size_t i) {
    return std::atan2(b.setpoint[i] - circle[1], a.setpoint[i] - circle[0]);
  };
  // The end is left out: the axes brake behind it.
  const std::size_t last = end, first = last - turn;
  const double sense = std::sin(angle_at(first + turn / 8) - angle_at(first)) > 0 ? 1 : -1;
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(turn), 5);
  Eigen::VectorXd values(static_cast<Eigen::Index>(turn));
  double low = 1e300, high = -1e300, sum = 0;
  for (std::size_t i = first; i < last; ++i) {
    const double angle = angle_at(i);
    const double r = std::hypot(a.feedback[i] - circle[0], b.feedback[i] - circle[1]) - circle[2];
    const auto k = static_cast<Eigen::Index>(i - first);
    rows.row(k) << 1, std::cos(angle), std::sin(angle), std::cos(2 * angle), std::sin(2 * angle);
    values[k] = r;
    sum += r;
    low = std::min(low, r), high = std::max(high, r);
    f.points.push_back({angle < 0 ? angle * degrees + 360 : angle * degrees, r});
  }
  f.deviation = high - low;
  f.radius_error = sum / static_cast<double>(turn);
  const Eigen::VectorXd s = geometry::least_squares(rows, values);
  // x lags by wx t, y by wy t: the radius changes by R w / 2 (tx - ty) sin 2 angle in the positive sense.
  f.mismatch = sense * 2 * s[4] / (circle[2] * omega) * 1e3;
  const Eigen::VectorXd rest = values - rows * s;
  for (std::size_t q = 0; q < 4; ++q) {
    double least = 1e300, most = -1e300;
    for (std::size_t i = 0; i < turn; ++i) {
      double past = sense * (f.points[i].angle - 90.0 * static_cast<double>(q));
      past -= 360 * std::round(past / 360);
      if (past < -2 || past > 10) continue;
      const double r = rest[static_cast<Eigen::Index>(i)];
      least = std::min(least, r), most = std::max(most, r);
    }
    f.quadrant_jump[q] = std::max(0.0, most - least);
  }
  return f;
}

SimultaneousFigures simultaneous_motion(const std::vector<AxisTrace>& linear, const AxisTrace& rotary) {
  SimultaneousFigures f;
  double fastest = 0;
  std::vector<double> peaks;
  for (const auto& axis : linear) {
    double peak = 0;
    for (std::size_t i = 0; i + 1 < axis.size(); ++i) peak = std::max(peak, std::abs(speed_at(axis, i)));
    peaks.push_back(peak);
    fastest = std::max(fastest, peak);
  }
  double least = 1e300, most = -1e300, sum = 0, count = 0;
  for (std::size_t k = 0; k < linear.size(); ++k) {
    const double lag = time_lag(linear[k]);
    f.lags.push_back(lag);
    if (peaks[k] < 0.05 * fastest || fastest == 0) continue;
    least = std::min(least, lag), most = std::max(most, lag), sum += lag, ++count;
  }
  const double turning = time_lag(rotary);
  f.lags.push_back(turning);
  if (count == 0) return f;
  f.linear = (most - least) * fastest;
  f.rotary = std::abs(turning - sum / count) * fastest;
  return f;
}

}  // namespace trunnion::servo_analysis
