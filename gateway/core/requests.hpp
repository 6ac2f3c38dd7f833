// SPDX-License-Identifier: Apache-2.0
// JSON of an HTTP body -> the request of the IDL, checked: what cannot be meant never reaches the bus.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bus/json.hpp"
#include "commands/channel_request.hpp"
#include "contracts/types.hpp"

namespace trunnion::gateway {

/// What is wrong with a body, and where.
using BadRequest = commands::BadField;

/// The body as JSON object; an empty body is an empty object. Throws BadRequest.
bus::Json parse_body(const std::string& body);

/// A number from a path, decimal digits only, at most `maximum`; nothing otherwise.
std::optional<std::uint32_t> path_number(const std::string& text, std::uint32_t maximum);

/// A command to a channel, by the last part of its path. `state` gives the channel's axes. Client and number
/// are left zero. Throws BadRequest.
idl::channel::ChannelRequest channel_request(std::string_view route, const bus::Json& body,
                                             const idl::channel::ChannelState& state);

/// A command to the operator panel, by the last part of its path; its body is empty.
idl::plc::PanelRequest panel_request(std::string_view route, const bus::Json& body);

/// {"channel": n} or {} for all.
idl::service::AlarmReset alarm_reset(const bus::Json& body);

/// {"value": number}, {"text": "..."} or {"reset": true}, and optionally {"who": "..."}.
idl::parameters::ParameterRequest parameter_request(std::uint32_t number, bool is_text,
                                                    const bus::Json& body);

/// {"values": [{"number": n, "value": number} or {"number": n, "text": "..."}]}, all of which the catalogue
/// has.
idl::parameters::ParameterRequest parameter_import(const bus::Json& body);

/// {"length", "length_wear", "radius", "radius_wear": mm, "name"} and optionally {"type", "life_used",
/// "life_limit", "life_unit": "MINUTES" or "PIECES"}; the store checks the limits.
idl::parameters::ParameterRequest tool_request(std::uint32_t number, const bus::Json& body);
/// `revision` as in the query; empty = any.
idl::parameters::ParameterRequest tool_removal(std::uint32_t number, const std::string& revision);

/// {"name": "..."}: the new name of the program `name`.
idl::program::ProgramRequest rename_request(const std::string& name, const bus::Json& body);

/// {"channel": n, "index": 0..61, "values": [9 numbers], "revision": n}.
idl::parameters::ParameterRequest work_offset_request(const bus::Json& body);

}  // namespace trunnion::gateway
