// SPDX-License-Identifier: Apache-2.0
#include "commands/command_table.hpp"

#include <algorithm>

namespace trunnion::commands {

bool is_by_stream(std::string_view route) {
  const auto found = [&](const auto& row) { return row.by_stream && row.route == route; };
  return std::ranges::any_of(channel_commands(), found) || std::ranges::any_of(panel_commands(), found);
}

std::string routes_by_stream() {
  std::string list;
  const auto add = [&](const auto& rows) {
    for (const auto& row : rows)
      if (row.by_stream) list.append(list.empty() ? "" : ", ").append(row.route);
  };
  add(panel_commands());
  add(channel_commands());
  return list;
}

Motion motion_of(idl::channel::CommandKind kind) {
  const auto found = std::ranges::find(channel_commands(), kind, &ChannelCommand::kind);
  return found == channel_commands().end() ? Motion::neither : found->motion;
}

bool stops_motion(std::string_view route) {
  return std::ranges::any_of(
      channel_commands(), [&](const auto& row) { return row.route == route && row.motion == Motion::stops; });
}

const ChannelCommand* find_word(std::string_view word) {
  const auto rows = channel_commands();
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.word == word; });
  return found == rows.end() ? nullptr : &*found;
}

const PanelCommand* find_panel_word(std::string_view word) {
  const auto rows = panel_commands();
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.word == word; });
  return found == rows.end() ? nullptr : &*found;
}

std::string usage(const ChannelCommand& command) {
  std::string text(command.word);
  for (const auto& field : command.fields) {
    const bool optional = field.optional || field.word_optional;
    text.append(optional ? " [" : " ").append(field.argument).append(optional ? "]" : "");
  }
  return text;
}

}  // namespace trunnion::commands
