// SPDX-License-Identifier: Apache-2.0
// The programs of a PLC from their sources: instruction lists, Structured Text and simulated devices.
#pragma once

#include <string>
#include <vector>

#include "plc/devices/device_file.hpp"
#include "plc/devices/message_file.hpp"
#include "plc/instruction_list/program.hpp"
#include "plc/tools/uses.hpp"
#include "plc/tools/variables.hpp"
#include "structured_text.hpp"

namespace trunnion::plc {

struct SourceFile {
  std::string name;  ///< main.st, fast.il, devices.yaml
  std::string text;
  bool operator==(const SourceFile&) const = default;
};
using SourceFiles = std::vector<SourceFile>;

/// What a PLC runs.
struct Programs {
  il::Program fast, main;  ///< instruction lists
  StructuredText structured;
  std::vector<st::PositionSwitch> switches;
  st::MessageFile messages;
  st::Variables variables;
  st::Uses uses;
  std::vector<std::string> warnings;
};

/// Null when there is no such file.
const SourceFile* find(const SourceFiles& files, const std::string& name);
/// Identifies the names and texts; the order does not count.
std::uint32_t crc32_of(SourceFiles files);

/// Translates the tasks `fast` and `main`: of each either <task>.il or the PROGRAM of this name in the .st
/// files, which are translated together. With `simulated`, for a machine whose hardware is simulated, also
/// the task `simulation`: devices.yaml, or a PROGRAM of this name. `directory` goes before the names in
/// messages. Throws std::runtime_error with a line file:line:column: error: ... for each error.
Programs translate(SourceFiles files, bool simulated, const std::string& directory = "");

}  // namespace trunnion::plc
