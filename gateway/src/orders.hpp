// JSON of an HTTP body -> the request of the IDL, checked: what cannot be meant never reaches the bus.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "bus/json.hpp"
#include "contracts/types.hpp"
#include "src/router.hpp"

namespace trunnion::gateway {

/// What is wrong with a body, and where.
struct BadRequest : std::runtime_error {
  BadRequest(std::string where, const std::string& what)
      : std::runtime_error(what), field(std::move(where)) {}
  std::string field;
};

/// The body as JSON object; an empty body is an empty object. Throws BadRequest.
bus::Json parse_body(const std::string& body);

/// A number from a path, decimal digits only, at most `maximum`; nothing otherwise.
std::optional<std::uint32_t> path_number(const std::string& text, std::uint32_t maximum);

/// Orders to a channel. `state` gives the channel's axes. Client and number are left zero. Throws BadRequest.
idl::channel::ChannelRequest channel_order(Operation operation, const bus::Json& body,
                                           const idl::channel::ChannelState& state);

/// Operation::emergency_stop, release or panel_reset; their body is empty.
idl::plc::PanelRequest panel_order(Operation operation, const bus::Json& body);

/// {"channel": n} or {} for all.
idl::service::AlarmReset alarm_reset_order(const bus::Json& body);

/// {"value": number}, {"text": "..."} or {"reset": true}, and optionally {"who": "..."}.
idl::parameters::ParameterRequest parameter_order(std::uint32_t number, bool is_text, const bus::Json& body);

/// {"channel": n, "index": 0..5, "values": [up to 9 numbers]}.
idl::parameters::ParameterRequest work_offset_order(const bus::Json& body);

/// Throws BadRequest when `name` cannot be the name of a program: empty, above 64 bytes, with a control
/// character or a directory in it.
void check_program_name(const std::string& name);

}  // namespace trunnion::gateway
