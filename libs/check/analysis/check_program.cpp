// SPDX-License-Identifier: Apache-2.0
#include "analysis/check_program.hpp"

#include <algorithm>
#include <memory>
#include <ostream>

#include "analysis/json_lines.hpp"
#include "analysis/summary.hpp"
#include "program_execution/program_reader.hpp"

namespace trunnion::analysis {
namespace {

using program_execution::Ending;
using program_execution::ProgramReader;

constexpr language::SkipLevels every_level = 0x1ff;

program_execution::ReadingOptions checking(const CheckOptions& options) {
  program_execution::ReadingOptions result;
  result.block_skip = options.skip_blocks ? every_level : language::SkipLevels{0};
  result.guard = options.guard;
  return result;
}

/// A file that is called by its name has no number.
std::string place_of(std::uint32_t program, const language::FileName& file, const TextName& name) {
  return file.front() != '\0' ? std::string(file.data()) : name(program);
}

void print_alarm(const ProgramReader& reader, const TextName& name, std::ostream& out) {
  const auto& alarm = reader.alarm();
  out << place_of(alarm.program, alarm.file_name, name) << ":" << alarm.line << ":";
  if (alarm.column != 0)
    out << alarm.column << ": " << static_cast<unsigned>(alarm.number) << ": " << alarm.text.data() << "\n";
  else  // without the line that the text begins with
    out << " " << static_cast<unsigned>(alarm.number) << ":"
        << reader.alarm_text().substr(reader.alarm_text().find(' ')) << "\n";
  for (std::size_t i = alarm.calls; i-- > 0;) {
    out << "  called from " << place_of(alarm.chain[i].program, alarm.chain[i].file, name) << ":"
        << alarm.chain[i].line << "\n";
  }
}

/// Why a program was not read to its end, when no alarm says so.
language::Alarm gave_up(const ProgramReader& reader, Ending ending) {
  language::Alarm alarm;
  alarm.line = reader.interpreter().main_line();
  std::string_view text = "the program is read on and on without a move: it may wait for a time";
  if (ending == Ending::text_missing) {
    alarm.number = language::AlarmNumber::text_unreadable;
    text = language::alarm_text(alarm.number);
  }
  std::copy(text.begin(), text.end(), alarm.text.begin());
  return alarm;
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

bool check(ProgramReader& reader, const language::Environment& environment, language::TextSource& text,
           const language::AxisValues& start, const CheckOptions& options, const TextName& name,
           std::ostream& out) {
  const auto lines = std::make_unique<JsonLines>(out, environment.axes());
  MotionTracker tracker(environment, reader.interpreter(), start);
  Summary summary(environment.axes());
  language::Command turned;  // with G96 the feed per revolution is that of the move
  reader.on_command = [&](const language::Command& command, const language::Command& move) {
    if (!options.json_lines) summary.add(command);
    const bool turns = command.modal.spindle_mode == language::SpindleMode::surface &&
                       command.modal.feed_mode == language::FeedMode::per_revolution &&
                       move.modal.feed_mode == language::FeedMode::per_minute;
    if (turns) {
      turned = command;
      turned.modal.feed = move.modal.feed, turned.modal.feed_mode = move.modal.feed_mode;
    }
    const auto motion = tracker.follow(turns ? turned : command);
    if (!motion) return;
    if (options.json_lines)
      lines->motion(*motion);
    else
      summary.add(*motion);
  };
  const auto ending = reader.read(text, start);
  const bool good = ending == Ending::end || ending == Ending::repeats;
  if (!options.json_lines) {
    summary.print(out, reader.interpreter().blocks());
    print_ending(reader, ending, name, out);
  } else if (good) {
    lines->end(tracker.machine());
  } else {
    lines->error(ending == Ending::alarm ? reader.alarm() : gave_up(reader, ending));
  }
  return good;
}

}  // namespace

bool check_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                   const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                   std::ostream& out) {
  const auto reader = std::make_unique<ProgramReader>(machine, checking(options));
  return check(*reader, machine, text, start, options, name, out);
}

bool check_program(language::TextSource& text, language::Environment& environment,
                   const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                   std::ostream& out) {
  const auto reader = std::make_unique<ProgramReader>(environment, checking(options));
  return check(*reader, environment, text, start, options, name, out);
}

}  // namespace trunnion::analysis
