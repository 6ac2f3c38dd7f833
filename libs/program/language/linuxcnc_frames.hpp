// SPDX-License-Identifier: Apache-2.0
// Coordinate systems as LinuxCNC has them: G54 to G59.3, G52 and G92, G10 L2 and L20, and the positions of
// G28 and G30.
#pragma once

#include "language/block_context.hpp"
#include "language/frame_codes.hpp"
#include "language/table_codes.hpp"

namespace trunnion::language {

/// A point of the program p is R (p + shift) + offset in machine coordinates, R the rotation of the active
/// system about Z. The shift is one for all systems, and both G52 and G92 set it.
class LinuxcncFrames : private BlockHandler {
 public:
  LinuxcncFrames(BlockContext& context, FrameCodes& frames, TableCodes& tables)
      : BlockHandler(context), frames_(frames), tables_(tables) {}

  Fault select(std::uint16_t at, std::uint8_t index);  ///< G54 to G59.3, index as ModalState::work_offset
  Fault set_local(std::uint16_t at);                   ///< G52
  Fault shift(std::uint16_t at);                       ///< G92
  Fault clear_shift(std::uint16_t at);                 ///< G92.1
  Fault suspend_shift(std::uint16_t at);               ///< G92.2
  Fault resume_shift(std::uint16_t at);                ///< G92.3
  Fault set_offset(std::uint16_t at);                  ///< G10 L2
  Fault set_place(std::uint16_t at);                   ///< G10 L20
  Fault go_to_first(std::uint16_t at);                 ///< G28
  Fault go_to_second(std::uint16_t at);                ///< G30

  /// A rotation ends with its program, and the next one would not know of it.
  Fault check_end(std::uint16_t at) const;

 private:
  /// The system that P names, as ModalState::work_offset; P0 is the active one.
  Fault read_system(std::uint16_t at, std::uint8_t& index);
  Fault begin_shift(std::uint16_t at, std::uint32_t& axes, LinuxcncFrame& frame);
  Fault put_shift(const LinuxcncFrame& frame);
  /// The shift and the rotation become those of the frame.
  void update();
  Fault go_to(std::uint16_t at, const AxisValues& reference);

  FrameCodes& frames_;
  TableCodes& tables_;
};

}  // namespace trunnion::language
