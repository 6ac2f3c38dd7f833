// SPDX-License-Identifier: Apache-2.0
// Interprets a program without a machine and says what it would do.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "language/interpreter.hpp"
#include "program_execution/move_guard.hpp"

namespace trunnion::analysis {

struct CheckOptions {
  bool json_lines = false;   ///< one JSON object per motion instead of a summary
  bool skip_blocks = false;  ///< leave out blocks that begin with / or /n
  /// Empty, or one line "LINE: ..." when the machine cannot make this motion from `from` (frame of the
  /// command).
  std::function<std::string(const language::AxisValues& from, const language::Command& motion)> travel_error =
      {};
  program_execution::MoveGuard* guard = nullptr;  ///< looks at the motions as in the channel
};

/// Names the text of Command::program for a reader: a path.
using TextName = std::function<std::string(std::uint32_t program)>;

/// Runs `text` from machine position `start` to its end, where M99 in the main program is one, and so is the
/// return of a program that repeats for ever; and writes to `out`. True when there was no alarm and every
/// motion stays within the travel; the first one that does not ends it. A move to a skip signal ends at its
/// target.
bool check_program(language::TextSource& text, language::Environment& environment,
                   const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                   std::ostream& out);

}  // namespace trunnion::analysis
