// SPDX-License-Identifier: Apache-2.0
// The distance of two convex shapes. FCL is behind this file.
#pragma once

#include <memory>

#include "collision/bodies.hpp"

namespace trunnion::collision {

/// A shape with its bounds in its own frame.
class ShapeGeometry {
 public:
  explicit ShapeGeometry(const Shape& shape);
  ShapeGeometry(ShapeGeometry&&) noexcept;
  ShapeGeometry& operator=(ShapeGeometry&&) noexcept;
  ~ShapeGeometry();

  /// Of a sphere that contains the shape, mm.
  const Vec3& centre() const { return centre_; }
  double radius() const { return radius_; }
  /// Of a box that contains it, mm.
  const std::array<Vec3, 8>& corners() const { return corners_; }

  struct Geometry;
  const Geometry& geometry() const { return *geometry_; }

 private:
  Vec3 centre_ = Vec3::Zero();
  double radius_ = 0;
  std::array<Vec3, 8> corners_;
  std::unique_ptr<Geometry> geometry_;
};

/// mm, within 0.002 mm; below zero a depth of the penetration, which is exact for spheres only. The points
/// are the nearest ones, in the frame of the placements; for shapes that overlap, a point in both.
double distance_between(const ShapeGeometry& a, const Placement& place_a, const ShapeGeometry& b,
                        const Placement& place_b, Vec3& on_a, Vec3& on_b);

}  // namespace trunnion::collision
