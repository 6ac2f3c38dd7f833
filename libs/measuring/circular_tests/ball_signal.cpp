// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/ball_signal.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

#include "geometry/angle.hpp"

namespace trunnion::circular_tests {
namespace {

constexpr std::size_t places_of_turn = 8192;
constexpr double whole_turn = 2;  // deg that a turn may lack
constexpr double least_variance =
    1e-8;                             // mm2: of 0.1 um, so that a spike of the servo does not turn the error
constexpr double speed_share = 1e-3;  // of w: its standard deviation in a second
constexpr double stands_out = 5;

}  // namespace

RotatingErrorFilter::RotatingErrorFilter(const Settings& settings) : settings_(settings) {
  settings_.variance_x = std::max(settings_.variance_x, least_variance);
  settings_.variance_y = std::max(settings_.variance_y, least_variance);
}

std::array<double, 2> RotatingErrorFilter::next(double x, double y) {
  const double dt = settings_.interval;
  const Eigen::DiagonalMatrix<double, 2> noise(settings_.variance_x, settings_.variance_y);
  if (!started_) {
    started_ = true;
    state_ << x, y, settings_.speed;
    covariance_.setZero();
    covariance_(0, 0) = settings_.variance_x, covariance_(1, 1) = settings_.variance_y;
    covariance_(2, 2) = std::pow(1e-3 * settings_.speed, 2);
    return {x, y};
  }
  const double turn = state_[2] * dt, c = std::cos(turn), s = std::sin(turn);
  const double px = c * state_[0] - s * state_[1], py = s * state_[0] + c * state_[1];
  Eigen::Matrix3d transition = Eigen::Matrix3d::Identity();
  transition(0, 0) = c, transition(0, 1) = -s, transition(0, 2) = -dt * py;
  transition(1, 0) = s, transition(1, 1) = c, transition(1, 2) = dt * px;
  // A first-order filter of this cutoff has the gain 2 pi f dt, which this ratio of the noises gives.
  const double ratio = std::pow(2 * std::numbers::pi * settings_.cutoff * dt, 2);
  const Eigen::DiagonalMatrix<double, 3> process(ratio * settings_.variance_x, ratio * settings_.variance_y,
                                                 std::pow(speed_share * settings_.speed, 2) * dt);
  state_[0] = px, state_[1] = py;
  covariance_ = transition * covariance_ * transition.transpose();
  covariance_ += process.toDenseMatrix();
  const Eigen::Matrix2d spread = covariance_.topLeftCorner<2, 2>() + noise.toDenseMatrix();
  const Eigen::Matrix<double, 3, 2> gain = covariance_.leftCols<2>() * spread.inverse();
  state_ += gain * (Eigen::Vector2d(x, y) - state_.head<2>());
  covariance_ -= gain * covariance_.topRows<2>();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  return {state_[0], state_[1]};
}

std::vector<TurnHarmonic> turn_harmonics(const std::vector<double>& angles, const std::vector<double>& values,
                                         std::size_t orders) {
  if (angles.size() < 8 || angles.size() != values.size() ||
      std::abs(std::abs(angles.back() - angles.front()) - 360) > whole_turn || orders >= places_of_turn / 2)
    throw std::invalid_argument("the harmonics of a turn need readings over 360 degrees");
  const double sense = angles.back() > angles.front() ? 1 : -1;
  std::vector<double> even(places_of_turn);
  std::size_t i = 0;
  for (std::size_t k = 0; k < places_of_turn; ++k) {
    const double past = 360.0 * static_cast<double>(k) / static_cast<double>(places_of_turn);
    while (i + 2 < angles.size() && sense * (angles[i + 1] - angles.front()) < past) ++i;
    const double gap = angles[i + 1] - angles[i];
    const double share =
        gap == 0 ? 0 : std::clamp((angles.front() + sense * past - angles[i]) / gap, 0.0, 1.0);
    even[k] = values[i] + share * (values[i + 1] - values[i]);
  }
  Eigen::FFT<double> transform;
  std::vector<std::complex<double>> lines;
  transform.fwd(lines, even);
  std::vector<TurnHarmonic> harmonics;
  for (std::size_t order = 0; order <= orders; ++order) {
    // value = Re(line e^(i order past)); as sin(order angle + phase) with angle = first + sense past.
    const auto line = lines[order] * (order == 0 ? 1.0 : 2.0) / static_cast<double>(places_of_turn);
    const double cosine_phase = std::arg(line) * 180 / std::numbers::pi;
    double phase = sense > 0 ? cosine_phase + 90 - static_cast<double>(order) * angles.front()
                             : 90 - cosine_phase - static_cast<double>(order) * angles.front();
    phase -= 360 * std::floor(phase / 360);
    harmonics.push_back({order, std::abs(line), phase});
  }
  return harmonics;
}

std::vector<TurnHarmonic> harmonic_peaks(const std::vector<TurnHarmonic>& harmonics, double least) {
  std::vector<double> amplitudes;
  for (const auto& h : harmonics)
    if (h.order >= 2) amplitudes.push_back(h.amplitude);
  if (amplitudes.empty()) return {};
  const auto middle = amplitudes.begin() + static_cast<std::ptrdiff_t>(amplitudes.size() / 2);
  std::nth_element(amplitudes.begin(), middle, amplitudes.end());
  std::vector<TurnHarmonic> peaks;
  for (const auto& h : harmonics)
    if (h.order >= 2 && h.amplitude >= least && h.amplitude > stands_out * *middle) peaks.push_back(h);
  return peaks;
}

double value_at(const std::vector<TurnHarmonic>& harmonics, double angle) {
  double value = 0;
  for (const auto& h : harmonics)
    value += h.amplitude * geometry::sine_cosine(static_cast<double>(h.order) * angle + h.phase).sine;
  return value;
}

DirectionRanges direction_ranges(const std::vector<Vec3>& places, const std::vector<Vec3>& deviations,
                                 const Vec3& axis, const Vec3& centre) {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  for (std::size_t i = 0; i < std::min(places.size(), deviations.size()); ++i) {
    Vec3 radial = places[i] - centre;
    radial -= axis * axis.dot(radial);
    radial.normalize();
    const Vec3 parts(radial.dot(deviations[i]), axis.cross(radial).dot(deviations[i]),
                     axis.dot(deviations[i]));
    low = low.cwiseMin(parts), high = high.cwiseMax(parts);
  }
  if (low[0] > high[0]) return {};
  const Vec3 range = high - low;
  return {range[0], range[1], range[2]};
}

}  // namespace trunnion::circular_tests
