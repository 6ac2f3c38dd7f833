// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/servo_response.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

#include "geometry/decompositions.hpp"

namespace trunnion::servo_analysis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int fit_steps = 60;
constexpr std::size_t least_samples = 16;

// x' = A x + B u by exact steps for an input that is linear between its samples (first-order hold).
class LinearSystem {
 public:
  LinearSystem(const MatrixXd& a, const MatrixXd& b, double interval) {
    const Index n = a.rows(), m = b.cols();
    MatrixXd whole = MatrixXd::Zero(n + 2 * m, n + 2 * m);
    whole.topLeftCorner(n, n) = a * interval;
    whole.block(0, n, n, m) = b * interval;
    whole.block(n, n + m, m, m).setIdentity();
    const MatrixXd step = whole.exp();
    state_ = step.topLeftCorner(n, n);
    begin_ = step.block(0, n, n, m);
    change_ = step.block(0, n + m, n, m);
  }
  VectorXd next(const VectorXd& x, const VectorXd& now, const VectorXd& then) const {
    return state_ * x + begin_ * now + change_ * (then - now);
  }

 private:
  MatrixXd state_, begin_, change_;
};

// Hv in the controllable form: states q, q'; speed = wn^2 (q + tau q').
MatrixXd speed_states(const ServoResponse& r) {
  MatrixXd a(2, 2);
  a << 0, 1, -r.natural_frequency * r.natural_frequency, -2 * r.damping * r.natural_frequency;
  return a;
}

double speed_of(const ServoResponse& r, const VectorXd& x) {
  return r.natural_frequency * r.natural_frequency * (x[0] + r.zero_time * x[1]);
}

ServoResponse with(const Eigen::Vector3d& logarithms) {
  ServoResponse r;
  r.natural_frequency = std::exp(logarithms[0]);
  r.damping = std::exp(logarithms[1]);
  r.zero_time = std::exp(logarithms[2]);
  return r;
}

VectorXd residual(const Eigen::Vector3d& logarithms, const AxisTrace& t) {
  const auto model = predicted_speeds(with(logarithms), t.speed_set, t.interval);
  VectorXd r(static_cast<Index>(t.size()));
  for (std::size_t i = 0; i < t.size(); ++i) r[static_cast<Index>(i)] = t.speed[i] - model[i];
  return r;
}

// The best of a grid: the least squares have other minima far away.
Eigen::Vector3d start_of(const AxisTrace& t) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double least = 1e300;
  for (const double frequency : {50.0, 150.0, 450.0, 1350.0})
    for (const double damping : {0.4, 1.0, 2.5})
      for (const double share : {0.1, 1.0}) {
        const Eigen::Vector3d x(std::log(frequency), std::log(damping),
                                std::log(share * 2 * damping / frequency));
        const double sum = residual(x, t).squaredNorm();
        if (sum < least) least = sum, best = x;
      }
  return best;
}

std::vector<double> slopes(const std::vector<double>& values, double interval) {
  std::vector<double> slope(values.size(), 0);
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    slope[i] = (values[i + 1] - values[i - 1]) / (2 * interval);
  return slope;
}

}  // namespace

std::vector<double> predicted_speeds(const ServoResponse& r, const std::vector<double>& setpoints,
                                     double interval) {
  const LinearSystem system(speed_states(r), Eigen::Vector2d(0, 1), interval);
  std::vector<double> speeds;
  speeds.reserve(setpoints.size());
  VectorXd x = VectorXd::Zero(2), now(1), then(1);
  for (std::size_t i = 0; i < setpoints.size(); ++i) {
    if (i == 0) {
      x[0] = setpoints[0] / (r.natural_frequency * r.natural_frequency);
    } else {
      now[0] = setpoints[i - 1], then[0] = setpoints[i];
      x = system.next(x, now, then);
    }
    speeds.push_back(speed_of(r, x));
  }
  return speeds;
}

std::vector<double> predicted_positions(const ServoResponse& r, const std::vector<double>& setpoints,
                                        double interval) {
  // States q, q', position; inputs setpoint and its slope.
  const double square = r.natural_frequency * r.natural_frequency;
  MatrixXd a = MatrixXd::Zero(3, 3), b = MatrixXd::Zero(3, 2);
  a.topLeftCorner(2, 2) = speed_states(r);
  a(1, 2) = -r.position_gain;
  a(2, 0) = square, a(2, 1) = square * r.zero_time;
  b(1, 0) = r.position_gain, b(1, 1) = r.feedforward;
  const LinearSystem system(a, b, interval);
  const auto slope = slopes(setpoints, interval);
  std::vector<double> positions;
  positions.reserve(setpoints.size());
  VectorXd x = VectorXd::Zero(3);
  if (!setpoints.empty()) x[2] = setpoints[0];
  for (std::size_t i = 0; i < setpoints.size(); ++i) {
    if (i > 0)
      x = system.next(x, Eigen::Vector2d(setpoints[i - 1], slope[i - 1]),
                      Eigen::Vector2d(setpoints[i], slope[i]));
    positions.push_back(x[2]);
  }
  return positions;
}

ServoResponse fit_servo_response(const AxisTrace& t) {
  if (t.size() < least_samples) throw std::runtime_error("a servo's response needs at least 16 samples");
  const Eigen::Map<const VectorXd> speed(t.speed.data(), static_cast<Index>(t.size()));
  const double variation = (speed.array() - speed.mean()).matrix().norm();
  if (!(variation > 1e-6)) throw std::runtime_error("a servo's response needs an axis that moves");
  Eigen::Vector3d x = start_of(t);
  VectorXd r = residual(x, t);
  double damping = 1e-3;
  for (int step = 0; step < fit_steps && damping < 1e8; ++step) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> slope(r.size(), 3);
    for (Index k = 0; k < 3; ++k) {
      Eigen::Vector3d moved = x;
      moved[k] += 1e-5;
      slope.col(k) = (residual(moved, t) - r) / 1e-5;
    }
    const Eigen::Matrix3d normal = slope.transpose() * slope;
    const Eigen::Vector3d right = slope.transpose() * r;
    bool better = false;
    while (!better && damping < 1e8) {
      Eigen::Matrix3d damped = normal;
      damped.diagonal() *= 1 + damping;
      const Eigen::Vector3d change = -geometry::solve_symmetric(damped, right);
      const Eigen::Vector3d next = x + change.cwiseMax(-2).cwiseMin(2);
      const VectorXd there = residual(next, t);
      better = there.allFinite() && there.squaredNorm() < r.squaredNorm();
      if (!better) {
        damping *= 10;
        continue;
      }
      const bool still = r.squaredNorm() - there.squaredNorm() < 1e-12 * r.squaredNorm();
      x = next, r = there, damping = std::max(damping / 10, 1e-12);
      if (still) damping = 1e9;
    }
  }
  auto response = with(x);
  response.fit = 100 * (1 - r.norm() / variation);
  // setpoint of the speed - excitation = Kv error + kv slope of the setpoint
  const auto slope = slopes(t.setpoint, t.interval);
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Eigen::Vector2d row(t.setpoint[i] - t.feedback[i], slope[i]);
    normal += row * row.transpose();
    right += row * (t.speed_set[i] - t.excitation[i]);
  }
  const Eigen::Vector2d gains = geometry::solve_symmetric(normal, right);
  response.position_gain = gains[0], response.feedforward = gains[1];
  return response;
}

}  // namespace trunnion::servo_analysis
