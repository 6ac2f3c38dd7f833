// SPDX-License-Identifier: Apache-2.0
// Tool length, tool tip control and cutter radius compensation: G43 .. G49, G40 .. G42, H and D.
#pragma once

#include <optional>

#include "language/block_context.hpp"

namespace trunnion::language {

/// How a tool length acts.
enum class LengthUse : std::uint8_t {
  off,         ///< G49
  added,       ///< G43
  subtracted,  ///< G44
  tip,         ///< G43.4
  vector,      ///< G43.5
};

class ToolCodes : private BlockHandler {
 public:
  explicit ToolCodes(BlockContext& context) : BlockHandler(context) {}

  Fault set_length(std::uint16_t at, LengthUse use);
  Fault set_cutter_side(std::uint16_t at, CutterSide side);

  /// Tool length compensation of `length` mm along Z, shown as that of entry `number`.
  Fault put_length(std::uint16_t at, std::uint16_t number, double length);
  /// Cutter radius compensation with the radius of entry `number`, or with `radius` mm.
  Fault compensate_with(std::uint16_t at, CutterSide side, std::uint16_t number);
  void compensate_by(CutterSide side, double radius);

  /// H and D without a code; LinuxCNC does not know that.
  Fault length_word();
  Fault radius_word();

  /// Of the active D, mm, with its wear; nothing when the tool has none.
  std::optional<double> cutter_radius() const;

 private:
  struct Length {
    Transformation transformation = Transformation::none;
    bool plane_only = false;
    bool vector = false;
    bool subtract = false;
    bool off = false;
  };
  Fault choose_length(std::uint16_t at, const Length& length);
  /// H of the block or the one that holds.
  Fault length_entry(std::uint16_t at, std::uint32_t& h);
  Fault use_length(std::uint16_t at, const Length& use, std::uint16_t number, double length);
  Fault compensate(std::uint16_t at, bool named);
  void read_wall(const AxisValues& here);
};

}  // namespace trunnion::language
