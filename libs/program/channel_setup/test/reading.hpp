// SPDX-License-Identifier: Apache-2.0
// Programs read with the setup of a real machine, as a channel reads them.
#pragma once

#include <string>
#include <vector>

#include "channel_setup/channel_setup.hpp"
#include "language/interpreter.hpp"

namespace trunnion::channel_setup::test {

struct Reading {
  std::vector<language::Command> commands;
  unsigned alarm = 0;  ///< of the interpreter; 140 where a move leaves the travel
  std::uint32_t line = 0;
  std::string text;
};

/// Commands up to the end or to the first refusal. Starts with every axis at zero.
inline Reading read(ChannelSetup& setup, const std::string& text) {
  language::StringSource source(text);
  language::Interpreter interpreter(setup);
  interpreter.start(source, {}, {});
  Reading result;
  language::AxisValues at{};
  language::Command command;
  for (;;) {
    const auto step = interpreter.next(command);
    if (step == language::Step::end) return result;
    if (step == language::Step::alarm) {
      result.alarm = static_cast<unsigned>(interpreter.alarm().number);
      result.line = interpreter.alarm().line;
      result.text = interpreter.alarm().text.data();
      return result;
    }
    if (step != language::Step::command) continue;
    using enum language::CommandKind;
    if (command.kind == rapid || command.kind == line || command.kind == arc) {
      result.text = setup.travel_error(at, command);
      if (!result.text.empty()) {
        result.alarm = 140;
        result.line = command.line;
        return result;
      }
    }
    at = command.target;
    result.commands.push_back(command);
  }
}

inline ChannelSetup setup_of(const std::string& machine) {
  return ChannelSetup(tool_tables::load_machine_tables(std::string(MACHINES_DIRECTORY) + "/" + machine));
}

}  // namespace trunnion::channel_setup::test
