// SPDX-License-Identifier: Apache-2.0
// The readings of a ball sensor while a rotary axis turns: noise, harmonics of the turn, directions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/types.hpp"

namespace trunnion::circular_tests {

using geometry::Vec3;

/// Extended Kalman filter with the state [x, y, w]: an error that turns with the angular velocity w (Qian and
/// Bi). Between two readings x and y are turned by w dt. The process noise of x and y is such that other
/// frequencies pass up to `cutoff`.
class RotatingErrorFilter {
 public:
  struct Settings {
    double interval = 0.0005;               ///< s between two readings
    double speed = 0.1;                     ///< rad/s, of the axis: the first w
    double variance_x = 0, variance_y = 0;  ///< mm2: of the readings before the motion
    double cutoff = 20;                     ///< Hz
  };
  explicit RotatingErrorFilter(const Settings& settings);

  /// The filtered error after one more reading, mm.
  std::array<double, 2> next(double x, double y);
  double speed() const { return state_[2]; }

 private:
  Settings settings_;
  Eigen::Matrix<double, 3, 1> state_ = Eigen::Matrix<double, 3, 1>::Zero();
  Eigen::Matrix<double, 3, 3> covariance_ = Eigen::Matrix<double, 3, 3>::Identity();
  bool started_ = false;
};

/// amplitude * sin(order * angle + phase).
struct TurnHarmonic {
  std::size_t order = 0;
  double amplitude = 0;  ///< in the unit of the values
  double phase = 0;      ///< deg
};

/// Fourier transform of values over one whole turn: orders 0 .. `orders`. `angles` (deg) ascend or descend
/// by 360; the values are interpolated at 8192 equal angles. Throws std::invalid_argument when the angles are
/// not a turn within 2 degrees.
std::vector<TurnHarmonic> turn_harmonics(const std::vector<double>& angles, const std::vector<double>& values,
                                         std::size_t orders);

/// Harmonics from the second order on that stand out: five times the median of these and above `least`.
std::vector<TurnHarmonic> harmonic_peaks(const std::vector<TurnHarmonic>& harmonics, double least);

double value_at(const std::vector<TurnHarmonic>& harmonics, double angle);

/// Range of the deviations in the directions of the circle of the ball about the axis.
struct DirectionRanges {
  double radial = 0, tangential = 0, axial = 0;  ///< largest less least, mm
};
/// `places`: of the ball, `axis`: unit vector, `centre`: a point of the axis; all in the frame of the
/// deviations, mm.
DirectionRanges direction_ranges(const std::vector<Vec3>& places, const std::vector<Vec3>& deviations,
                                 const Vec3& axis, const Vec3& centre);

}  // namespace trunnion::circular_tests
