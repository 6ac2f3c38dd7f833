// SPDX-License-Identifier: Apache-2.0
#include "geometry/chain_elements.hpp"

#include <algorithm>

namespace trunnion::geometry {
namespace {

// The vectors between two rotary axes, or beyond the outer ones.
struct Gap {
  Vec3 offset = Vec3::Zero(), correction = Vec3::Zero();
  std::string name;  // of the correction
};

struct Joint {
  RotaryAxis axis;
  Gap gap;  // on its workpiece side in the table, on its tool side in the head
};

struct Sides {
  std::vector<Joint> table, head;  // workpiece to tool
  Gap base;                        // between them
  Mat3 linear_direction = Mat3::Identity();
  std::array<int, 3> linear_carriers{};
};

// Where the table ends and the head begins.
std::size_t base_of(const std::vector<ChainElement>& elements) {
  const auto first = [&](ElementKind kind) {
    return std::find_if(elements.begin(), elements.end(), [&](const auto& e) { return e.kind == kind; });
  };
  auto found = first(ElementKind::base);
  if (found == elements.end()) found = first(ElementKind::linear);
  return static_cast<std::size_t>(found - elements.begin());
}

std::variant<Sides, ChainError> walk(const ChainDescription& description) {
  Sides sides;
  Gap gap;
  unsigned linear = 0;
  const std::size_t base = base_of(description.elements);
  std::array<bool, 3> in_table{};
  const auto close = [&] { (sides.head.empty() ? sides.base : sides.head.back().gap) = gap; };
  for (std::size_t i = 0; i < description.elements.size(); ++i) {
    const ChainElement& e = description.elements[i];
    switch (e.kind) {
      case ElementKind::offset:
        gap.offset += e.vector;
        break;
      case ElementKind::correction:
        if (!gap.name.empty()) return ChainError::two_corrections;
        gap.correction = e.vector;
        gap.name = e.name;
        break;
      case ElementKind::linear:
        if (e.axis > 2 || (linear & (1u << e.axis)) != 0) return ChainError::linear_missing;
        linear |= 1u << e.axis;
        sides.linear_direction.col(static_cast<Eigen::Index>(e.axis)) = e.vector;
        in_table[e.axis] = i < base;
        sides.linear_carriers[e.axis] = static_cast<int>(i < base ? sides.table.size() : sides.head.size());
        break;
      case ElementKind::base:
        if (i != base) return ChainError::two_bases;
        break;
      case ElementKind::rotary:
        if (i < base) {
          sides.table.push_back({{e.vector, Vec3::Zero(), e.axis}, gap});
        } else {
          close();
          sides.head.push_back({{e.vector, Vec3::Zero(), e.axis}, {}});
        }
        gap = {};
        break;
    }
  }
  close();
  if (linear != 7) return ChainError::linear_missing;
  if (sides.table.size() > 3 || sides.head.size() > 3) return ChainError::too_many_rotary;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (in_table[axis]) sides.linear_carriers[axis] -= static_cast<int>(sides.table.size());
  if (description.closed && !sides.base.name.empty()) return ChainError::idle_correction;
  return sides;
}

}  // namespace

std::variant<ChainParameters, ChainError> parameters_of(const ChainDescription& description) {
  ChainParameters p;
  p.tool_direction = description.tool_direction;
  const auto walked = walk(description);
  if (const auto* error = std::get_if<ChainError>(&walked)) return *error;
  const auto& sides = std::get<Sides>(walked);
  p.linear_direction = sides.linear_direction;
  p.linear_carriers = sides.linear_carriers;
  Vec3 sum = sides.base.offset;
  for (const auto* side : {&sides.table, &sides.head})
    for (const Joint& joint : *side) sum += joint.gap.offset;
  p.open = !description.closed;
  if (p.open) {
    p.origin = sum;
    p.base_correction = sides.base.correction;
  }
  // Both sides count their slots 2, 1, 0 from the outer end of the chain; a head's offsets point from the
  // tool to the base.
  std::optional<RotaryAxis>* const table_slots[] = {&p.table_2, &p.table_1, &p.table_0};
  for (std::size_t i = 0; i < sides.table.size(); ++i) {
    const Joint& joint = sides.table[i];
    *table_slots[i] = {joint.axis.direction, joint.gap.offset, joint.axis.angle, joint.gap.correction};
  }
  std::optional<RotaryAxis>* const head_slots[] = {&p.head_2, &p.head_1, &p.head_0};
  for (std::size_t i = 0; i < sides.head.size(); ++i) {
    const Joint& joint = sides.head[sides.head.size() - 1 - i];
    *head_slots[i] = {joint.axis.direction, -joint.gap.offset, joint.axis.angle, -joint.gap.correction};
  }
  return p;
}

CorrectionNames correction_names(const ChainDescription& description) {
  CorrectionNames names;
  const auto walked = walk(description);
  if (const auto* sides = std::get_if<Sides>(&walked)) {
    for (std::size_t i = 0; i < sides->table.size(); ++i) names.table[i] = sides->table[i].gap.name;
    for (std::size_t i = 0; i < sides->head.size(); ++i)
      names.head[i] = sides->head[sides->head.size() - 1 - i].gap.name;
    names.base = sides->base.name;
  }
  return names;
}

}  // namespace trunnion::geometry
