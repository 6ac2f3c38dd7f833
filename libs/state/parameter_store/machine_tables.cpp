// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/machine_tables.hpp"

#include <fstream>
#include <optional>
#include <sstream>

#include "machine/machine.hpp"
#include "parameter_store/tool_tables.hpp"

namespace trunnion::tool_tables {
namespace {

std::optional<std::string> text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

MachineTables load_machine_tables(const std::string& directory, std::uint16_t channel) {
  const auto machine = machine::load_machine(directory);
  if (channel >= machine.channels)
    throw std::runtime_error(directory + ": has no channel " + std::to_string(channel) + ", only 0 .. " +
                             std::to_string(machine.channels - 1));
  MachineTables tables;
  tables.channel = channel;
  tables.parameters.values = machine::machine_parameters(machine);
  tables.parameters.revision = 1;
  const auto tools = directory + "/" + tools_file, offsets = directory + "/" + offsets_file;
  if (const auto text = text_of(tools))
    for (const auto& [number, tool] : read_tools(*text, tools, tables.tools.revision))
      tables.tools.tools.push_back(tool);
  if (const auto text = text_of(offsets))
    for (const auto& [key, offset] : read_offsets(*text, offsets, tables.offsets.revision))
      tables.offsets.offsets.push_back(offset);
  return tables;
}

}  // namespace trunnion::tool_tables
