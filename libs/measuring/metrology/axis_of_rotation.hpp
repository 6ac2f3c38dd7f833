// SPDX-License-Identifier: Apache-2.0
// The axis about which a sphere turns, from its centres at known angles.
#pragma once

#include <variant>
#include <vector>

#include "metrology/sphere.hpp"

namespace trunnion::metrology {

struct TurnedCentre {
  double angle = 0;            ///< deg, of the axis
  Vec3 centre = Vec3::Zero();  ///< mm
};

/// Limits of the manual (A650, settings 55647 and 55648), deg.
struct AxisLimits {
  double least_triangle_angle = 2;  ///< in the triangle of three centres; 2 .. 60
  double least_swept_angle = 10;    ///< from the first to the last angle; 10 .. 180
};

struct AxisFit {
  Vec3 direction = Vec3::UnitZ();  ///< unit vector; a positive angle turns about it by the right-hand rule
  Vec3 centre = Vec3::Zero();      ///< mm: of the circle; a point of the axis
  double radius = 0;               ///< mm
  double swept_angle = 0;          ///< deg, from the least to the greatest angle
  double triangle_angle = 0;       ///< deg: the least in the triangle of the widest three centres
  std::vector<Vec3> residuals;     ///< mm: centre less the nearest point of the circle; zero for 3 centres
  /// Covariance for centres of variance 1 in each direction: of the point (mm2) and of the direction. With
  /// three centres the variance of a centre must come from its touches.
  Mat3 centre_cofactor = Mat3::Zero(), direction_cofactor = Mat3::Zero();
  double variance = 0;      ///< mm2: of a centre, from the residuals; 0 without freedom
  std::size_t freedom = 0;  ///< 2 n - 6
};

enum class AxisError {
  too_few,         ///< fewer than 3 centres
  not_finite,      ///< a coordinate or an angle is not a finite number
  triangle_angle,  ///< the centres are too close to a line: below AxisLimits::least_triangle_angle
  swept_angle,     ///< below AxisLimits::least_swept_angle
  no_sense,        ///< the order of the centres does not agree with the angles
};

/// The plane through the centres gives the direction, signed by the sense of rotation, the circle in it the
/// point. Exact for 3 centres, else least squares of the distances along and across the axis.
std::variant<AxisFit, AxisError> fit_axis(const std::vector<TurnedCentre>& centres,
                                          const AxisLimits& limits = {});

/// Least angle in the triangle of three points, deg; 0 where two coincide.
double least_triangle_angle(const Vec3& a, const Vec3& b, const Vec3& c);

/// The meaning of `error`, in words, without numbers.
const char* to_string(AxisError error);

}  // namespace trunnion::metrology
