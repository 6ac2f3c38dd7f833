// SPDX-License-Identifier: Apache-2.0
#include "geometry/direction_arc.hpp"

#include <cmath>
#include <numbers>

#include "geometry/angle.hpp"

namespace trunnion::geometry {

std::optional<DirectionArc> DirectionArc::make(const Vec3& from, const Vec3& to) {
  const double a = from.stableNorm(), b = to.stableNorm();
  if (!from.allFinite() || !to.allFinite() || !(a > 0) || !(b > 0)) return std::nullopt;
  DirectionArc arc;
  arc.from_ = from / a;
  arc.to_ = to / b;
  arc.length_ = angle_between(arc.from_, arc.to_);
  if (arc.length_ > std::numbers::pi - 1e-6) return std::nullopt;
  const Vec3 normal = arc.from_.cross(arc.to_);
  // Of no length: any direction across will do.
  arc.across_ =
      normal.squaredNorm() > 0 ? Vec3(normal.cross(arc.from_).normalized()) : arc.from_.unitOrthogonal();
  return arc;
}

Vec3 DirectionArc::at(double s) const {
  const auto t = sine_cosine(s * length_ / radians_per_degree);
  return t.cosine * from_ + t.sine * across_;
}

std::array<Vec3, 4> DirectionArc::derivatives(double s) const {
  const auto t = sine_cosine(s * length_ / radians_per_degree);
  const Vec3 u = t.cosine * from_ + t.sine * across_, v = t.cosine * across_ - t.sine * from_;
  const double w = length_;
  return {u, w * v, -w * w * u, -w * w * w * v};
}

}  // namespace trunnion::geometry
