// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/machine_defaults.hpp"

#include "parameter_store/file_storage.hpp"

namespace trunnion::parameters {

MachineDefaults defaults_of(const machine::MachineConfig& machine) {
  MachineDefaults defaults;
  defaults.values = machine::machine_parameters(machine);
  FileStorage files(machine.directory);
  std::uint64_t revision = 0;
  if (const auto text = files.read(tool_tables::tools_file))
    defaults.tools =
        tool_tables::read_tools(*text, machine.directory + "/" + tool_tables::tools_file, revision);
  if (const auto text = files.read(tool_tables::offsets_file))
    defaults.offsets =
        tool_tables::read_offsets(*text, machine.directory + "/" + tool_tables::offsets_file, revision);
  return defaults;
}

}  // namespace trunnion::parameters
