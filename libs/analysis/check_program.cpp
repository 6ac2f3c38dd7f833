// SPDX-License-Identifier: Apache-2.0
#include "analysis/check_program.hpp"

#include <memory>
#include <ostream>

#include "analysis/json_lines.hpp"
#include "analysis/summary.hpp"

namespace trunnion::analysis {
namespace {

constexpr language::SkipLevels every_level = 0x1ff;

void print_alarm(const language::Alarm& alarm, const TextName& name, std::ostream& out) {
  out << name(alarm.program) << ":" << alarm.line << ":" << alarm.column << ": "
      << static_cast<unsigned>(alarm.number) << ": " << alarm.text.data() << "\n";
  for (std::size_t i = alarm.calls; i-- > 0;) {
    out << "  called from " << name(alarm.chain[i].program) << ":" << alarm.chain[i].line << "\n";
  }
}

}  // namespace

bool check_program(language::TextSource& text, language::Environment& environment,
                   const language::AxisValues& start, const CheckOptions& options, const TextName& name,
                   std::ostream& out) {
  using language::Step;
  language::InterpreterOptions interpreting;
  interpreting.block_skip = options.skip_blocks ? every_level : language::SkipLevels{0};
  interpreting.repeat = false;
  // Too large for the stack of a small thread.
  const auto interpreter = std::make_unique<language::Interpreter>(environment, interpreting);
  const auto lines = std::make_unique<JsonLines>(out, environment.axes());
  interpreter->start(text, start, {});
  MotionTracker tracker(environment, *interpreter, start);
  Summary summary(environment.axes());
  language::Command command;
  Step step = Step::working;
  while (step != Step::end && step != Step::alarm) {
    step = interpreter->next(command);
    // No probe: the move to a skip signal ends where it was to end at the latest.
    if (step == Step::position) interpreter->set_position(command.target);
    if (step != Step::command) continue;
    if (!options.json_lines) summary.add(command);
    const auto motion = tracker.follow(command);
    if (!motion) continue;
    if (options.json_lines) {
      lines->motion(*motion);
    } else {
      summary.add(*motion);
    }
  }
  const bool good = step == Step::end;
  if (!options.json_lines) {
    summary.print(out, interpreter->blocks());
    if (!good) print_alarm(interpreter->alarm(), name, out);
  } else if (good) {
    lines->end(tracker.machine());
  } else {
    lines->error(interpreter->alarm());
  }
  return good;
}

}  // namespace trunnion::analysis
