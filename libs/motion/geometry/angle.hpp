// SPDX-License-Identifier: Apache-2.0
// Sine, cosine and the angle of a vector: fast, exact at quarter turns, the same bits on every processor.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace trunnion::geometry {

inline constexpr double radians_per_degree = std::numbers::pi / 180.0;

struct SineCosine {
  double sine = 0, cosine = 1;
};

/// Of an angle in degrees, within 1.5 units in the last place; exact at the multiples of 90, where tables and
/// heads usually are, after any number of revolutions. Infinite or not a number: both are not a number. The
/// C library chooses among implementations by processor, and replicas on two hosts must compute the same
/// bits: hence the series, cut where the next term is below 2^-58.
inline SineCosine sine_cosine(double degrees) {
  if (!(std::abs(degrees) < 1e12)) degrees = std::fmod(degrees, 360.0);
  // Adding and taking away 1.5 * 2^52 rounds to the nearest whole number.
  constexpr double round = 6755399441055744.0;
  const double quarter = (degrees * (1 / 90.0) + round) - round;
  const double x = (degrees - 90.0 * quarter) * radians_per_degree;
  const double y = x * x;
  double s = 1 / 355687428096000.0;  // 17!
  s = s * y - 1 / 1307674368000.0;
  s = s * y + 1 / 6227020800.0;
  s = s * y - 1 / 39916800.0;
  s = s * y + 1 / 362880.0;
  s = s * y - 1 / 5040.0;
  s = s * y + 1 / 120.0;
  s = s * y - 1 / 6.0;
  s = x + x * y * s;
  double c = 1 / 20922789888000.0;  // 16!
  c = c * y - 1 / 87178291200.0;
  c = c * y + 1 / 479001600.0;
  c = c * y - 1 / 3628800.0;
  c = c * y + 1 / 40320.0;
  c = c * y - 1 / 720.0;
  c = c * y + 1 / 24.0;
  c = 1 - (0.5 * y - y * y * c);
  switch (quarter == quarter ? static_cast<std::int64_t>(quarter) & 3 : 0) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// The angle of (x, y) from the x axis in radians, -pi .. pi, within 5e-16, small angles within 4e-16 of
/// themselves, multiples of a quarter turn exact; 0 of (0, 0), not a number of anything that is not finite.
/// For the reason above not the C library's: the arc tangent of the nearest sixteenth, and a series for the
/// rest.
inline double arc_tangent(double y, double x) {
  constexpr std::array<double, 17> sixteenths{0,
                                              0.06241880999595735,
                                              0.12435499454676144,
                                              0.18534794999569476,
                                              0.24497866312686414,
                                              0.3028848683749714,
                                              0.35877067027057225,
                                              0.4124104415973873,
                                              0.4636476090008061,
                                              0.5123894603107377,
                                              0.5585993153435624,
                                              0.6022873461349642,
                                              0.6435011087932844,
                                              0.6823165548747481,
                                              0.7188299996216245,
                                              0.7531512809621944,
                                              std::numbers::pi / 4};
  const double across = std::abs(y), along = std::abs(x);
  const bool steep = across > along;
  const double large = steep ? across : along, small = steep ? along : across;
  if (!(small <= large && large < std::numeric_limits<double>::infinity()))
    return std::numeric_limits<double>::quiet_NaN();
  if (large == 0) return 0;
  const int nearest = static_cast<int>(16 * (small / large) + 0.5);
  const double c = 0.0625 * nearest;
  const double r = (small - c * large) / (large + c * small), q = r * r;
  // Terms up to the ninth power, in two halves that do not wait for each other.
  const double s = (1 / 5.0 * q - 1 / 3.0) + q * q * (1 / 9.0 * q - 1 / 7.0);
  double angle = sixteenths[static_cast<std::size_t>(nearest)] + (r + r * q * s);
  if (steep) angle = std::numbers::pi / 2 - angle;
  if (x < 0) angle = std::numbers::pi - angle;
  return y < 0 ? -angle : angle;
}

/// The angle of two vectors in radians, 0 .. pi, accurate for any size of the angle and any length.
template <class A, class B>
double angle_between(const A& a, const B& b) {
  return arc_tangent(a.cross(b).norm(), a.dot(b));
}

}  // namespace trunnion::geometry
