// SPDX-License-Identifier: Apache-2.0
// Any text, its lines as conditions and its blocks as a program that is surveyed: no crash, and places that
// are in the text.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "analysis/default_machine.hpp"
#include "analysis/program_survey.hpp"

namespace trunnion::analysis {
namespace {

constexpr int most_steps = 400;

void require(bool condition) {
  if (!condition) std::abort();
}

void read_conditions(std::string_view text) {
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const auto line = text.substr(from, std::min<std::size_t>(end - from, 16384));
    const auto condition = condition_of(line);
    if (!condition.empty()) require(condition.data() + condition.size() <= line.data() + line.size());
    static_cast<void>(in_brackets(condition));
    static_cast<void>(mixes_order(condition));
    require(place_in(0, 1, line, line.size() / 2).column >= 1);
    from = end + 1;
  }
}

void survey_program(std::string_view text) {
  DefaultMachine machine({});
  ProgramSurvey survey(machine, false, false);
  language::StringSource source(text);
  language::Interpreter interpreter(machine);
  interpreter.watch_blocks(&survey);
  interpreter.start(source, {}, {});
  MotionTracker tracker(machine, interpreter, {});
  language::AxisValues from{};
  language::Step step = language::Step::working;
  for (int i = 0; i < most_steps && step != language::Step::end && step != language::Step::alarm; ++i) {
    language::Command command;
    step = interpreter.next(command);
    if (step == language::Step::position) interpreter.set_position(from);
    if (step == language::Step::answer) interpreter.answer(0);
    if (step == language::Step::value) interpreter.give_value(1);
    if (step != language::Step::command) continue;
    survey.see(command, from, tracker.follow(command));
    from = command.target;
  }
  survey.end(step == language::Step::end, interpreter.executor().program_position());
  for (const Warning& warning : survey.warnings().sorted()) require(!text_of(warning).empty());
}

}  // namespace
}  // namespace trunnion::analysis

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  trunnion::analysis::read_conditions(text);
  trunnion::analysis::survey_program(text);
  return 0;
}
