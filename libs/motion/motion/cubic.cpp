// SPDX-License-Identifier: Apache-2.0
#include "motion/cubic.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

using canonical::axis_count;

double square_of(const AxisValues& v, bool rotary) {
  double sum = 0;
  for (std::size_t i = 0; i < axis_count; ++i)
    if (canonical::is_rotary(i) == rotary) sum += v[i] * v[i];
  return sum;
}

}  // namespace

Cubic shifted(const Cubic& curve, double t) {
  Cubic result = curve;
  for (std::size_t i = 0; i < axis_count; ++i) {
    result[0][i] = curve[0][i] + t * (curve[1][i] + t * (curve[2][i] + t * curve[3][i]));
    result[1][i] = curve[1][i] + t * (2 * curve[2][i] + 3 * t * curve[3][i]);
    result[2][i] = curve[2][i] + 3 * t * curve[3][i];
  }
  return result;
}

CurveDeviation deviation_bound(const Cubic& curve, const AxisValues& start, const AxisValues& slope,
                               double length) {
  std::array<AxisValues, 4> points{};
  const double h = length;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double a = curve[0][i] - start[i], b = (curve[1][i] - slope[i]) * h, c = curve[2][i] * h * h,
                 d = curve[3][i] * h * h * h;
    points[0][i] = a;
    points[1][i] = a + b / 3;
    points[2][i] = a + (2 * b + c) / 3;
    points[3][i] = a + b + c + d;
  }
  CurveDeviation bound;
  for (const AxisValues& point : points) {
    bound.linear = std::max(bound.linear, square_of(point, false));
    bound.rotary = std::max(bound.rotary, square_of(point, true));
  }
  return {std::sqrt(bound.linear), std::sqrt(bound.rotary)};
}

}  // namespace trunnion::motion
