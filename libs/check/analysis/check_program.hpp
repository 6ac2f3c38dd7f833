// SPDX-License-Identifier: Apache-2.0
// Interprets a program without a machine and says what it would do.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "channel_setup/channel_setup.hpp"
#include "language/text_source.hpp"
#include "program_execution/move_guard.hpp"

namespace trunnion::analysis {

struct CheckOptions {
  bool json_lines = false;                        ///< one JSON object per motion instead of a summary
  bool skip_blocks = false;                       ///< leave out blocks that begin with / or /n
  program_execution::MoveGuard* guard = nullptr;  ///< looks at the motions as in the channel
  bool lengths_known = false;                     ///< without a machine: the tools are listed
  bool json = false;                              ///< a summary is one JSON document
  /// Of a summary: the line of the main program that is being read, now and then and at the end.
  std::function<void(std::uint64_t line, std::uint64_t lines)> progress;
};

/// Names the text of Command::program for a reader: a path.
using TextName = std::function<std::string(std::uint32_t program)>;

/// Runs `text` from machine position `start` to its end, as program_execution::ProgramReader does, and writes
/// to `out`, with the warnings of warnings.hpp where it writes no motions. True when there was no alarm,
/// which ends it: of the language, and those of the channel of `machine`.
bool check_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                   const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                   std::ostream& out);
/// The same where nothing but `environment` is known of the machine: alarms of the language only.
bool check_program(language::TextSource& text, language::Environment& environment,
                   const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                   std::ostream& out);

}  // namespace trunnion::analysis
