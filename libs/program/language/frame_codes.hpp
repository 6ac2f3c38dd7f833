// SPDX-License-Identifier: Apache-2.0
// Frames that a program switches on: work offsets, scaling, mirror, rotation, G52 and G92.
#pragma once

#include "language/block_context.hpp"

namespace trunnion::language {

class FrameCodes : private BlockHandler {
 public:
  explicit FrameCodes(BlockContext& context) : BlockHandler(context) {}

  Fault set_first_work_offset(std::uint16_t at);  ///< G54
  /// `index` as ModalState::work_offset.
  Fault set_work_offset(std::uint16_t at, std::uint8_t index);
  Fault set_additional_work_offset(std::uint16_t at);  ///< G54.1
  Fault set_scaling(std::uint16_t at);
  Fault clear_scaling(std::uint16_t at);
  Fault set_mirror(std::uint16_t at, bool on);
  Fault set_rotation(std::uint16_t at);
  Fault set_local_offset(std::uint16_t at);   ///< G52
  Fault shift_coordinates(std::uint16_t at);  ///< G92
  Fault clear_shift(std::uint16_t at);        ///< G92.1
  Fault set_setting_error(std::uint16_t at);  ///< G54.4
  Fault set_zone(std::uint16_t at);           ///< G22
  Fault clear_zone(std::uint16_t at);         ///< G23

 private:
  /// P of the block is a number of G54, and no word of another code.
  bool numbers_offset() const;
};

}  // namespace trunnion::language
