// SPDX-License-Identifier: Apache-2.0
// Changes of tables by the program: work offsets, tools and parameters (G10, G11, system variables).
#pragma once

#include "language/block_context.hpp"

namespace trunnion::language {

class TableCodes : private BlockHandler {
 public:
  explicit TableCodes(BlockContext& context) : BlockHandler(context), tables_(context.tables) {}

  /// While the parameter input is open, a block holds nothing but its words.
  Fault check() const;

  Fault change_table(std::uint16_t at);         ///< G10
  Fault end_parameter_input(std::uint16_t at);  ///< G11
  /// A block N P R behind G10 L50.
  Fault parameter_line() { return change_parameter('N'); }

  /// Change a table as G10 does, `value` in mm or degrees in place of the old.
  Fault write_work_offset(std::uint8_t index, std::size_t axis, double value);
  Fault write_tool(Table table, std::uint16_t number, double value);

  /// The same for a block that means something else by its words.
  void store_work_offset(std::uint8_t index, const AxisValues& values);
  Fault set_tool(Table table, std::uint16_t number, double value, std::uint16_t at) {
    return store_tool(table, number, value, false, at);
  }

 private:
  Fault change_work_offset(std::uint16_t at, std::uint32_t l);
  Fault change_setting_error(std::uint16_t at);
  Fault change_tool(std::uint16_t at, std::uint32_t l);
  Fault define_tool(std::uint16_t at);
  Fault change_parameter(char number_letter);
  /// Words are in a frame with this row of the table.
  bool acts(std::uint8_t index) const {
    const std::uint8_t error = state_.frame().setting_error().number;
    return index == state_.modal.work_offset || index == external_work_offset ||
           (error != 0 && index == external_work_offset + error);
  }
  Fault store_tool(Table table, std::uint16_t number, double value, bool adds, std::uint16_t at);

  OffsetTables& tables_;
};

}  // namespace trunnion::language
