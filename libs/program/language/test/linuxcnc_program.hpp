// SPDX-License-Identifier: Apache-2.0
// Programs of the LinuxCNC dialect and the streams that they give.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "test_machine.hpp"

namespace trunnion::language::test {

inline TestMachine linuxcnc_machine() {
  TestMachine machine;
  machine.dialect = ProgramDialect::linuxcnc;
  return machine;
}

inline std::vector<std::string> linuxcnc_stream(const std::string& program) {
  TestMachine machine = linuxcnc_machine();
  return stream(run(machine, program));
}

/// The stream without the end of the program that this adds.
inline std::vector<std::string> linuxcnc_blocks(const std::string& blocks) {
  TestMachine machine = linuxcnc_machine();
  Interpretation result = run(machine, blocks + "\nM2\n");
  const auto last = static_cast<std::uint32_t>(std::count(blocks.begin(), blocks.end(), '\n')) + 2;
  while (!result.commands.empty() && result.commands.back().line == last) result.commands.pop_back();
  return stream(result);
}

/// The texts of the messages, with an alarm at the end as in stream().
inline std::vector<std::string> linuxcnc_messages(const std::string& blocks) {
  TestMachine machine = linuxcnc_machine();
  const std::string program = blocks + "\nM2\n";
  StringSource source(program);
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  std::vector<std::string> texts;
  Command command;
  Step step = interpreter.next(command);
  for (; step == Step::command || step == Step::working; step = interpreter.next(command))
    if (step == Step::command && command.kind == CommandKind::message)
      texts.emplace_back(interpreter.message_text());
  if (step == Step::alarm)
    texts.push_back("alarm " + std::to_string(static_cast<int>(interpreter.alarm().number)));
  return texts;
}

}  // namespace trunnion::language::test
