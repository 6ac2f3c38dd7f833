// SPDX-License-Identifier: Apache-2.0
// Which role an operation needs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "access/sessions.hpp"
#include "core/router.hpp"

namespace trunnion::gateway {

/// Least role of who may do it; nothing: everybody, also without a login. Emergency stop, feed hold and the
/// end of a jog are everybody's.
std::optional<access::Role> needed_role(const Match& match);

/// What requests on the bus carry, as in ParameterRequest: without a login, where none is needed, a
/// builder's.
std::uint8_t role_of(const std::optional<access::Identity>& user);

/// Whether the operation changes what the machine does, so that only the station that operates may order it.
/// Stops are everybody's; programs may be stored from elsewhere.
bool needs_operating_right(const Match& match);

/// Whether the operation shows that somebody is there: not what an open page asks by itself.
bool prolongs_session(Operation operation);

/// Value of `name` in the header Cookie; empty when it is not there.
std::string cookie_value(std::string_view header, std::string_view name);

/// What follows "Bearer " in the header Authorization; empty when there is none.
std::string bearer_token(std::string_view header);

/// Whether an address to listen on is reached from this computer alone.
bool is_loopback(const std::string& address);

}  // namespace trunnion::gateway
