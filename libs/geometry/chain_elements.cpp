#include "geometry/chain_elements.hpp"

namespace trunnion::geometry {

std::variant<ChainParameters, ChainError> parameters_of(const ChainDescription& description) {
  ChainParameters p;
  p.tool_direction = description.tool_direction;
  std::vector<RotaryAxis> table, head;  // workpiece to tool
  Vec3 gap = Vec3::Zero();              // since the last rotary axis
  Vec3 sum = Vec3::Zero();
  unsigned linear = 0;
  for (const auto& e : description.elements) {
    switch (e.kind) {
      case ElementKind::offset:
      case ElementKind::correction:
        gap += e.vector;
        sum += e.vector;
        break;
      case ElementKind::linear:
        if (e.axis > 2 || (linear & (1u << e.axis)) != 0) return ChainError::linear_missing;
        if (!head.empty()) return ChainError::linear_between_rotary;
        linear |= 1u << e.axis;
        p.linear_direction.col(static_cast<Eigen::Index>(e.axis)) = e.vector;
        break;
      case ElementKind::rotary:
        if (linear == 0) {
          table.push_back({e.vector, gap, e.axis});
        } else {
          // A head's offset points from its tool side back to the axis.
          if (!head.empty()) head.back().offset = -gap;
          head.push_back({e.vector, Vec3::Zero(), e.axis});
        }
        gap.setZero();
        break;
    }
  }
  if (linear != 7) return ChainError::linear_missing;
  if (table.size() > 3 || head.size() > 3) return ChainError::too_many_rotary;
  if (!head.empty()) head.back().offset = -gap;
  if (!description.closed) p.origin = sum;
  // Both sides count their slots 2, 1, 0 from the outer end of the chain.
  std::optional<RotaryAxis>* const table_slots[] = {&p.table_2, &p.table_1, &p.table_0};
  for (std::size_t i = 0; i < table.size(); ++i) *table_slots[i] = table[i];
  std::optional<RotaryAxis>* const head_slots[] = {&p.head_2, &p.head_1, &p.head_0};
  for (std::size_t i = 0; i < head.size(); ++i) *head_slots[i] = head[head.size() - 1 - i];
  return p;
}

}  // namespace trunnion::geometry
