// SPDX-License-Identifier: Apache-2.0
// Gauges that a probe touches, as signed distances: negative inside the material, mm.
#pragma once

#include <variant>

#include "geometry/types.hpp"

namespace trunnion::touch_probe {

using geometry::Mat3;
using geometry::Vec3;

struct SphereGauge {
  Vec3 centre = Vec3::Zero();
  double radius = 12.5;
  /// Of a shaft that holds it: a cylinder from the centre in the direction of `shaft`, a unit vector, to the
  /// distance `shaft_length`; radius 0: none.
  Vec3 shaft = -Vec3::UnitZ();
  double shaft_radius = 0, shaft_length = 0;
};

/// A cuboid. The columns of `edges` are the directions of its edges, unit vectors perpendicular to each
/// other.
struct CuboidGauge {
  Vec3 centre = Vec3::Zero(), half_lengths = Vec3::Constant(25);
  Mat3 edges = Mat3::Identity();
};

/// A ring gauge: the material between two cylinders about `axis`, and between two planes.
struct RingGauge {
  Vec3 centre = Vec3::Zero(), axis = Vec3::UnitZ();  ///< unit vector
  double bore = 25, outside = 60;                    ///< radii
  double half_height = 10;
};

struct CylinderGauge {
  Vec3 centre = Vec3::Zero(), axis = Vec3::UnitZ();  ///< unit vector
  double radius = 25, half_height = 25;
};

using Solid = std::variant<SphereGauge, CuboidGauge, RingGauge, CylinderGauge>;

/// Distance of a point from the surface; exact outside, inside too but for a sphere with a shaft, where it is
/// the larger depth of the two.
double signed_distance(const Solid& solid, const Vec3& point);
/// Unit vector out of the material at the point of the surface that is nearest.
Vec3 outward(const Solid& solid, const Vec3& point);

}  // namespace trunnion::touch_probe
