// SPDX-License-Identifier: Apache-2.0
// Tools as LinuxCNC has them: G41 to G43.2 and the tool table (G10 L1, L10, L11).
#pragma once

#include "language/block_context.hpp"
#include "language/linuxcnc_frames.hpp"
#include "language/table_codes.hpp"
#include "language/tool_codes.hpp"

namespace trunnion::language {

/// Where no number says otherwise, the tool is that in the spindle. Its length is along Z.
class LinuxcncTools : private BlockHandler {
 public:
  LinuxcncTools(BlockContext& context, ToolCodes& tools, TableCodes& tables, LinuxcncFrames& frames)
      : BlockHandler(context), tools_(tools), tables_(tables), frames_(frames) {}

  Fault set_side(std::uint16_t at, CutterSide side);           ///< G41, G42
  Fault set_diameter_side(std::uint16_t at, CutterSide side);  ///< G41.1, G42.1
  Fault set_length(std::uint16_t at);                          ///< G43
  Fault set_length_by_words(std::uint16_t at);                 ///< G43.1
  Fault add_length(std::uint16_t at);                          ///< G43.2
  Fault change_table(std::uint16_t at);                        ///< G10

 private:
  /// mm, of table entry `number`; 0: the tool in the spindle, none of which has the length 0.
  Fault length_of(std::uint16_t at, std::uint32_t number, double& length) const;
  /// The length that axis words give: Z alone.
  Fault length_by_words(std::uint16_t at, double& length);
  Fault check_side(std::uint16_t at) const;
  Fault change_tool(std::uint16_t at, std::uint32_t l);

  ToolCodes& tools_;
  TableCodes& tables_;
  LinuxcncFrames& frames_;
};

}  // namespace trunnion::language
