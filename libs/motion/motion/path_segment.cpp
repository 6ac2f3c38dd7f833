// SPDX-License-Identifier: Apache-2.0
#include "motion/path_segment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::motion {
namespace {

using canonical::axis_count;

double norm3(const AxisValues& v, std::size_t first) {
  return std::hypot(v[first], v[first + 1], v[first + 2]);
}

}  // namespace

PathSegment PathSegment::line(const AxisValues& start, const AxisValues& target) {
  PathSegment segment;
  segment.start_ = start;
  segment.target_ = target;
  for (std::size_t i = 0; i < axis_count; ++i) segment.slope_[i] = target[i] - start[i];
  const double rotary = norm3(segment.slope_, canonical::A);
  const double main = norm3(segment.slope_, canonical::X), secondary = norm3(segment.slope_, canonical::U);
  const double trace = 1e-6 * std::max(rotary, secondary);
  const double counted = main > trace ? main : secondary > 1e-6 * rotary ? secondary : rotary;
  const double longest = std::max({main, secondary, rotary});
  // A path coordinate that hardly grows while an axis travels far would be all rounding.
  const bool scaled = counted < 1e-3 * longest;
  segment.length_ = scaled ? longest : counted;
  const bool by_rotary =
      scaled ? rotary >= std::max(main, secondary) : !(main > trace) && !(secondary > 1e-6 * rotary);
  segment.unit_ = by_rotary && rotary > 0 ? LengthUnit::degree : LengthUnit::millimetre;
  segment.feed_scale_ = counted > 0 ? segment.length_ / counted : 1;
  for (double& slope : segment.slope_) slope = segment.length_ > 0 ? slope / segment.length_ : 0;
  return segment;
}

double PathSegment::combined_feed_scale() const {
  const double rotary = norm3(slope_, canonical::A);
  if (!(rotary > 0) || unit_ == LengthUnit::degree) return feed_scale_;
  return 1 / std::hypot(1 / feed_scale_, rotary);
}

PathSegment PathSegment::curve(const Cubic& curve, double length, const AxisValues& target, bool meets) {
  PathSegment segment;
  segment.start_ = curve[0];
  segment.slope_ = curve[1];
  segment.square_ = curve[2];
  segment.cube_ = curve[3];
  segment.target_ = target;
  segment.length_ = length;
  segment.is_curve_ = true;
  segment.meets_target_ = meets;
  return segment;
}

PathSegment PathSegment::arc(const AxisValues& start, const AxisValues& target, const canonical::Arc& arc) {
  if (arc.normal != canonical::Vector3{}) return tilted_arc(start, target, arc);
  const auto [p, q, along] = canonical::plane_axes(arc.plane);
  const double start_radius = std::hypot(start[p] - arc.centre[p], start[q] - arc.centre[q]);
  const double end_radius = std::hypot(target[p] - arc.centre[p], target[q] - arc.centre[q]);
  const double sweep = arc.sweep * (std::numbers::pi / 180.0) * (arc.clockwise ? -1 : 1);
  const double mean_radius = 0.5 * (start_radius + end_radius);
  PathSegment segment;
  segment.length_ =
      std::hypot(std::abs(sweep) * mean_radius, end_radius - start_radius, target[along] - start[along]);
  if (!(start_radius > 0) || !(end_radius > 0) || !(segment.length_ > 0)) return line(start, target);

  segment.start_ = start;
  segment.target_ = target;
  segment.is_arc_ = true;
  segment.plane_ = {p, q};
  segment.centre_ = {arc.centre[p], arc.centre[q]};
  segment.radius_ = start_radius;
  segment.radius_slope_ = (end_radius - start_radius) / segment.length_;
  segment.angle_ = std::atan2(start[q] - arc.centre[q], start[p] - arc.centre[p]);
  segment.angle_slope_ = sweep / segment.length_;
  for (std::size_t i = 0; i < axis_count; ++i) segment.slope_[i] = (target[i] - start[i]) / segment.length_;
  // In the plane the proportional part only closes the gap that rounding of the programmed sweep leaves.
  const double end_angle = segment.angle_ + sweep;
  segment.slope_[p] = (target[p] - (segment.centre_[0] + end_radius * std::cos(end_angle))) / segment.length_;
  segment.slope_[q] = (target[q] - (segment.centre_[1] + end_radius * std::sin(end_angle))) / segment.length_;
  // For a spiral the second derivative is -r w^2 radially and 2 r' w along the arc.
  const double w = std::abs(segment.angle_slope_);
  segment.curvature_ =
      std::hypot(std::max(start_radius, end_radius) * w * w, 2 * std::abs(segment.radius_slope_) * w);
  return segment;
}

