// SPDX-License-Identifier: Apache-2.0
#include "touch_probe/solid.hpp"

#include <algorithm>

namespace trunnion::touch_probe {
namespace {

// Of a rectangle in the plane of a radius and the axis.
double profile_distance(double beyond_radius, double beyond_height) {
  const double a = std::max(beyond_radius, 0.0), b = std::max(beyond_height, 0.0);
  return std::sqrt(a * a + b * b) + std::min(std::max(beyond_radius, beyond_height), 0.0);
}

double distance(const CylinderGauge& cylinder, const Vec3& point) {
  const Vec3 arm = point - cylinder.centre;
  const double along = cylinder.axis.dot(arm), across = (arm - along * cylinder.axis).norm();
  return profile_distance(across - cylinder.radius, std::abs(along) - cylinder.half_height);
}

double distance(const SphereGauge& sphere, const Vec3& point) {
  const double ball = (point - sphere.centre).norm() - sphere.radius;
  if (sphere.shaft_radius <= 0) return ball;
  const double half = sphere.shaft_length / 2;
  return std::min(ball, distance(CylinderGauge{sphere.centre + half * sphere.shaft, sphere.shaft,
                                               sphere.shaft_radius, half},
                                 point));
}

double distance(const CuboidGauge& cuboid, const Vec3& point) {
  const Vec3 beyond = (cuboid.edges.transpose() * (point - cuboid.centre)).cwiseAbs() - cuboid.half_lengths;
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

// The cross-section of a ring is a rectangle.
double distance(const RingGauge& ring, const Vec3& point) {
  const Vec3 arm = point - ring.centre;
  const double along = ring.axis.dot(arm), across = (arm - along * ring.axis).norm();
  const double middle = (ring.bore + ring.outside) / 2;
  const double beyond_radius = std::abs(across - middle) - (ring.outside - ring.bore) / 2;
  return profile_distance(beyond_radius, std::abs(along) - ring.half_height);
}

}  // namespace

double signed_distance(const Solid& solid, const Vec3& point) {
  return std::visit([&](const auto& shape) { return distance(shape, point); }, solid);
}

Vec3 outward(const Solid& solid, const Vec3& point) {
  constexpr double step = 1e-4;  // mm: the surfaces are plane or round over it
  Vec3 gradient;
  for (int i = 0; i < 3; ++i)
    gradient[i] = signed_distance(solid, point + step * Vec3::Unit(i)) -
                  signed_distance(solid, point - step * Vec3::Unit(i));
  const double length = gradient.norm();
  return length > 0 ? Vec3(gradient / length) : Vec3(Vec3::UnitZ());
}

}  // namespace trunnion::touch_probe
