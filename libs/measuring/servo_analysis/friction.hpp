// SPDX-License-Identifier: Apache-2.0
// Friction and inertia of an axis by its torque.
#pragma once

#include <vector>

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

/// Torque at one constant speed, mean over the phase.
struct FrictionPoint {
  double speed = 0;   ///< signed, mm/s or deg/s
  double torque = 0;  ///< share of the rated torque
};

/// coulomb + (breakaway - coulomb) / (1 + (v / stribeck_speed)^2) + viscous |v|: the rational form of Hess
/// and Soom (1990). Shares of the rated torque.
struct FrictionModel {
  double coulomb = 0, breakaway = 0, viscous = 0;
  double stribeck_speed = 0;  ///< mm/s or deg/s; 0: the points show no Stribeck effect
  double gravity = 0;         ///< torque against the weight
  double residual = 0;        ///< root mean square
};

/// Of every constant phase of a trace that is longer than `settling` + 20 ms, which are left out at its
/// beginning.
std::vector<FrictionPoint> friction_points(const AxisTrace& trace, double settling = 0.1);
/// Least squares; needs points in both directions at two speeds at least, at four for the Stribeck effect.
/// Throws std::runtime_error.
FrictionModel identify_friction(const std::vector<FrictionPoint>& points);

/// Torque for an acceleration of 1 mm/s2 or deg/s2, share of the rated torque: least squares of torque =
/// inertia a
/// + coulomb sign(v) + viscous v + gravity over a motion with its accelerations.
double identify_inertia(const AxisTrace& trace);

}  // namespace trunnion::servo_analysis
