// SPDX-License-Identifier: Apache-2.0
// The distance of two bodies by projections from one to the other, without FCL.
#pragma once

#include <algorithm>

#include "collision/bodies.hpp"

namespace trunnion::collision {

// The point of a body nearest to `p`.
inline Vec3 nearest_point(const Shape& shape, const Placement& place, const Vec3& p) {
  Vec3 local = place.rotation.transpose() * (p - place.translation);
  if (const auto* box = std::get_if<Box>(&shape)) {
    local = local.cwiseMax(-box->half_lengths).cwiseMin(box->half_lengths);
  } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    if (local.norm() > sphere->radius) local *= sphere->radius / local.norm();
  } else {
    const auto& cylinder = std::get<Cylinder>(shape);
    const double r = local.head<2>().norm();
    if (r > cylinder.radius) local.head<2>() *= cylinder.radius / r;
    local.z() = std::clamp(local.z(), -cylinder.half_height, cylinder.half_height);
  }
  return place * local;
}

/// Projections by turns converge to a pair of nearest points of two convex sets (Cheney and Goldstein, 1959),
/// from above. Boxes, cylinders and spheres.
inline double projected_distance(const Shape& a, const Placement& place_a, const Shape& b,
                                 const Placement& place_b, int rounds) {
  Vec3 p = place_a.translation, q = place_b.translation;
  for (int k = 0; k < rounds; ++k) q = nearest_point(b, place_b, p), p = nearest_point(a, place_a, q);
  return (p - q).norm();
}

}  // namespace trunnion::collision
