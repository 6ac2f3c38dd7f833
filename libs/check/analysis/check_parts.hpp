// SPDX-License-Identifier: Apache-2.0
// What a check and a summary have in common: how the program is read, and what is said of its end.
#pragma once

#include <iosfwd>
#include <string>

#include "analysis/check_program.hpp"
#include "analysis/warnings.hpp"
#include "program_execution/program_reader.hpp"

namespace trunnion::analysis {

/// `watch` may be null.
program_execution::ReadingOptions reading_options(const CheckOptions& options, language::BlockWatch* watch);

/// The alarm of a program that was not read to its end: that of the reader, or why it gave up.
language::Alarm alarm_of(const program_execution::ProgramReader& reader, program_execution::Ending ending);
/// Its text; one of the machine has bodies and positions, for which the alarm itself has no room.
std::string alarm_text_of(const program_execution::ProgramReader& reader, program_execution::Ending ending);

/// Lines for anything but a good end.
void print_ending(const program_execution::ProgramReader& reader, program_execution::Ending ending,
                  const TextName& name, std::ostream& out);

/// What a check without a machine does not know: a line of the rotary ones among `axes`, bit a for Axis a,
/// and one of the M codes that are in no table. Empty when there are neither.
std::string unknown_lines(std::uint16_t axes, const std::string& m_codes);
/// The same with the files that the program has called by their names (LinuxCNC), which have no numbers.
/// `reader` must outlive it.
TextName with_files(const program_execution::ProgramReader& reader, const TextName& name);

/// A line for each.
std::string warning_lines(const Warnings& warnings, const TextName& name);

}  // namespace trunnion::analysis
