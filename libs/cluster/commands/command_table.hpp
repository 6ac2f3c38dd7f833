// SPDX-License-Identifier: Apache-2.0
// The commands of an operator as data. They are written in idl/operator_commands.yaml; its head explains the
// columns.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "contracts/types.hpp"

namespace trunnion::commands {

/// The field of ChannelRequest that a field of a command fills; it decides how JSON and words are read.
enum class Into {
  mode,
  program,
  block,
  line,
  on,
  fraction,
  axis,
  speed,
  increment,
  counts,
  axes,
  levels,
  press,
  parts,
  tool
};

struct Field {
  std::string_view name;  ///< in JSON
  Into into;
  std::string_view argument;        ///< what the command line calls it
  double minimum = 0, maximum = 0;  ///< of a number, in the unit that idl/channel.idl says
  bool nonzero = false;
  bool optional = false;             ///< may be left out
  bool word_optional = false;        ///< may be left out on the command line
  std::span<const double> one_of{};  ///< when not empty, in place of minimum and maximum
};

/// What a command is for the motion of its channel.
enum class Motion { neither, starts, stops };

struct ChannelCommand {
  idl::channel::CommandKind kind;
  std::string_view route;                 ///< last part of POST /api/channels/{channel}/...
  std::string_view choice_field, choice;  ///< JSON field and its value, where several commands share a route
  std::string_view word;                  ///< of `trunnion channel`
  std::string_view about;                 ///< one line
  std::span<const idl::channel::Mode> modes;  ///< in which it is accepted; empty = in every one
  bool busy;                                  ///< it is accepted while the channel is busy
  bool by_stream;                             ///< HTTP: also over the open WebSocket of /api/stream
  Motion motion;
  std::span<const Field> fields;
};

struct PanelCommand {
  idl::plc::PanelRequestKind kind;
  bool by_stream;          ///< as in ChannelCommand
  std::string_view route;  ///< last part of POST /api/panel/...
  std::string_view word;   ///< of `trunnion estop`
  std::string_view about;
};

std::span<const ChannelCommand> channel_commands();
std::span<const PanelCommand> panel_commands();

/// Whether a POST to the last part `route` of a path is accepted over the WebSocket of /api/stream, too.
bool is_by_stream(std::string_view route);
/// What comes that way, for a message: "a, b, c".
std::string routes_by_stream();
Motion motion_of(idl::channel::CommandKind kind);
/// Whether a POST to the last part `route` of a path stops the motion of a channel.
bool stops_motion(std::string_view route);
/// Null when there is none.
const ChannelCommand* find_word(std::string_view word);
const PanelCommand* find_panel_word(std::string_view word);

/// "jog AXIS SPEED [DISTANCE]".
std::string usage(const ChannelCommand& command);

}  // namespace trunnion::commands
