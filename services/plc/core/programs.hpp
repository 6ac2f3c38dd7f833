// SPDX-License-Identifier: Apache-2.0
// The programs of a PLC as its core runs them.
#pragma once

#include <string>
#include <vector>

#include "plc/translation.hpp"
#include "structured_text.hpp"

namespace trunnion::plc {

using st::find;
using st::SourceFile;
using st::SourceFiles;

/// What a PLC runs.
struct Programs {
  StructuredText structured;
  std::vector<st::PositionSwitch> switches;
  st::MessageFile messages;
  st::Variables variables;
  st::Uses uses;
  std::vector<std::string> warnings;
};

/// Identifies the names and texts; the order does not count.
std::uint32_t crc32_of(SourceFiles files);

/// st::translate_sources(), ready to run.
Programs translate(SourceFiles files, bool simulated, const std::string& directory = "");

}  // namespace trunnion::plc
