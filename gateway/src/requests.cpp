// SPDX-License-Identifier: Apache-2.0
#include "src/requests.hpp"

#include <algorithm>
#include <stdexcept>

namespace trunnion::gateway {

using bus::Json;
using commands::number;
using commands::only;
using commands::required;
using commands::text;
using commands::whole;

namespace {
constexpr std::size_t name_bytes = 64;
}  // namespace

Json parse_body(const std::string& body) {
  if (body.find_first_not_of(" \t\r\n") == std::string::npos) return Json::object();
  auto parsed = Json::parse(body, nullptr, false);
  if (parsed.is_discarded()) throw BadRequest("", "the body is not JSON");
  if (!parsed.is_object()) throw BadRequest("", "the body must be a JSON object");
  return parsed;
}

std::optional<std::uint32_t> path_number(const std::string& path, std::uint32_t maximum) {
  if (path.empty() || path.size() > 9 || path.find_first_not_of("0123456789") != std::string::npos) return {};
  const auto value = static_cast<std::uint32_t>(std::stoul(path));
  if (value > maximum) return {};
  return value;
}

idl::channel::ChannelRequest channel_request(std::string_view route, const Json& body,
                                             const idl::channel::ChannelState& state) {
  const auto axes = std::min(state.axes.size(), state.letters.size());
  auto request = commands::request_of(route, body, std::string_view(state.letters).substr(0, axes));
  request.channel = state.channel;
  return request;
}

idl::plc::PanelRequest panel_request(std::string_view route, const Json& body) {
  only(body, {});
  for (const auto& row : commands::panel_commands())
    if (row.route == route) return {.kind = row.kind};
  throw std::logic_error("no command of the panel has the route " + std::string(route));
}

idl::service::AlarmReset alarm_reset(const Json& body) {
  only(body, {"channel"});
  idl::service::AlarmReset reset{};
  reset.channel = body.contains("channel")
                      ? static_cast<std::uint16_t>(whole(body["channel"], "channel", 0, 65535))
                      : 65535;
  return reset;
}

idl::parameters::ParameterRequest parameter_request(std::uint32_t number_, bool is_text, const Json& body) {
  only(body, {"value", "text", "reset", "who"});
  if (body.contains("value") + body.contains("text") + body.contains("reset") != 1)
    throw BadRequest("value", "give one of value, text or reset");
  idl::parameters::ParameterRequest request{};
  request.operation = idl::parameters::Operation::SET;
  request.who = body.contains("who") ? text(body["who"], "who", name_bytes) : "hmi";
  idl::parameters::Parameter parameter{};
  parameter.number = number_;
  if (body.contains("reset")) {
    if (body["reset"] != true) throw BadRequest("reset", "reset must be true");
    request.operation = idl::parameters::Operation::RESET_TO_DEFAULT;
  } else if (is_text) {
    if (!body.contains("text")) throw BadRequest("value", "this parameter is a text: give text");
    parameter.text = text(body["text"], "text", name_bytes);
  } else {
    if (!body.contains("value")) throw BadRequest("text", "this parameter is a number: give value");
    parameter.value = number(body["value"], "value", -1e15, 1e15);
  }
  request.values.push_back(parameter);
  return request;
}

idl::parameters::ParameterRequest work_offset_request(const Json& body) {
  only(body, {"channel", "index", "values", "revision", "who"});
  idl::parameters::ParameterRequest request{};
  request.operation = idl::parameters::Operation::SET_WORK_OFFSET;
  request.who = body.contains("who") ? text(body["who"], "who", name_bytes) : "hmi";
  idl::parameters::WorkOffset offset{};
  offset.channel = static_cast<std::uint16_t>(whole(required(body, "channel"), "channel", 0, 31));
  offset.index = static_cast<std::uint8_t>(whole(required(body, "index"), "index", 0, 53));
  if (body.contains("revision"))
    request.revision = static_cast<std::uint64_t>(whole(body["revision"], "revision", 0, 1LL << 53));
  const auto& values = required(body, "values");
  if (!values.is_array() || values.size() != 9)
    throw BadRequest("values", "values must be 9 numbers: X Y Z A B C U V W");
  for (const auto& value : values) offset.values.push_back(number(value, "values", -1e6, 1e6));
  request.offsets.push_back(offset);
  return request;
}

}  // namespace trunnion::gateway
