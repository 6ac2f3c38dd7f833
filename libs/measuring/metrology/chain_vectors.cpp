// SPDX-License-Identifier: Apache-2.0
#include "metrology/chain_vectors.hpp"

#include <cmath>

namespace trunnion::metrology {

const std::optional<geometry::RotaryAxis>& axis_at(const ChainParameters& chain, Slot slot) {
  switch (slot) {
    case Slot::table_2:
      return chain.table_2;
    case Slot::table_1:
      return chain.table_1;
    case Slot::table_0:
      return chain.table_0;
    case Slot::head_2:
      return chain.head_2;
    case Slot::head_1:
      return chain.head_1;
    case Slot::head_0:
      break;
  }
  return chain.head_0;
}

std::optional<geometry::RotaryAxis>& axis_at(ChainParameters& chain, Slot slot) {
  return const_cast<std::optional<geometry::RotaryAxis>&>(
      axis_at(const_cast<const ChainParameters&>(chain), slot));
}

KinematicType kinematic_type(const ChainParameters& chain) {
  int table = 0, head = 0;
  for (const Slot slot : all_slots)
    if (axis_at(chain, slot)) ++(in_table(slot) ? table : head);
  if (table + head == 0) return KinematicType::none;
  if (table + head == 1) return KinematicType::one_axis;
  return head == 0 ? KinematicType::table : table == 0 ? KinematicType::head : KinematicType::mixed;
}

const char* to_string(KinematicType type) {
  switch (type) {
    case KinematicType::none:
      return "no rotary axis";
    case KinematicType::one_axis:
      return "one rotary axis";
    case KinematicType::table:
      return "P";
    case KinematicType::head:
      return "T";
    case KinematicType::mixed:
      break;
  }
  return "M";
}

std::vector<RootVector> root_vectors(const ChainParameters& chain) {
  std::vector<RootVector> vectors;
  std::optional<Slot> inside;
  for (const Slot slot : {Slot::table_0, Slot::table_1, Slot::table_2}) {
    const auto& axis = axis_at(chain, slot);
    if (!axis) continue;
    RootVector vector{slot, axis->angle, {}};
    if (inside)
      vector.share[index_of(*inside)] = -1;
    else
      for (const Slot part : {Slot::table_0, Slot::table_1, Slot::table_2})
        if (axis_at(chain, part)) vector.share[index_of(part)] = 1;
    vectors.push_back(vector);
    inside = slot;
  }
  for (const Slot slot : {Slot::head_0, Slot::head_1, Slot::head_2}) {
    const auto& axis = axis_at(chain, slot);
    if (!axis) continue;
    RootVector vector{slot, axis->angle, {}};
    vector.share[index_of(slot)] = -1;
    vectors.push_back(vector);
  }
  return vectors;
}

Vec3 value_of(const RootVector& vector, const ChainParameters& chain) {
  Vec3 sum = Vec3::Zero();
  for (const Slot slot : all_slots)
    if (const auto& axis = axis_at(chain, slot))
      sum += vector.share[index_of(slot)] * (axis->offset + axis->correction);
  return sum;
}

Vec3 axis_point(const ChainParameters& chain, Slot slot) {
  Vec3 sum = Vec3::Zero();
  const std::size_t first = in_table(slot) ? 0 : 3;
  for (std::size_t i = first; i <= index_of(slot); ++i)
    if (const auto& axis = axis_at(chain, all_slots[i])) sum += axis->offset + axis->correction;
  return sum;
}

std::variant<Normalization, std::string> normalization_of(int setting, double value) {
  const int mode = setting % 10;
  if (setting < 0 || setting > 16 || mode > 6)
    return "normalization " + std::to_string(setting) + " is not within 0 .. 6 or 10 .. 16 (open chain)";
  if (!std::isfinite(value) || std::abs(value) > 1e5)
    return "the value of a normalized component is not within -100000 .. 100000 mm";
  return Normalization{mode, value, setting >= 10};
}

std::optional<Vec3> normalized(const Vec3& vector, const Vec3& direction, const Normalization& normalization,
                               const Vec3& active) {
  const Vec3 along = direction.normalized();
  if (normalization.mode == 0) return vector - along * along.dot(vector - active);
  const int component = (normalization.mode - 1) % 3;
  if (!(std::abs(along[component]) >= 0.01)) return std::nullopt;
  const double wanted = normalization.mode <= 3 ? normalization.value : active[component];
  return vector + along * ((wanted - vector[component]) / along[component]);
}

}  // namespace trunnion::metrology
