// SPDX-License-Identifier: Apache-2.0
// Gauges that a probe touches, as signed distances: negative inside the material, mm.
#pragma once

#include <variant>

#include "truth/true_geometry.hpp"

namespace trunnion::truth {

struct SphereGauge {
  Vec3 centre = Vec3::Zero();
  double radius = 12.5;
};

/// A cuboid, its edges along the axes of the workpiece frame.
struct CuboidGauge {
  Vec3 centre = Vec3::Zero(), half_lengths = Vec3::Constant(25);
};

/// A ring gauge: the material between two cylinders about `axis`, and between two planes.
struct RingGauge {
  Vec3 centre = Vec3::Zero(), axis = Vec3::UnitZ();  ///< unit vector
  double bore = 25, outside = 60;                    ///< radii
  double half_height = 10;
};

using Solid = std::variant<SphereGauge, CuboidGauge, RingGauge>;

/// Distance of a point from the surface; exact outside and inside.
double signed_distance(const Solid& solid, const Vec3& point);
/// Unit vector out of the material at the point of the surface that is nearest.
Vec3 outward(const Solid& solid, const Vec3& point);

}  // namespace trunnion::truth
