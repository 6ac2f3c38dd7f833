#include "motion/path_segment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::motion {
namespace {

using language::axis_count;

double norm3(const AxisValues& v, std::size_t first) {
  return std::hypot(v[first], v[first + 1], v[first + 2]);
}

}  // namespace

PathSegment PathSegment::line(const AxisValues& start, const AxisValues& target) {
  PathSegment segment;
  segment.start_ = start;
  segment.target_ = target;
  for (std::size_t i = 0; i < axis_count; ++i) segment.slope_[i] = target[i] - start[i];
  const double rotary = norm3(segment.slope_, language::A);
  double linear = norm3(segment.slope_, language::X);
  if (linear <= 1e-6 * rotary) linear = norm3(segment.slope_, language::U);
  segment.unit_ = linear > 1e-6 * rotary ? LengthUnit::millimetre : LengthUnit::degree;
  segment.length_ = segment.unit_ == LengthUnit::millimetre ? linear : rotary;
  for (double& slope : segment.slope_) slope = segment.length_ > 0 ? slope / segment.length_ : 0;
  return segment;
}

namespace {
constexpr std::array<std::array<std::size_t, 3>, 3> planes{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
}

PathSegment PathSegment::arc(const AxisValues& start, const AxisValues& target, const language::Arc& arc) {
  if (arc.normal != language::Vector3{}) return tilted_arc(start, target, arc);
  const auto& [p, q, along] = planes[static_cast<std::size_t>(arc.plane)];
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
                                    const language::Arc& arc) {
  using language::Vector3;
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
  if (s >= length_) return target_;
  if (s <= 0) return start_;
  AxisValues position{};
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

double remaining_sweep(const AxisValues& position, const AxisValues& target, const language::Arc& arc,
                       double fraction) {
  language::Vector3 n = arc.normal;
  if (n == language::Vector3{}) n[planes[static_cast<std::size_t>(arc.plane)][2]] = 1;
  const auto arm = [&](const AxisValues& p) {
    return language::Vector3{p[0] - arc.centre[0], p[1] - arc.centre[1], p[2] - arc.centre[2]};
  };
  const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto a = arm(position), b = arm(target);
  const language::Vector3 cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                a[0] * b[1] - a[1] * b[0]};
  // What lies along the axis of a helix is no part of the angle.
  const double between = std::atan2(dot(cross, n), dot(a, b) - dot(a, n) * dot(b, n)) *
                         (arc.clockwise ? -180 : 180) / std::numbers::pi;
  return between + 360 * std::round((arc.sweep * (1 - fraction) - between) / 360);
}

}  // namespace trunnion::motion
