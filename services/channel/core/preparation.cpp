// SPDX-License-Identifier: Apache-2.0
#include "preparation.hpp"

#include <fmt/core.h>

#include <cstdio>

namespace trunnion::channel {

std::vector<language::Command> approach_moves(const AxisValues& from, const AxisValues& to,
                                              std::uint32_t line) {
  std::vector<language::Command> moves;
  AxisValues at = from;
  const auto go = [&](const AxisValues& target) {
    if (target == at) return;
    language::Command move;
    move.kind = language::CommandKind::rapid;
    move.line = line;
    move.target = target;
    move.modal.path_control = language::PathControl::exact_stop;
    moves.push_back(move);
    at = target;
  };
  AxisValues over = to;
  if (to[language::Z] > from[language::Z]) {
    over = from;
    over[language::Z] = to[language::Z];
  } else {
    over[language::Z] = from[language::Z];
  }
  go(over);
  go(to);
  return moves;
}

std::string approach_error(const channel_setup::ChannelSetup& machine, const AxisValues& from,
                           const std::vector<language::Command>& moves, const language::ProgramFrame* frame) {
  AxisValues at = from;
  for (const auto& move : moves) {
    if (auto error = machine.travel_error(at, move); !error.empty()) return error;
    if (frame != nullptr && frame->zone().active) {
      const auto error = machine.zone_error(at, move, frame->zone(), {});
      if (!error.empty())
        return fmt::format("{}: the approach is not where the zone of G22 permits: {}", move.line, error);
    }
    at = move.target;
  }
  return "";
}

std::string words_of(const Preparation& preparation, const AxisValues& from) {
  std::string words;
  char text[40];
  for (const auto& function : preparation.functions) {
    if (function.kind == program_execution::AuxiliaryKind::S)
      std::snprintf(text, sizeof text, "S%g", function.value);
    else
      std::snprintf(text, sizeof text, "%c%u",
                    function.kind == program_execution::AuxiliaryKind::T ? 'T' : 'M', function.code);
    words += (words.empty() ? "" : " ") + std::string(text);
  }
  AxisValues at = from;
  bool first = true;
  for (const auto& move : preparation.moves) {
    words += first ? (words.empty() ? "approach" : ", approach") : ", then";
    first = false;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (move.target[i] == at[i]) continue;
      std::snprintf(text, sizeof text, " %c%.4f", language::axis_letters[i], move.target[i]);
      words += text;
    }
    at = move.target;
  }
  return words;
}

}  // namespace trunnion::channel
