// SPDX-License-Identifier: Apache-2.0
#include "program_selection.hpp"

#include <utility>

namespace trunnion::channel {

const idl::program::ProgramEntry* ProgramSelection::stored(const std::string& name) const {
  for (const auto& entry : programs_.programs)
    if (entry.name == name) return &entry;
  return nullptr;
}

bool ProgramSelection::select(const std::string& name) {
  const auto* entry = stored(name);
  if (entry == nullptr) return false;
  if (is_temporary(name) && !is_temporary(selected_.name)) before_temporary_ = selected_.name;
  selected_ = *entry;
  return true;
}

bool ProgramSelection::select(const LeftProgram& left) {
  const auto* entry = stored(left.name);
  if (entry == nullptr || entry->revision != left.revision || entry->crc32 != left.crc) return false;
  selected_ = *entry;
  return true;
}

void ProgramSelection::select_text(std::uint32_t crc, std::uint64_t revision) {
  for (const auto& entry : programs_.programs)
    if (entry.crc32 == crc && entry.revision == revision) selected_ = entry;
}

void ProgramSelection::renew() {
  if (const auto* entry = stored(selected_.name)) selected_ = *entry;
}

void ProgramSelection::leave_temporary() {
  if (!is_temporary(selected_.name)) return;
  const auto name = std::exchange(before_temporary_, "");
  const auto* entry = stored(name);
  selected_ = entry == nullptr ? idl::program::ProgramEntry{} : *entry;
}

void ProgramSelection::take_over(const std::string& name, const std::string& before_temporary) {
  before_temporary_ = before_temporary;
  if (const auto* entry = stored(name)) selected_ = *entry;
}

}  // namespace trunnion::channel
