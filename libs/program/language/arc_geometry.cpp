// SPDX-License-Identifier: Apache-2.0
#include "language/arc_geometry.hpp"

#include <cmath>

namespace trunnion::language {
namespace {

/// Degrees in (0, 360] from the start's direction to the end's, both seen from the centre.
double sweep_between(double start_first, double start_second, double end_first, double end_second,
                     bool clockwise) {
  const double cross = start_first * end_second - start_second * end_first;
  const double dot = start_first * end_first + start_second * end_second;
  const double anticlockwise = std::atan2(cross, dot) * degrees_per_radian;
  const double sweep = clockwise ? -anticlockwise : anticlockwise;
  return sweep > 0 ? sweep : sweep + 360.0;
}

Vector3 normal_of(const Arc& arc) {
  Vector3 n = arc.normal;
  if (n == Vector3{}) n[plane_axes(arc.plane).normal] = 1;
  return n;
}

/// From the axis of the circle to `point`.
Vector3 arm_of(const AxisValues& point, const Arc& arc, const Vector3& n) {
  Vector3 d{point[0] - arc.centre[0], point[1] - arc.centre[1], point[2] - arc.centre[2]};
  const double along = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
  for (std::size_t i = 0; i < 3; ++i) d[i] -= along * n[i];
  return d;
}

/// `arm` a quarter turn anticlockwise.
Vector3 left_of(const Vector3& arm, const Vector3& n) {
  return {n[1] * arm[2] - n[2] * arm[1], n[2] * arm[0] - n[0] * arm[2], n[0] * arm[1] - n[1] * arm[0]};
}

}  // namespace

AlarmNumber arc_from_centre(const AxisValues& start, const AxisValues& target,
                            const std::array<double, 3>& centre_offset, unsigned turns, double deviation,
                            Arc& arc) {
  const auto [first, second, normal] = plane_axes(arc.plane);
  arc.centre[first] = start[first] + centre_offset[first];
  arc.centre[second] = start[second] + centre_offset[second];
  arc.centre[normal] = start[normal];
  const double start_first = -centre_offset[first];
  const double start_second = -centre_offset[second];
  const double end_first = target[first] - arc.centre[first];
  const double end_second = target[second] - arc.centre[second];
  const double start_radius = std::hypot(start_first, start_second);
  const double end_radius = std::hypot(end_first, end_second);
  if (start_radius < same_point) return AlarmNumber::arc_radius_zero;
  if (std::abs(start_radius - end_radius) > deviation) return AlarmNumber::arc_radii_differ;
  const bool full = std::hypot(target[first] - start[first], target[second] - start[second]) < same_point;
  arc.sweep = full ? 360.0 : sweep_between(start_first, start_second, end_first, end_second, arc.clockwise);
  arc.sweep += 360.0 * (turns - 1);
  return AlarmNumber::none;
}

AlarmNumber arc_from_radius(const AxisValues& start, const AxisValues& target, double radius, unsigned turns,
                            double deviation, Arc& arc) {
  const auto [first, second, normal] = plane_axes(arc.plane);
  if (std::abs(radius) < same_point) return AlarmNumber::arc_radius_zero;
  const double chord_first = target[first] - start[first];
  const double chord_second = target[second] - start[second];
  const double chord = std::hypot(chord_first, chord_second);
  if (chord < same_point) return AlarmNumber::arc_full_with_radius;
  const double half = chord / 2;
  const double size = std::abs(radius);
  if (half - size > deviation) return AlarmNumber::arc_radius_too_small;
  // (size - half) * (size + half) keeps its digits when the arc is nearly a half circle.
  const double height = half < size ? std::sqrt((size - half) * (size + half)) : 0.0;
  // The centre of the shorter anticlockwise arc is to the left of the chord; either change puts it to the
  // right.
  const double side = arc.clockwise != (radius < 0) ? -height : height;
  arc.centre[first] = start[first] + chord_first / 2 - side * chord_second / chord;
  arc.centre[second] = start[second] + chord_second / 2 + side * chord_first / chord;
  arc.centre[normal] = start[normal];
  // The sign of R decides which arc is meant, so a half circle never depends on rounding.
  const double angle = half < size ? 2 * std::asin(half / size) * degrees_per_radian : 180.0;
  arc.sweep = (radius < 0 ? 360.0 - angle : angle) + 360.0 * (turns - 1);
  return AlarmNumber::none;
}

AxisValues point_on_arc(const AxisValues& start, const AxisValues& target, const Arc& arc, double share) {
  const Vector3 n = normal_of(arc), from = arm_of(start, arc, n), to = arm_of(target, arc, n);
  const double radius = std::hypot(from[0], from[1], from[2]);
  const double growth = std::hypot(to[0], to[1], to[2]) - radius;
  const Vector3 left = left_of(from, n);
  const double sweep = arc.sweep / degrees_per_radian * (arc.clockwise ? -1 : 1);
  const auto on_circle = [&](double s, std::size_t i) {
    return (1 + growth * s / radius) * (std::cos(s * sweep) * from[i] + std::sin(s * sweep) * left[i]);
  };
  AxisValues point = start;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (axis > Z || !(radius > 0)) {
      point[axis] += share * (target[axis] - start[axis]);
      continue;
    }
    // What the circle does not reach goes in proportion: the rise, and the rounding of the sweep.
    const double rest = target[axis] - (start[axis] - from[axis]) - on_circle(1, axis);
    point[axis] += on_circle(share, axis) - from[axis] + share * rest;
  }
  return point;
}

// Along an axis the circle is from cos a + across sin a, a from 0 to the sweep.
std::array<double, 2> turning_shares(const AxisValues& start, const Arc& arc, std::size_t axis) {
  std::array<double, 2> shares{-1, -1};
  const Vector3 n = normal_of(arc), from = arm_of(start, arc, n), left = left_of(from, n);
  const double across = arc.clockwise ? -left[axis] : left[axis];
  if (from[axis] == 0 && across == 0) return shares;
  const double sweep = arc.sweep / degrees_per_radian;
  double angle = std::atan2(across, from[axis]);
  if (angle < 0) angle += std::numbers::pi;
  for (double& share : shares) {
    if (angle < sweep) share = angle / sweep;
    angle += std::numbers::pi;
  }
  return shares;
}

}  // namespace trunnion::language
