// SPDX-License-Identifier: Apache-2.0
// M70 to M73 of LinuxCNC: the modal state that a program saves and restores.
#pragma once

#include "language/block_context.hpp"
#include "language/linuxcnc_frames.hpp"
#include "language/modal_codes.hpp"
#include "language/tool_codes.hpp"

namespace trunnion::language {

struct SavedModes {
  ModalState modal{};
  std::uint8_t coolant = 0;
};

/// Not the motion code, the tool and the shift of G52 and G92.
class LinuxcncModalState : private BlockHandler {
 public:
  LinuxcncModalState(BlockContext& context, ModalCodes& modal, ToolCodes& tools, LinuxcncFrames& frames)
      : BlockHandler(context), modal_(modal), tools_(tools), frames_(frames) {}

  SavedModes save() const { return {state_.modal, state_.coolant}; }
  /// With the commands that this needs. An active cutter radius compensation is not brought back.
  Fault restore(const SavedModes& saved);
  /// M7, M8 or M9 was given out.
  void note_coolant(std::uint16_t code);
  /// M2 and M30 stop the spindle and the coolant that the program has switched on.
  void stop_at_end();

 private:
  Fault restore_tool(const ModalState& saved);
  void restore_spindle(const ModalState& saved);
  void restore_coolant(std::uint8_t saved);

  ModalCodes& modal_;
  ToolCodes& tools_;
  LinuxcncFrames& frames_;
};

}  // namespace trunnion::language
