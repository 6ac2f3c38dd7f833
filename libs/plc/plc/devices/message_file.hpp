// SPDX-License-Identifier: Apache-2.0
// messages.yaml: what the programs tell the operator, and what it stops or inhibits.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace trunnion::st {

inline constexpr std::size_t most_messages = 256;  ///< registers message_0 .. message_255

enum class MessageReaction : std::uint8_t { show, feed_hold, axis_stop };

struct Message {
  std::string text, german,
      chinese;  ///< what is the case and what to do; English always, the others may be empty
  MessageReaction reaction = MessageReaction::show;
  bool inhibits_start = false;           ///< no cycle start and no MDI line
  bool inhibits_manual = false;          ///< no jog, handwheel and reference return
  std::optional<std::uint16_t> channel;  ///< that it inhibits; none: every channel
};

/// By their numbers, below most_messages.
using MessageFile = std::map<std::uint16_t, Message>;

/// Throws std::runtime_error, beginning with file:line:column, for unknown and missing keys, numbers beyond
/// their limits and texts that are empty, too long or no UTF-8.
MessageFile read_messages(const std::string& yaml, const std::string& file);

}  // namespace trunnion::st
