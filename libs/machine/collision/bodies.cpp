// SPDX-License-Identifier: Apache-2.0
#include "collision/bodies.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace trunnion::collision {
namespace {

// Of the derived bodies, mm.
constexpr double table_radius = 160, table_height = 40;
constexpr double nose_radius = 50, nose_height = 150;
// Of a probe.
constexpr double stylus_share = 0.6, longest_stylus = 0.4, probe_radius = 20;

Body cylinder(std::string name, Link link, const Vec3& from, const Vec3& direction, double length,
              double radius) {
  Body body{std::move(name), link, Cylinder{radius, length / 2}, from + length / 2 * direction};
  body.rotation = rotation_to(direction);
  return body;
}

}  // namespace

Mat3 rotation_to(const Vec3& direction) {
  return Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), direction).toRotationMatrix();
}

BodySet derived_bodies(const MachineLinks& links) {
  BodySet set;
  const auto& joints = links.joints(true);
  // The last rotary axis under the workpiece: a round table whose face is at the point of its axis. Where it
  // is the only one, its point may be anywhere on the axis, and nothing is known of the height of a table.
  for (std::size_t i = joints.size(); i-- > 0;) {
    if (!joints[i].rotary) continue;
    Vec3 axis = joints[i].direction;
    if (axis.dot(links.tool_direction()) < 0) axis = -axis;
    const bool carried = std::any_of(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(i),
                                     [](const auto& joint) { return joint.rotary; });
    if (carried && axis.dot(links.tool_direction()) > 0.7)
      set.bodies.push_back(
          cylinder("table", links.workpiece(), joints[i].point, -axis, table_height, table_radius));
    break;
  }
  set.bodies.push_back(cylinder("spindle nose", links.spindle(), links.face(), links.tool_direction(),
                                nose_height, nose_radius));
  return set;
}

Body tool_body(const MachineLinks& links, double length, double radius) {
  auto body = cylinder(tool_name, links.spindle(), links.face(), -links.tool_direction(), length, radius);
  body.tool = true;
  return body;
}

void add_probe(const MachineLinks& links, const touch_probe::TouchProbeTruth& probe, BodySet& set) {
  const Vec3 down = -links.tool_direction();
  const double stylus = longest_stylus * probe.length;
  Body ball{"probe ball", links.spindle(), Sphere{probe.ball_radius}, links.face() + probe.length * down};
  auto shank = cylinder(stylus_name, links.spindle(), links.face() + (probe.length - stylus) * down, down,
                        stylus, stylus_share * probe.ball_radius);
  auto body = cylinder("probe", links.spindle(), links.face(), down, probe.length - stylus, probe_radius);
  for (auto* part : {&ball, &shank, &body}) {
    part->tool = true;
    set.bodies.push_back(*part);
  }
}

void add_solids(const MachineLinks& links, const std::vector<touch_probe::Solid>& solids, BodySet& set) {
  std::size_t number = 0;
  const auto name = [&](const char* kind) {
    return std::string(kind) + (solids.size() > 1 ? " " + std::to_string(number) : "");
  };
  for (const auto& solid : solids) {
    ++number;
    if (const auto* sphere = std::get_if<touch_probe::SphereGauge>(&solid)) {
      set.bodies.push_back({name("sphere"), links.workpiece(), Sphere{sphere->radius}, sphere->centre});
      if (sphere->shaft_radius > 0)
        set.bodies.push_back(cylinder(name("shaft of the sphere"), links.workpiece(), sphere->centre,
                                      sphere->shaft, sphere->shaft_length, sphere->shaft_radius));
    } else if (const auto* box = std::get_if<touch_probe::CuboidGauge>(&solid)) {
      set.bodies.push_back({name("box"), links.workpiece(), Box{box->half_lengths}, box->centre, box->edges});
    } else if (const auto* ring = std::get_if<touch_probe::RingGauge>(&solid)) {
      // Without its bore: a probe in it is no case of the moves between measurements.
      set.bodies.push_back(cylinder(name("ring"), links.workpiece(),
                                    ring->centre - ring->half_height * ring->axis, ring->axis,
                                    2 * ring->half_height, ring->outside));
    } else if (const auto* gauge = std::get_if<touch_probe::CylinderGauge>(&solid)) {
      set.bodies.push_back(cylinder(name("cylinder"), links.workpiece(),
                                    gauge->centre - gauge->half_height * gauge->axis, gauge->axis,
                                    2 * gauge->half_height, gauge->radius));
    }
  }
}

}  // namespace trunnion::collision
