// SPDX-License-Identifier: Apache-2.0
// The program under way and the tool in the spindle, as the text that outlives the control.
#pragma once

#include <cstdint>
#include <string>

namespace trunnion::channel {

/// The program that a power failure, or the end of the control, would interrupt now.
struct RunningProgram {
  std::string name;
  std::uint64_t revision = 0;
  std::uint32_t crc = 0;
  std::uint32_t line = 0;        ///< newest that was executed; 0 = no program is under way
  std::uint64_t ended = 0;       ///< cycle up to which every program has ended; 0 = none has
  std::uint32_t parts = 0;       ///< machined since the count was set
  std::uint32_t tool = 0;        ///< in the spindle
  std::uint64_t tool_since = 0;  ///< cycle from which on the drive's snapshot knows of it
  bool operator==(const RunningProgram&) const = default;

  /// No fields, the channel's state has them already: ended, parts, tool, tool_since.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name), visit("revision", self.revision), visit("crc", self.crc);
    visit("line", self.line);
  }
};

std::string write_record(const RunningProgram& program);

/// Throws std::runtime_error, beginning with `file`:line:column, when the text is not one of write_record().
RunningProgram read_record(const std::string& text, const std::string& file);

}  // namespace trunnion::channel
