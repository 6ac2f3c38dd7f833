// SPDX-License-Identifier: Apache-2.0
// The programmed path: the path of the tool tip over the workpiece, as the interpreter understands the
// text.
#pragma once

#include <set>
#include <string>

#include "language/canonical.hpp"
#include "parameter_store/machine_tables.hpp"
#include "report/polyline.hpp"

namespace trunnion::report {

using tool_tables::MachineTables;

struct ProgrammedPath {
  Polyline path;                       ///< mm, machine coordinates of the tip with the rotary axes at zero
  std::set<std::uint32_t> feed_lines;  ///< lines with motion at feed
  std::set<std::uint32_t> rapid_lines;
  std::size_t commands = 0;
  double feed_length = 0;    ///< mm of the tip at feed
  Vec3 zero = Vec3::Zero();  ///< work offset of the last motion at feed, mm
  std::string problem;       ///< the interpreter's alarm as line:column: text, else empty
};

/// Reads `text`, stored as `name`, from `position` (machine coordinates, mm and deg), once where it repeats.
/// Arcs, and lines whose rotary axes turn without tool tip control, become chords at most a nanometre off.
/// Throws std::runtime_error when the parameters make no machine.
ProgrammedPath programmed_path(const std::string& text, const MachineTables& tables,
                               const language::AxisValues& position, const std::string& name = "");

}  // namespace trunnion::report
