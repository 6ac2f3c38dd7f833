// SPDX-License-Identifier: Apache-2.0
#include "core/bodies_document.hpp"

#include "canonical/axes.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;
using collision::Vec3;

Json list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json side_document(const std::vector<collision::Joint>& joints) {
  auto side = Json::array();
  for (const auto& joint : joints)
    side.push_back({{"axis", std::string(1, canonical::axis_letters[joint.axis])},
                    {"rotary", joint.rotary},
                    {"direction", list(joint.direction)},
                    {"point", list(joint.point)}});
  return side;
}

struct ShapeDocument {
  Json& body;

  void operator()(const collision::Box& box) const {
    body["shape"] = "box";
    body["size"] = list(2 * box.half_lengths);
  }
  void operator()(const collision::Cylinder& cylinder) const {
    body["shape"] = "cylinder";
    body["size"] = {2 * cylinder.radius, 2 * cylinder.half_height};
  }
  void operator()(const collision::Sphere& sphere) const {
    body["shape"] = "sphere";
    body["size"] = Json::array({2 * sphere.radius});
  }
  void operator()(const collision::Hull& hull) const {
    body["shape"] = "hull";
    body["size"] = Json::array();
    auto& points = body["points"] = Json::array();
    for (const auto& point : hull.points) points.push_back(list(point));
  }
};

}  // namespace

Json bodies_document(const collision::MachineBodies& machine) {
  Json document = {{"structure", machine.links.notation()},
                   {"workpiece_side", side_document(machine.links.joints(true))},
                   {"tool_side", side_document(machine.links.joints(false))}};
  auto& bodies = document["bodies"] = Json::array();
  for (const auto& body : machine.set.bodies) {
    Json row = {{"name", body.name},
                {"side", body.link.workpiece ? "workpiece" : "tool"},
                {"depth", body.link.depth},
                {"tool", body.tool},
                {"position", list(body.position)}};
    auto& rotation = row["rotation"] = Json::array();
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < 3; ++k) rotation.push_back(body.rotation(i, k));
    std::visit(ShapeDocument{row}, body.shape);
    bodies.push_back(std::move(row));
  }
  return document;
}

}  // namespace trunnion::gateway
