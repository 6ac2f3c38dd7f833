// SPDX-License-Identifier: Apache-2.0
#include "analysis/program_summary.hpp"

#include <memory>
#include <ostream>

#include "analysis/check_parts.hpp"
#include "analysis/program_figures.hpp"
#include "analysis/program_survey.hpp"
#include "analysis/summary_report.hpp"
#include "language/line_reader.hpp"

namespace trunnion::analysis {
namespace {

using program_execution::Ending;
using program_execution::ProgramReader;

std::uint64_t lines_in(language::TextSource& text) {
  language::LineReader reader;
  reader.seek(text, {});
  std::string_view line;
  std::uint64_t lines = 0;
  while (reader.next(line) == language::LineReader::Status::line) ++lines;
  return lines;
}

/// One reading of the program, with all that looks at it.
class SummaryRun final : public language::BlockWatch {
 public:
  SummaryRun(const language::Environment& environment, const channel_setup::ChannelSetup* machine,
             const language::MFunctions* functions, bool lengths_known)
      : environment_(environment),
        lengths_known_(lengths_known),
        survey_(environment, lengths_known, functions != nullptr),
        figures_(environment, machine, functions) {}

  void begin(const language::SeenBlock& seen) override {
    survey_.begin(seen);
    figures_.begin(seen);
  }

  Ending read(ProgramReader& reader, language::TextSource& text, const language::AxisValues& start,
              const CheckOptions& options, std::uint64_t lines) {
    MotionTracker tracker(environment_, reader.interpreter(), start);
    reader.on_command = [&](const language::Command& command, const language::Command& move) {
      const auto motion = tracker.follow(command, move);
      survey_.see(command, reader.from(), motion);
      figures_.see(command, move, reader.from(), motion, reader.interpreter());
    };
    reader.stop = [&] {
      if (options.progress) options.progress(reader.interpreter().main_line(), lines);
      return false;
    };
    const auto ending = reader.read(text, start);
    if (options.progress) options.progress(lines, lines);
    survey_.end(ending == Ending::end, reader.interpreter().executor().program_position());
    return ending;
  }

  bool has_unknown_m() const { return !figures_.unknown_m().empty(); }

  bool write(const ProgramReader& reader, Ending ending, const CheckOptions& options, const TextName& name,
             std::uint64_t lines, std::ostream& out) const {
    const TextName named = with_files(reader, name);
    SummaryReport report{figures_,
                         survey_.warnings(),
                         environment_,
                         named,
                         lengths_known_,
                         lines,
                         reader.interpreter().blocks(),
                         {},
                         {},
                         0};
    const bool good = ending == Ending::end || ending == Ending::repeats;
    if (!good) report.alarm = alarm_of(reader, ending), report.alarm_text = alarm_text_of(reader, ending);
    if (ending == Ending::repeats) report.repeats_from = reader.repeats_from();
    if (options.json) {
      out << to_json(report) << "\n";
    } else {
      out << to_text(report);
      print_ending(reader, ending, named, out);
    }
    return good && !has_unknown_m();
  }

 private:
  const language::Environment& environment_;
  bool lengths_known_;
  ProgramSurvey survey_;
  ProgramFigures figures_;
};

}  // namespace

// A first reading ends at an M code that the machine does not have; a second one passes all of them.
bool summarize_program(language::TextSource& text, SurveyedMachine& machine,
                       const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                       std::ostream& out) {
  const auto lines = lines_in(text);
  for (const bool permits : {false, true}) {
    machine.permit_every_m(permits);
    SummaryRun run(machine, &machine, machine.functions(), true);
    const auto reader = std::make_unique<ProgramReader>(machine, reading_options(options, &run));
    const auto ending = run.read(*reader, text, start, options, lines);
    const bool m_code = ending == Ending::alarm && run.has_unknown_m() &&
                        reader->alarm().number == language::AlarmNumber::unknown_m;
    if (!m_code || permits) {
      machine.permit_every_m(false);
      return run.write(*reader, ending, options, name, lines, out);
    }
  }
  return false;
}

bool summarize_program(language::TextSource& text, language::Environment& environment,
                       const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                       std::ostream& out) {
  const auto lines = lines_in(text);
  SummaryRun run(environment, nullptr, environment.m_functions(), options.lengths_known);
  const auto reader = std::make_unique<ProgramReader>(environment, reading_options(options, &run));
  const auto ending = run.read(*reader, text, start, options, lines);
  return run.write(*reader, ending, options, name, lines, out);
}

}  // namespace trunnion::analysis
