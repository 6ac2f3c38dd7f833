// SPDX-License-Identifier: Apache-2.0
#include "table_request.hpp"

#include <algorithm>

namespace trunnion::channel {

idl::parameters::ParameterRequest table_request(const language::Command& command, std::uint16_t channel,
                                                const idl::parameters::ToolTable& tools) {
  using idl::parameters::Operation;
  using language::Table;
  idl::parameters::ParameterRequest request;
  if (command.table == Table::work_offset) {
    request.operation = Operation::SET_WORK_OFFSET;
    request.offsets = {
        {channel, static_cast<std::uint8_t>(command.number), {command.target.begin(), command.target.end()}}};
    return request;
  }
  if (command.table == Table::parameter) {
    request.operation = Operation::SET;
    request.values = {{command.number, command.value, ""}};
    return request;
  }
  idl::parameters::Tool tool;
  tool.number = command.number;
  const auto known = std::find_if(tools.tools.begin(), tools.tools.end(),
                                  [&](const auto& t) { return t.number == command.number; });
  if (known != tools.tools.end()) tool = *known;
  switch (command.table) {
    case Table::tool_length:
      tool.length = command.value;
      break;
    case Table::tool_length_wear:
      tool.length_wear = command.value;
      break;
    case Table::tool_radius:
      tool.radius = command.value;
      break;
    case Table::tool_radius_wear:
      tool.radius_wear = command.value;
      break;
    default:
      break;
  }
  request.operation = Operation::SET_TOOL;
  request.tools = {tool};
  return request;
}

}  // namespace trunnion::channel
