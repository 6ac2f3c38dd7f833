// SPDX-License-Identifier: Apache-2.0
#include "collision/shape_distance.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <limits>

namespace trunnion::collision {

struct ShapeGeometry::Geometry {
  std::shared_ptr<fcl::CollisionGeometryd> shape;
};

namespace {

// The triangles of a hull whose other points are all on one side, outward; of few points, so every triple is
// tried.
std::vector<int> faces_of(const std::vector<Vec3>& points, int& count) {
  std::vector<int> faces;
  count = 0;
  const auto n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k)
      for (std::size_t m = k + 1; m < n; ++m) {
        const Vec3 normal = (points[k] - points[i]).cross(points[m] - points[i]);
        const double area = normal.norm();
        if (area < 1e-9) continue;
        bool above = false, below = false;
        for (const Vec3& point : points) {
          const double off = normal.dot(point - points[i]) / area;
          above = above || off > 1e-7, below = below || off < -1e-7;
        }
        if (above && below) continue;
        const auto a = static_cast<int>(i), b = static_cast<int>(k), c = static_cast<int>(m);
        faces.insert(faces.end(), {3, a, above ? c : b, above ? b : c});
        ++count;
      }
  return faces;
}

fcl::Transform3d transform(const Placement& placement) {
  fcl::Transform3d out = fcl::Transform3d::Identity();
  out.linear() = placement.rotation;
  out.translation() = placement.translation;
  return out;
}

struct Bounds {
  Vec3 low, high;
};

}  // namespace

ShapeGeometry::ShapeGeometry(const Shape& shape) : geometry_(std::make_unique<Geometry>()) {
  Bounds bounds;
  if (const auto* box = std::get_if<Box>(&shape)) {
    geometry_->shape = std::make_shared<fcl::Boxd>(Vec3(2 * box->half_lengths));
    bounds = {-box->half_lengths, box->half_lengths};
    radius_ = box->half_lengths.norm();
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    geometry_->shape = std::make_shared<fcl::Cylinderd>(cylinder->radius, 2 * cylinder->half_height);
    const Vec3 half(cylinder->radius, cylinder->radius, cylinder->half_height);
    bounds = {-half, half};
    radius_ = std::hypot(cylinder->radius, cylinder->half_height);
  } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    geometry_->shape = std::make_shared<fcl::Sphered>(sphere->radius);
    bounds = {Vec3::Constant(-sphere->radius), Vec3::Constant(sphere->radius)};
    radius_ = sphere->radius;
  } else {
    const auto& points = std::get<Hull>(shape).points;
    int count = 0;
    auto faces = std::make_shared<const std::vector<int>>(faces_of(points, count));
    geometry_->shape =
        std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<Vec3>>(points), count, faces);
    bounds = {points.front(), points.front()};
    for (const Vec3& point : points) {
      bounds.low = bounds.low.cwiseMin(point);
      bounds.high = bounds.high.cwiseMax(point);
    }
    centre_ = (bounds.low + bounds.high) / 2;
    for (const Vec3& point : points) radius_ = std::max(radius_, (point - centre_).norm());
  }
  for (std::size_t i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) corners_[i][k] = (i >> k & 1) != 0 ? bounds.high[k] : bounds.low[k];
}
ShapeGeometry::ShapeGeometry(ShapeGeometry&&) noexcept = default;
ShapeGeometry& ShapeGeometry::operator=(ShapeGeometry&&) noexcept = default;
ShapeGeometry::~ShapeGeometry() = default;

double distance_between(const ShapeGeometry& a, const Placement& place_a, const ShapeGeometry& b,
                        const Placement& place_b, Vec3& on_a, Vec3& on_b) {
  const auto ta = transform(place_a), tb = transform(place_b);
  const auto *shape_a = a.geometry().shape.get(), *shape_b = b.geometry().shape.get();
  fcl::DistanceRequestd request(true, false, 0, 0, 1e-7, fcl::GST_LIBCCD);
  fcl::DistanceResultd result;
  fcl::distance(shape_a, ta, shape_b, tb, request, result);
  if (result.min_distance > 0) {
    on_a = result.nearest_points[0], on_b = result.nearest_points[1];
    return result.min_distance;
  }
  const fcl::CollisionRequestd contact_request(1, true);
  fcl::CollisionResultd contact_result;
  on_a = on_b = (place_a * a.centre() + place_b * b.centre()) / 2;
  try {
    fcl::collide(shape_a, ta, shape_b, tb, contact_request, contact_result);
  } catch (const std::exception&) {  // degenerate: in contact without a depth
    return 0;
  }
  if (contact_result.numContacts() == 0) return 0;
  const auto& contact = contact_result.getContact(0);
  on_a = on_b = contact.pos;
  return -std::max(contact.penetration_depth, 0.0);
}

}  // namespace trunnion::collision
