// SPDX-License-Identifier: Apache-2.0
#include "analysis/check_program.hpp"

#include <algorithm>
#include <memory>
#include <ostream>

#include "analysis/json_lines.hpp"
#include "analysis/summary.hpp"
#include "machine/alarm_constants.hpp"

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

void print_repetition(const language::EndlessLoop& loop, const TextName& name, std::ostream& out) {
  if (loop.line() == 0) return;
  out << name(0) << ":" << loop.line() << ": the program repeats for ever from line " << loop.line()
      << "; it was counted up to its return there\n";
}

/// Behind the line's number.
std::string text_of(const std::string& error) { return error.substr(error.find(' ')); }

/// As the channel raises it.
language::Alarm motion_alarm(std::uint32_t number, const std::string& error,
                             const language::Command& motion) {
  language::Alarm alarm;
  alarm.number = static_cast<language::AlarmNumber>(number);
  alarm.program = motion.program;
  alarm.line = motion.line;
  const auto text = text_of(error).substr(1);
  std::copy_n(text.begin(), std::min(text.size(), alarm.text.size() - 1), alarm.text.begin());
  return alarm;
}

/// Empty, or the line of the contact that the motion leads to.
std::string contact_of(program_execution::MoveGuard* guard, const language::AxisValues& from,
                       const language::Command& motion) {
  using Verdict = program_execution::MoveGuard::Verdict;
  auto verdict = guard != nullptr ? Verdict::unfinished : Verdict::free;
  while (verdict == Verdict::unfinished) {
    guard->begin_call();
    verdict = guard->check(from, motion);
  }
  return verdict == Verdict::contact ? guard->contact_text() : "";
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
  language::EndlessLoop loop(options.travel_error != nullptr);
  interpreter->watch_loops(&loop);
  interpreter->start(text, start, environment.power_on());
  MotionTracker tracker(environment, *interpreter, start);
  Summary summary(environment.axes());
  language::Command command;
  Step step = Step::working;
  std::string error;
  std::uint32_t where = 0, number = alarm::travel_limit.number;
  if (options.guard != nullptr) options.guard->begin_run();
  while (step != Step::end && step != Step::alarm) {
    step = interpreter->next(command);
    // No probe: the move to a skip signal ends where it was to end at the latest.
    if (step == Step::position) interpreter->set_position(command.target);
    // No other service: its cycle has no parts.
    if (step == Step::answer) interpreter->answer(0);
    if (step != Step::command) continue;
    if (!options.json_lines) summary.add(command);
    const auto from = tracker.target();
    const auto motion = tracker.follow(command);
    if (!motion) continue;
    if (options.travel_error) error = options.travel_error(from, command);
    if (error.empty()) {
      error = contact_of(options.guard, from, command);
      if (!error.empty()) number = alarm::bodies_would_meet.number;
    }
    if (!error.empty()) {
      where = command.program;
      break;
    }
    if (options.json_lines) {
      lines->motion(*motion);
    } else {
      summary.add(*motion);
    }
  }
  const bool good = step == Step::end;
  if (!options.json_lines) {
    summary.print(out, interpreter->blocks());
    print_repetition(loop, name, out);
    if (!error.empty())
      out << name(where) << ":" << command.line << ": " << number << ":" << text_of(error) << "\n";
    else if (!good)
      print_alarm(interpreter->alarm(), name, out);
  } else if (!error.empty()) {
    lines->error(motion_alarm(number, error, command));
  } else if (good) {
    lines->end(tracker.machine());
  } else {
    lines->error(interpreter->alarm());
  }
  return good;
}

}  // namespace trunnion::analysis
