// SPDX-License-Identifier: Apache-2.0
#include "program_execution/auxiliary_memory.hpp"

#include "language/codes.hpp"

namespace trunnion::program_execution {

using language::CommandKind;

void AuxiliaryMemory::pass(const language::Command& command) {
  if (command.kind == CommandKind::spindle_speed) {
    has_speed_ = true;
    speed_ = command.value;
    surface_ = command.modal.spindle_mode == language::SpindleMode::surface;
    limit_ = surface_ ? command.modal.spindle_limit : 0;
    return;
  }
  if (command.kind == CommandKind::spindle_order) {
    ++not_repeated_;
    return;
  }
  if (command.kind != CommandKind::auxiliary) return;
  const auto code = language::m_code(static_cast<std::uint16_t>(command.number));
  switch (code.number) {
    case 7:
    case 8:
      has_coolant_ = true;
      (code.number == 7 ? mist_ : flood_) = true;
      return;
    case 9:
      has_coolant_ = true;
      mist_ = flood_ = false;
      return;
    default:
      break;
  }
  if (code.group == language::MGroup::spindle) {
    has_spindle_ = true;
    spindle_ = code.number;
    angle_ = command.value;
    has_angle_ = command.has_value;
  } else if (code.group != language::MGroup::flow && code.action == language::MAction::auxiliary) {
    ++not_repeated_;
  }
}

std::vector<AuxiliaryFunction> AuxiliaryMemory::functions(bool speed, bool spindle, bool coolant) const {
  std::vector<AuxiliaryFunction> list;
  if (speed && has_speed_) list.push_back({AuxiliaryKind::S, 0, speed_, false, surface_, limit_, 0});
  if (spindle && has_spindle_)
    list.push_back({AuxiliaryKind::M, spindle_, has_angle_ ? angle_ : 0, has_angle_});
  if (coolant && has_coolant_) {
    if (mist_) list.push_back({AuxiliaryKind::M, 7, 0, false});
    if (flood_) list.push_back({AuxiliaryKind::M, 8, 0, false});
    if (!mist_ && !flood_) list.push_back({AuxiliaryKind::M, 9, 0, false});
  }
  return list;
}

std::vector<AuxiliaryFunction> AuxiliaryMemory::functions() const { return functions(true, true, true); }

// M9 ends both coolants, so that one of them cannot be brought back without ending the other first.
std::vector<AuxiliaryFunction> AuxiliaryMemory::functions_changed_by(const AuxiliaryMemory& other) const {
  const auto list = functions(other.has_speed_, other.has_spindle_, other.has_coolant_);
  std::vector<AuxiliaryFunction> undo;
  undo.reserve(list.size() + 2);
  if (other.has_spindle_ && !has_spindle_) undo.push_back({AuxiliaryKind::M, 5, 0, false});
  if (other.has_coolant_ && (!has_coolant_ || (other.mist_ && !mist_) || (other.flood_ && !flood_)))
    undo.push_back({AuxiliaryKind::M, 9, 0, false});
  undo.insert(undo.end(), list.begin(), list.end());
  return undo;
}

}  // namespace trunnion::program_execution
