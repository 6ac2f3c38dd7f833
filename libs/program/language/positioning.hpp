// SPDX-License-Identifier: Apache-2.0
// Dwell, positioning without the modal motion code and homing: G4, G27 .. G31, G45 .. G48, G53, G60, G159.
#pragma once

#include "language/block_context.hpp"

namespace trunnion::language {

class Positioning : private BlockHandler {
 public:
  explicit Positioning(BlockContext& context) : BlockHandler(context) {}

  Fault dwell(std::uint16_t at);                ///< G4
  Fault check_reference(std::uint16_t at);      ///< G27
  Fault return_to_reference(std::uint16_t at);  ///< G28
  Fault home(std::uint16_t at);                 ///< G28.2, G159
  /// Of one axis, at the feed per minute; of an axis that the channel does not have nothing (NUM 9990.9).
  Fault home_axis(std::size_t axis);
  Fault return_to_numbered_reference(std::uint16_t at);                    ///< G30
  Fault return_from_reference(std::uint16_t at);                           ///< G29
  Fault move_until_skip(std::uint16_t at);                                 ///< G31
  Fault move_until_numbered_skip(std::uint16_t at, std::uint32_t number);  ///< G31.1 .. G31.3
  Fault move_in_machine_coordinates(std::uint16_t at);                     ///< G53
  Fault approach_from_one_side(std::uint16_t at);                          ///< G60
  /// G45 to G48: the way grows by `times` the radius.
  Fault move_by_offset(std::uint16_t at, int times);

 private:
  Fault find_offset(std::uint16_t at, double& offset) const;
  Fault check_machine_coordinates(std::uint16_t at) const;
  Fault skip_move(std::uint16_t at, std::uint32_t input);
  /// P is not that of another code of the block.
  bool has_own_p() const;
  Fault return_to(std::uint16_t at, const AxisValues& reference);
  void search_references(std::uint32_t axes, double speed);
};

}  // namespace trunnion::language