PathSegment PathSegment::tilted_arc(const AxisValues& start, const AxisValues& target,
                                    const canonical::Arc& arc) {
  using canonical::Vector3;
  const Vector3& n = arc.normal;
  const auto dot = [](const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  // From the axis of the circle, at right angles to it.
  const auto arm = [&](const AxisValues& p) {
    const Vector3 d{p[0] - arc.centre[0], p[1] - arc.centre[1], p[2] - arc.centre[2]};
    const double along = dot(d, n);
    return Vector3{d[0] - along * n[0], d[1] - along * n[1], d[2] - along * n[2]};
  };
  const Vector3 from = arm(start), to = arm(target);
  const double start_radius = std::hypot(from[0], from[1], from[2]);
  const double end_radius = std::hypot(to[0], to[1], to[2]);
  const double rise = dot({target[0] - start[0], target[1] - start[1], target[2] - start[2]}, n);
  const double sweep = arc.sweep * (std::numbers::pi / 180.0) * (arc.clockwise ? -1 : 1);
  PathSegment segment;
  segment.length_ =
      std::hypot(std::abs(sweep) * 0.5 * (start_radius + end_radius), end_radius - start_radius, rise);
  if (!(start_radius > 0) || !(end_radius > 0) || !(segment.length_ > 0)) return line(start, target);

  segment.start_ = start;
  segment.target_ = target;
  segment.is_arc_ = segment.is_tilted_ = true;
  segment.first_ = {from[0] / start_radius, from[1] / start_radius, from[2] / start_radius};
  const Vector3& u = segment.first_;
  segment.second_ = {n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
  segment.radius_ = start_radius;
  segment.radius_slope_ = (end_radius - start_radius) / segment.length_;
  segment.angle_slope_ = sweep / segment.length_;
  for (std::size_t i = 0; i < axis_count; ++i) segment.slope_[i] = (target[i] - start[i]) / segment.length_;
  // What the circle does not do itself, the proportional part does: the rise, and the rounding of the sweep.
  for (std::size_t i = 0; i < 3; ++i) {
    segment.hub_[i] = start[i] - from[i];
    const double end = end_radius * (std::cos(sweep) * u[i] + std::sin(sweep) * segment.second_[i]);
    segment.slope_[i] = (target[i] - segment.hub_[i] - end) / segment.length_;
  }
  const double w = std::abs(segment.angle_slope_);
  segment.curvature_ =
      std::hypot(std::max(start_radius, end_radius) * w * w, 2 * std::abs(segment.radius_slope_) * w);
  return segment;
}

AxisValues PathSegment::position(double s) const {
  if (s >= length_ && meets_target_) return target_;
  if (s <= 0) return start_;
  AxisValues position{};
  if (is_curve_) {
    s = std::min(s, length_);
    for (std::size_t i = 0; i < axis_count; ++i)
      position[i] = start_[i] + s * (slope_[i] + s * (square_[i] + s * cube_[i]));
    return position;
  }
  for (std::size_t i = 0; i < axis_count; ++i) position[i] = start_[i] + slope_[i] * s;
  if (is_arc_) {
    const double radius = radius_ + radius_slope_ * s;
    const double angle = angle_ + angle_slope_ * s;
    if (is_tilted_) {
      for (std::size_t i = 0; i < 3; ++i) {
        position[i] =
            hub_[i] + slope_[i] * s + radius * (std::cos(angle) * first_[i] + std::sin(angle) * second_[i]);
      }
      return position;
    }
    position[plane_[0]] = centre_[0] + radius * std::cos(angle) + slope_[plane_[0]] * s;
    position[plane_[1]] = centre_[1] + radius * std::sin(angle) + slope_[plane_[1]] * s;
  }
  return position;
}

AxisValues PathSegment::derivative(double s) const {
  if (is_curve_) return derivatives(s)[0];
  AxisValues derivative = slope_;
  if (is_arc_) {
    const double radius = radius_ + radius_slope_ * s;
    const double angle = angle_ + angle_slope_ * s;
    const double sine = std::sin(angle);
    const double cosine = std::cos(angle);
    if (is_tilted_) {
      for (std::size_t i = 0; i < 3; ++i) {
        derivative[i] += radius_slope_ * (cosine * first_[i] + sine * second_[i]) +
                         radius * angle_slope_ * (cosine * second_[i] - sine * first_[i]);
      }
      return derivative;
    }
    derivative[plane_[0]] += radius_slope_ * cosine - radius * angle_slope_ * sine;
    derivative[plane_[1]] += radius_slope_ * sine + radius * angle_slope_ * cosine;
  }
  return derivative;
}

// In polar coordinates with a radius and an angle that grow linearly, e radial and n along the arc:
// P' = r' e + r w n, P'' = 2 r' w n - r w^2 e, P''' = -3 r' w^2 e - r w^3 n.
std::array<AxisValues, 3> PathSegment::derivatives(double s) const {
  std::array<AxisValues, 3> d{slope_, AxisValues{}, AxisValues{}};
  if (is_curve_) {
    for (std::size_t i = 0; i < axis_count; ++i) {
      d[0][i] += s * (2 * square_[i] + 3 * s * cube_[i]);
      d[1][i] = 2 * square_[i] + 6 * s * cube_[i];
      d[2][i] = 6 * cube_[i];
    }
    return d;
  }
  if (!is_arc_) return d;
  const double r = radius_ + radius_slope_ * s, w = angle_slope_, dr = radius_slope_;
  const double angle = angle_ + angle_slope_ * s;
  const std::array<double, 2> e{std::cos(angle), std::sin(angle)}, n{-e[1], e[0]};
  if (is_tilted_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double along = e[0] * first_[i] + e[1] * second_[i],
                   across = e[0] * second_[i] - e[1] * first_[i];
      d[0][i] += dr * along + r * w * across;
      d[1][i] = 2 * dr * w * across - r * w * w * along;
      d[2][i] = -3 * dr * w * w * along - r * w * w * w * across;
    }
    return d;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    d[0][plane_[k]] += dr * e[k] + r * w * n[k];
    d[1][plane_[k]] = 2 * dr * w * n[k] - r * w * w * e[k];
    d[2][plane_[k]] = -3 * dr * w * w * e[k] - r * w * w * w * n[k];
  }
  return d;
}

double remaining_sweep(const AxisValues& position, const AxisValues& target, const canonical::Arc& arc,
                       double fraction) {
  canonical::Vector3 n = arc.normal;
  if (n == canonical::Vector3{}) n[canonical::plane_axes(arc.plane).normal] = 1;
  const auto arm = [&](const AxisValues& p) {
    return canonical::Vector3{p[0] - arc.centre[0], p[1] - arc.centre[1], p[2] - arc.centre[2]};
  };
  const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto a = arm(position), b = arm(target);
  const canonical::Vector3 cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                 a[0] * b[1] - a[1] * b[0]};
  // What lies along the axis of a helix is no part of the angle.
  const double between = std::atan2(dot(cross, n), dot(a, b) - dot(a, n) * dot(b, n)) *
                         (arc.clockwise ? -180 : 180) / std::numbers::pi;
  return between + 360 * std::round((arc.sweep * (1 - fraction) - between) / 360);
}

}  // namespace trunnion::motion
