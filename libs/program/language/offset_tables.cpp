// SPDX-License-Identifier: Apache-2.0
#include "language/offset_tables.hpp"

namespace trunnion::language {

void OffsetTables::load(const Environment& environment) {
  environment_ = &environment;
  for (std::uint8_t i = 0; i < work_offset_count; ++i) work_offsets_[i] = environment.work_offset(i);
  work_offsets_[external_work_offset] = environment.external_offset();
  for (std::uint8_t n = 1; n <= setting_error_count; ++n)
    work_offsets_[static_cast<std::size_t>(external_work_offset) + n] = environment.setting_error(n);
  changed_count_ = 0;
}

AxisValues OffsetTables::workpiece_zero(std::uint8_t index) const {
  AxisValues zero = work_offsets_[index];
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    zero[axis] += work_offsets_[external_work_offset][axis];
  return zero;
}

std::optional<ToolOffset> OffsetTables::tool(std::uint16_t number) const {
  for (std::size_t i = 0; i < changed_count_; ++i) {
    if (changed_[i].number == number) return changed_[i].tool;
  }
  return environment_->tool_offset(number);
}

bool OffsetTables::set_tool(std::uint16_t number, const ToolOffset& tool) {
  for (std::size_t i = 0; i < changed_count_; ++i) {
    if (changed_[i].number != number) continue;
    changed_[i].tool = tool;
    return true;
  }
  if (changed_count_ == changed_.size()) return false;
  changed_[changed_count_++] = {number, tool};
  return true;
}

}  // namespace trunnion::language
