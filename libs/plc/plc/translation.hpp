// SPDX-License-Identifier: Apache-2.0
// The programs of a PLC from their sources and the simulated devices.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plc/devices/device_file.hpp"
#include "plc/devices/message_file.hpp"
#include "plc/devices/modbus_file.hpp"
#include "plc/machine/byte_code.hpp"
#include "plc/source_files.hpp"
#include "plc/tools/uses.hpp"
#include "plc/tools/variables.hpp"

namespace trunnion::st {

inline constexpr std::size_t program_cells = 8192;  ///< of the variables of the programs

/// Throws std::runtime_error when the variables of the programs need more than program_cells.
void require_cells(const ByteCode& code);

struct Translation {
  std::shared_ptr<const ByteCode> code;
  std::uint64_t layout = 0;                           ///< Compilation::layout
  std::array<std::optional<std::size_t>, 3> entries;  ///< of `code`: fast, main, simulation
  std::vector<PositionSwitch> switches;
  MessageFile messages;
  Variables variables;
  Uses uses;
  std::vector<std::string> warnings;
};

/// Translates what is_compiled() together; the programs `fast` and `main` are the tasks. With `simulated`,
/// for a machine whose hardware is simulated, also the task `simulation`: devices.yaml, or a PROGRAM of this
/// name. `directory` goes before the names in messages. Throws std::runtime_error with a line
/// file:line:column: error: ... for each error.
Translation translate_sources(SourceFiles files, bool simulated, const std::string& directory = "");

/// modbus.yaml of the sources; without the file there are no connections. Throws as read_modbus().
ModbusFile modbus_of(const SourceFiles& files, const std::string& directory = "");

}  // namespace trunnion::st
