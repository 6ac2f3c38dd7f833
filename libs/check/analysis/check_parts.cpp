// SPDX-License-Identifier: Apache-2.0
#include "analysis/check_parts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <ostream>

#include "analysis/foreign_text.hpp"

namespace trunnion::analysis {
namespace {

using program_execution::Ending;
using program_execution::ProgramReader;

constexpr language::SkipLevels every_level = 0x1ff;

/// Why a program was not read to its end, when no alarm says so.
language::Alarm gave_up(const ProgramReader& reader, Ending ending) {
  language::Alarm alarm;
  alarm.line = reader.interpreter().main_line();
  std::string_view text = "the program is read on and on without a move: it may wait for a time";
  if (ending == Ending::returns)
    text = "the program has returned to earlier lines very often and not ended: it may repeat for ever";
  if (ending == Ending::text_missing) {
    alarm.number = language::AlarmNumber::text_unreadable;
    text = language::alarm_text(alarm.number);
  }
  std::copy(text.begin(), text.end(), alarm.text.begin());
  return alarm;
}

void print_alarm(const ProgramReader& reader, const TextName& name, std::ostream& out) {
  const auto& alarm = reader.alarm();
  out << name(alarm.program) << ":" << alarm.line << ":";
  if (alarm.column != 0) out << alarm.column << ":";
  out << " " << static_cast<unsigned>(alarm.number) << ": " << alarm_text_of(reader, Ending::alarm) << "\n";
  if (alarm.number == language::AlarmNumber::subprogram_missing)
    out << "  Called programs are looked for in the text, beside it and in the folder of the machine, by "
           "number\n";
  if (alarm.foreign != nullptr) out << "  " << foreign_text(*alarm.foreign) << "\n";
  for (std::size_t i = alarm.calls; i-- > 0;) {
    out << "  called from " << name(alarm.chain[i].program) << ":" << alarm.chain[i].line << "\n";
  }
}

}  // namespace

program_execution::ReadingOptions reading_options(const CheckOptions& options, language::BlockWatch* watch) {
  program_execution::ReadingOptions result;
  result.block_skip = options.skip_blocks ? every_level : language::SkipLevels{0};
  result.guard = options.guard;
  result.watch = watch;
  return result;
}

language::Alarm alarm_of(const ProgramReader& reader, Ending ending) {
  return ending == Ending::alarm ? reader.alarm() : gave_up(reader, ending);
}

std::string alarm_text_of(const ProgramReader& reader, Ending ending) {
  const auto alarm = alarm_of(reader, ending);
  if (ending != Ending::alarm || alarm.column != 0) return alarm.text.data();
  // Without the line that the text begins with.
  const auto& text = reader.alarm_text();
  return text.substr(std::min(text.find(' '), text.size() - 1) + 1);
}

void print_ending(const ProgramReader& reader, Ending ending, const TextName& name, std::ostream& out) {
  if (ending == Ending::repeats) {
    const auto line = reader.repeats_from();
    out << name(0) << ":" << line << ": the program repeats for ever from line " << line
        << "; it was counted up to its return there\n";
  } else if (ending == Ending::alarm) {
    print_alarm(reader, name, out);
  } else if (ending != Ending::end) {
    const auto alarm = gave_up(reader, ending);
    out << name(0) << ":" << alarm.line << ": " << alarm.text.data() << "\n";
  }
}

std::string unknown_lines(std::uint16_t axes, const std::string& m_codes) {
  std::string letters;
  for (std::size_t axis = 0; axis < language::axis_count; ++axis)
    if (canonical::is_rotary(axis) && ((axes >> axis) & 1u) != 0)
      letters += fmt::format(" {}", language::axis_letters[axis]);
  std::string lines;
  if (!letters.empty())
    lines += fmt::format("rotary  {}: words without kinematics, since no machine is named\n", letters);
  if (!m_codes.empty())
    lines += fmt::format("m codes {}: for the logic of the machine, of which none is named\n", m_codes);
  return lines;
}

TextName with_files(const ProgramReader& reader, const TextName& name) {
  return [&reader, name](std::uint32_t program) {
    const auto file = reader.interpreter().file_name(program);
    return file.front() != '\0' ? std::string(file.data()) : name(program);
  };
}

std::string warning_lines(const Warnings& warnings, const TextName& name) {
  std::string lines;
  for (const Warning& warning : warnings.sorted()) {
    const auto& place = warning.place;
    const std::string text = place.program == 0 ? "" : fmt::format("{} ", name(place.program));
    const std::string more = warning.blocks > 1 ? fmt::format(" and {} more", warning.blocks - 1) : "";
    lines +=
        fmt::format("warning  {}line {}:{}{}: {}\n", text, place.line, place.column, more, text_of(warning));
  }
  return lines;
}

}  // namespace trunnion::analysis
