// SPDX-License-Identifier: Apache-2.0
// The bodies of a machine as convex shapes.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "collision/machine_links.hpp"
#include "touch_probe/touch_probe.hpp"

namespace trunnion::collision {

struct Box {
  Vec3 half_lengths = Vec3::Constant(1);  ///< mm
};
/// Its axis is Z.
struct Cylinder {
  double radius = 1, half_height = 1;  ///< mm
};
struct Sphere {
  double radius = 1;  ///< mm
};
/// The convex hull of points that are not in a plane.
struct Hull {
  std::vector<Vec3> points;  ///< mm
};
using Shape = std::variant<Box, Cylinder, Sphere, Hull>;

struct Body {
  std::string name;
  Link link;
  Shape shape;
  /// Of the shape's origin and directions in the frame of MachineLinks with every axis at zero.
  Vec3 position = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
  bool tool = false;  ///< goes when another tool is put into the spindle
};

struct BodySet {
  std::vector<Body> bodies;
  std::vector<std::pair<std::string, std::string>> allowed;  ///< pairs that may touch
  double clearance = 1;                                      ///< mm, between all others
};

/// Bodies of a machine without bodies.yaml: a table under the workpiece when two rotary axes carry it, and a
/// spindle nose.
BodySet derived_bodies(const MachineLinks& links);

/// Name of the body of a tool from the table.
inline constexpr const char* tool_name = "tool";
/// A tool as a cylinder from the spindle face to the tip, mm.
Body tool_body(const MachineLinks& links, double length, double radius);
/// Name of the body of the stylus that add_probe() adds.
inline constexpr const char* stylus_name = "probe stylus";
/// Ball, stylus and body of a touch probe, and the solids that it measures, with their shafts. Stylus: 0.6 of
/// the ball's diameter, at most 40 % of the length; the body's diameter is 40 mm.
void add_probe(const MachineLinks& links, const touch_probe::TouchProbeTruth& probe, BodySet& bodies);
void add_solids(const MachineLinks& links, const std::vector<touch_probe::Solid>& solids, BodySet& bodies);

/// A rotation that turns Z to `direction` (unit vector).
Mat3 rotation_to(const Vec3& direction);

}  // namespace trunnion::collision
