// SPDX-License-Identifier: Apache-2.0
// The program under way and the tool in the spindle, as the text that outlives the control.
#pragma once

#include <cstdint>
#include <string>

#include "line_printer.hpp"
#include "program_execution/tap_in_hole.hpp"

namespace trunnion::channel {

/// A program that was left, and where.
struct LeftProgram {
  std::string name;
  std::uint64_t revision = 0;
  std::uint32_t crc = 0;
  std::uint32_t line = 0;  ///< newest that was executed; 0 = no program is under way
  bool operator==(const LeftProgram&) const = default;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name), visit("revision", self.revision), visit("crc", self.crc);
    visit("line", self.line);
  }
};

/// The program that a power failure, or the end of the control, would interrupt now, and what else is kept.
struct RunningProgram : LeftProgram {
  std::uint64_t ended = 0;       ///< cycle up to which every program has ended; 0 = none has
  std::uint32_t parts = 0;       ///< machined since the count was set
  std::uint32_t tool = 0;        ///< in the spindle
  std::uint64_t tool_since = 0;  ///< cycle from which on the drive's snapshot knows of it
  program_execution::TapInHole tap = {};
  PrintedLine printed = {};       ///< by the program that is under way, or was
  std::uint32_t parts_since = 0;  ///< of `parts`, since the program that is under way began, modulo 2^32
  bool operator==(const RunningProgram&) const = default;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    LeftProgram::fields(self, visit);
    visit("ended", self.ended), visit("parts", self.parts), visit("tool", self.tool);
    visit("tool_since", self.tool_since), visit("tap", self.tap), visit("printed", self.printed);
    visit("parts_since", self.parts_since);
  }
};

/// A line with the format, then write_lines(). The file that has it has a checksum.
std::string write_record(const RunningProgram& program);

/// Reads the formats of older builds, too. Throws std::runtime_error, beginning with `file`:line, when the
/// text is none of them.
RunningProgram read_record(const std::string& text, const std::string& file);

}  // namespace trunnion::channel
