// SPDX-License-Identifier: Apache-2.0
// An operator's command, as JSON or as words, into the request of the IDL, checked by the table of commands:
// what cannot be meant never reaches the bus.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "commands/command_table.hpp"
#include "commands/json_fields.hpp"

namespace trunnion::commands {

/// From the body of a POST. `letters` are the channel's axes as in ChannelState. Client, number and channel
/// are left zero. Throws BadField; std::logic_error when no command has the route.
idl::channel::ChannelRequest request_of(std::string_view route, const bus::Json& body,
                                        std::string_view letters);

/// From what follows the word on the command line. Throws BadField.
idl::channel::ChannelRequest request_of(const ChannelCommand& command,
                                        const std::vector<std::string>& arguments, std::string_view letters);

/// It has a field for which the channel's letters are needed.
bool names_axes(const ChannelCommand& command);

/// Why the numbers of a request are outside the limits of its command, which any client of the bus can send;
/// empty when they are within.
std::string outside_limits(const idl::channel::ChannelRequest& request);

}  // namespace trunnion::commands
