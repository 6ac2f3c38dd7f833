// Sine and cosine of machine angles: fast, exact at quarter turns, the same bits on every processor.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace trunnion::geometry {

inline constexpr double radians_per_degree = std::numbers::pi / 180.0;

struct SineCosine {
  double sine = 0, cosine = 1;
};

/// Of an angle in degrees, within 1.5 units in the last place; exact at the multiples of 90, where tables and
/// heads usually stand, after any number of revolutions. Infinite or not a number: both are not a number. The
/// C library chooses among implementations by processor, and twins on two hosts must compute the same bits:
/// hence the series, cut where the next term is below 2^-58.
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

/// The angle of two vectors in radians, 0 .. pi, accurate for any size of the angle and any length.
template <class A, class B>
double angle_between(const A& a, const B& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace trunnion::geometry
