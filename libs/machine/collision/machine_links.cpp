// SPDX-License-Identifier: Apache-2.0
#include "collision/machine_links.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "canonical/axes.hpp"
#include "compensation/error_model.hpp"
#include "geometry/angle.hpp"

namespace trunnion::collision {
namespace {

using geometry::ChainParameters;
using geometry::RotaryAxis;

using canonical::axis_letters;

// From the end of a side to the base.
std::array<const std::optional<RotaryAxis>*, 3> side_of(const ChainParameters& p, bool workpiece) {
  if (workpiece) return {&p.table_2, &p.table_1, &p.table_0};
  return {&p.head_2, &p.head_1, &p.head_0};
}

Vec3 face_of(const ChainParameters& p) {
  Vec3 face = p.origin;
  if (!p.open) return face;
  face += p.base_correction;
  for (const bool workpiece : {true, false})
    for (const auto* axis : side_of(p, workpiece))
      if (*axis) face += (workpiece ? 1 : -1) * (*axis)->correction;
  return face;
}

Mat3 rotation_about(const Vec3& k, double degrees) {
  const auto t = geometry::sine_cosine(degrees);
  Mat3 cross;
  cross << 0, -k.z(), k.y(), k.z(), 0, -k.x(), -k.y(), k.x(), 0;
  return Mat3::Identity() + t.sine * cross + (1 - t.cosine) * cross * cross;
}

}  // namespace

std::variant<MachineLinks, std::string> MachineLinks::make(
    const ChainParameters& design, const std::vector<volumetric::StructureAxis>& structure) {
  volumetric::GeometryErrors errors;
  errors.structure = structure;
  const auto model = volumetric::ErrorModel::make(design, errors);
  if (const auto* refused = std::get_if<std::string>(&model)) return *refused;
  const auto& order = std::get<volumetric::ErrorModel>(model).errors().structure;
  MachineLinks links;
  links.notation_ = std::get<volumetric::ErrorModel>(model).notation();
  links.face_ = face_of(design);
  links.tool_direction_ = design.tool_direction.stableNormalized();
  for (const auto& axis : order) {
    Joint joint;
    joint.axis = axis.axis;
    joint.rotary = axis.axis > 2;
    if (!joint.rotary) {
      joint.direction = design.linear_direction.col(static_cast<Eigen::Index>(axis.axis)).stableNormalized();
      // The direction is that of the tool as the workpiece sees it.
      if (axis.workpiece) joint.direction = -joint.direction;
    } else {
      joint.point = axis.workpiece ? Vec3(Vec3::Zero()) : links.face_;
      for (const auto* side : side_of(design, axis.workpiece)) {
        if (!*side) continue;
        joint.point += (*side)->offset + (*side)->correction;
        joint.direction = (*side)->direction.stableNormalized();
        if (3 + (*side)->angle == axis.axis) break;
      }
    }
    (axis.workpiece ? links.workpiece_ : links.tool_).push_back(joint);
  }
  std::reverse(links.workpiece_.begin(), links.workpiece_.end());
  return links;
}

std::optional<Link> MachineLinks::carried_by(std::size_t axis) const {
  for (const bool workpiece : {true, false}) {
    const auto& side = joints(workpiece);
    for (std::size_t i = 0; i < side.size(); ++i)
      if (side[i].axis == axis) return Link{workpiece, i + 1};
  }
  return std::nullopt;
}

void MachineLinks::place(const AxisPosition& position, bool workpiece,
                         std::vector<Placement>& placements) const {
  placements.assign(1, {});
  for (const Joint& joint : joints(workpiece)) {
    const Placement& base = placements.back();
    Placement next = base;
    if (joint.rotary) {
      const Mat3 turn = rotation_about(joint.direction, position[joint.axis]);
      next.translation += base.rotation * (joint.point - turn * joint.point);
      next.rotation = base.rotation * turn;
    } else {
      next.translation += base.rotation * (position[joint.axis] * joint.direction);
    }
    placements.push_back(next);
  }
}

std::string name_of(const MachineLinks& links, Link link) {
  if (link.depth == 0) return "base";
  if (link == links.workpiece()) return "workpiece";
  if (link == links.spindle()) return "spindle";
  return std::string(1, axis_letters[links.joints(link.workpiece)[link.depth - 1].axis]);
}

std::string text_of(const AxisPosition& position, const Travel& travel) {
  std::string text;
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!travel[i].present) continue;
    text += fmt::format("{}{}{:.3f}", text.empty() ? "" : " ", axis_letters[i], position[i]);
  }
  return text;
}

}  // namespace trunnion::collision
