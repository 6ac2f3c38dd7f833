// SPDX-License-Identifier: Apache-2.0
#include "analysis/check_program.hpp"

#include <fmt/core.h>

#include <memory>
#include <ostream>
#include <string>

#include "analysis/check_parts.hpp"
#include "analysis/json_lines.hpp"
#include "analysis/program_survey.hpp"
#include "analysis/summary.hpp"
#include "program_execution/program_reader.hpp"

namespace trunnion::analysis {
namespace {

using program_execution::Ending;
using program_execution::ProgramReader;

std::string unknown_lines_of(const Summary& summary, const language::Environment& environment) {
  std::string codes;
  for (const auto code : summary.other_m_codes()) codes += fmt::format(" M{}", code);
  return unknown_lines(environment.axes(), codes);
}

/// `known`: the environment is a machine's.
bool check(ProgramReader& reader, const language::Environment& environment, bool known, ProgramSurvey& survey,
           language::TextSource& text, const language::AxisValues& start, const CheckOptions& options,
           const TextName& name, std::ostream& out) {
  const auto lines = std::make_unique<JsonLines>(out, environment.axes());
  MotionTracker tracker(environment, reader.interpreter(), start);
  Summary summary(environment.axes());
  reader.on_command = [&](const language::Command& command, const language::Command& move) {
    if (!options.json_lines) summary.add(command);
    const auto motion = tracker.follow(command, move);
    if (!options.json_lines) survey.see(command, reader.from(), motion);
    if (!motion) return;
    if (options.json_lines)
      lines->motion(*motion);
    else
      summary.add(*motion);
  };
  const auto ending = reader.read(text, start);
  const bool good = ending == Ending::end || ending == Ending::repeats;
  if (!options.json_lines) {
    survey.end(ending == Ending::end, reader.interpreter().executor().program_position());
    const TextName named = with_files(reader, name);
    const std::string unknown = known ? std::string() : unknown_lines_of(summary, environment);
    summary.print(out, reader.interpreter().blocks(), unknown + warning_lines(survey.warnings(), named));
    print_ending(reader, ending, named, out);
  } else if (good) {
    lines->end(tracker.machine());
  } else {
    lines->error(alarm_of(reader, ending));
  }
  return good;
}

// Warnings are for people; a list of motions has none.
language::BlockWatch* watch_of(const CheckOptions& options, ProgramSurvey& survey) {
  return options.json_lines ? nullptr : &survey;
}

}  // namespace

bool check_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                   const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                   std::ostream& out) {
  ProgramSurvey survey(machine, true, true);
  const auto reader =
      std::make_unique<ProgramReader>(machine, reading_options(options, watch_of(options, survey)));
  return check(*reader, machine, true, survey, text, start, options, name, out);
}

bool check_program(language::TextSource& text, language::Environment& environment,
                   const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                   std::ostream& out) {
  ProgramSurvey survey(environment, options.lengths_known, environment.m_functions() != nullptr);
  const auto reader =
      std::make_unique<ProgramReader>(environment, reading_options(options, watch_of(options, survey)));
  return check(*reader, environment, false, survey, text, start, options, name, out);
}

}  // namespace trunnion::analysis
