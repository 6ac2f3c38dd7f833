#include "src/orders.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace trunnion::gateway {
namespace {

using bus::Json;
using idl::channel::ChannelRequest;
using idl::channel::CommandKind;

constexpr std::size_t name_bytes = 64;
constexpr std::size_t text_bytes = 256;
constexpr double fastest = 1e6;        // mm/min or deg/min, above every axis
constexpr double longest_step = 1e4;   // mm or deg
constexpr double most_counts = 10000;  // of the handwheel in one request
constexpr std::uint32_t most_lines = 999999999;

/// A misspelt field would be silently without effect, so it is refused.
void only(const Json& body, std::initializer_list<const char*> known) {
  for (const auto& [name, value] : body.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw BadRequest(name, "no such field: " + name);
}

const Json& required(const Json& body, const char* name) {
  const auto found = body.find(name);
  if (found == body.end()) throw BadRequest(name, std::string("the field ") + name + " is missing");
  return *found;
}

double number(const Json& value, const char* name, double minimum, double maximum) {
  if (!value.is_number()) throw BadRequest(name, std::string(name) + " must be a number");
  const double result = value.get<double>();
  if (!(result >= minimum && result <= maximum))
    throw BadRequest(
        name, std::string(name) + " must be from " + Json(minimum).dump() + " to " + Json(maximum).dump());
  return result;
}

std::uint32_t whole(const Json& value, const char* name, std::uint32_t maximum) {
  const double result = number(value, name, 0, maximum);
  if (std::floor(result) != result) throw BadRequest(name, std::string(name) + " must be a whole number");
  return static_cast<std::uint32_t>(result);
}

std::string text(const Json& value, const char* name, std::size_t longest) {
  if (!value.is_string()) throw BadRequest(name, std::string(name) + " must be a text");
  auto result = value.get<std::string>();
  if (result.size() > longest)
    throw BadRequest(name, std::string(name) + " is longer than " + std::to_string(longest) + " bytes");
  if (std::any_of(result.begin(), result.end(),
                  [](unsigned char c) { return (c < 32 && c != '\t') || c == 127; }))
    throw BadRequest(name, std::string(name) + " must be one line without control characters");
  return result;
}

bool on(const Json& body) {
  only(body, {"on"});
  const auto& value = required(body, "on");
  if (!value.is_boolean()) throw BadRequest("on", "on must be true or false");
  return value.get<bool>();
}

/// By letter or by index.
std::uint8_t axis(const Json& body, const idl::channel::ChannelState& state) {
  const auto& value = required(body, "axis");
  const auto count = std::min(state.axes.size(), state.letters.size());
  if (value.is_string()) {
    const auto letter = value.get<std::string>();
    const auto at = letter.size() == 1 ? state.letters.find(letter[0]) : std::string::npos;
    if (at >= count)
      throw BadRequest("axis",
                       "the channel has no axis " + letter + ", it has " + std::string(state.letters));
    return static_cast<std::uint8_t>(at);
  }
  if (!value.is_number_integer()) throw BadRequest("axis", "axis must be a letter or an index");
  const auto index = value.get<std::int64_t>();
  if (index < 0 || index >= static_cast<std::int64_t>(count))
    throw BadRequest("axis", "the channel has " + std::to_string(count) + " axes, counted from 0");
  return static_cast<std::uint8_t>(index);
}

/// {"axes": ["X", 1]}, by letter or index: bit i for axis i of the channel.
std::uint16_t axis_mask(const Json& body, const idl::channel::ChannelState& state) {
  only(body, {"axes"});
  const auto& axes = required(body, "axes");
  if (!axes.is_array() || axes.size() > state.axes.size())
    throw BadRequest("axes", "axes must be a list of axes of the channel; empty unlocks them all");
  std::uint32_t mask = 0;
  for (const auto& one : axes) mask |= 1u << axis(Json{{"axis", one}}, state);
  return static_cast<std::uint16_t>(mask);
}

/// {"levels": [1, 3]}: bit 0 for level 1.
std::uint16_t level_mask(const Json& body) {
  only(body, {"levels"});
  const auto& levels = required(body, "levels");
  if (!levels.is_array() || levels.size() > 9)
    throw BadRequest("levels", "levels must be a list of numbers from 1 to 9; empty skips nothing");
  std::uint32_t mask = 0;
  for (const auto& level : levels) {
    const auto value = whole(level, "levels", 9);
    if (value < 1) throw BadRequest("levels", "levels count from 1");
    mask |= 1u << (value - 1);
  }
  return static_cast<std::uint16_t>(mask);
}

std::int32_t counts(const Json& body) {
  const double value = number(required(body, "counts"), "counts", -most_counts, most_counts);
  if (std::floor(value) != value) throw BadRequest("counts", "counts must be a whole number");
  return static_cast<std::int32_t>(value);
}

CommandKind switch_of(Operation operation) {
  switch (operation) {
    case Operation::single_block:
      return CommandKind::SINGLE_BLOCK;
    case Operation::optional_stop:
      return CommandKind::OPTIONAL_STOP;
    case Operation::dry_run:
      return CommandKind::DRY_RUN;
    case Operation::auxiliary_lock:
      return CommandKind::AUXILIARY_LOCK;
    case Operation::retrace:
      return CommandKind::RETRACE;
    default:
      return CommandKind::HANDWHEEL_OFFSET;
  }
}

idl::channel::Mode mode(const Json& body) {
  only(body, {"mode"});
  const auto name = text(required(body, "mode"), "mode", name_bytes);
  for (std::size_t i = 0; i < bus::enum_size<idl::channel::Mode>(); ++i)
    if (name == bus::EnumNames<idl::channel::Mode>::names[i]) return static_cast<idl::channel::Mode>(i);
  throw BadRequest("mode", "mode must be AUTO, MDI, JOG or REF");
}

void set_override(const Json& body, ChannelRequest& request) {
  only(body, {"kind", "value"});
  const auto kind = text(required(body, "kind"), "kind", name_bytes);
  const auto& value = required(body, "value");
  if (kind == "feed") {
    request.command = CommandKind::FEED_OVERRIDE;
    request.fraction = number(value, "value", 0, 1.5);
  } else if (kind == "rapid") {
    request.command = CommandKind::RAPID_OVERRIDE;
    request.fraction = number(value, "value", 0, 1);
  } else if (kind == "spindle") {
    request.command = CommandKind::SPINDLE_OVERRIDE;
    request.fraction = number(value, "value", 0.5, 1.5);
  } else {
    throw BadRequest("kind", "kind must be feed, rapid or spindle");
  }
}

std::string mdi_line(const Json& body) {
  only(body, {"line"});
  auto line = text(required(body, "line"), "line", text_bytes);
  if (line.find_first_not_of(" \t") == std::string::npos) throw BadRequest("line", "line is empty");
  return line;
}

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

ChannelRequest channel_order(Operation operation, const Json& body, const idl::channel::ChannelState& state) {
  ChannelRequest request{};
  request.channel = state.channel;
  switch (operation) {
    case Operation::mode:
      request.command = CommandKind::SET_MODE;
      request.mode = mode(body);
      return request;
    case Operation::select:
      only(body, {"program"});
      request.command = CommandKind::SELECT_PROGRAM;
      request.program = text(required(body, "program"), "program", name_bytes);
      check_program_name(request.program);
      return request;
    case Operation::mdi:
      request.command = CommandKind::MDI_LINE;
      request.block = mdi_line(body);
      return request;
    case Operation::jog:
      only(body, {"axis", "speed", "increment"});
      request.command = CommandKind::JOG_AXIS;
      request.axis = axis(body, state);
      request.speed = number(required(body, "speed"), "speed", -fastest, fastest);
      if (request.speed == 0) throw BadRequest("speed", "speed must not be 0: its sign is the direction");
      if (body.contains("increment"))
        request.increment = number(body["increment"], "increment", 0, longest_step);
      return request;
    case Operation::jog_stop:
      only(body, {"axis"});
      request.command = CommandKind::JOG_STOP;
      request.axis = axis(body, state);
      return request;
    case Operation::reference:
      only(body, {"axis"});
      request.command = CommandKind::REFERENCE_AXIS;
      request.axis = axis(body, state);
      return request;
    case Operation::override_:
      set_override(body, request);
      return request;
    case Operation::single_block:
    case Operation::optional_stop:
    case Operation::dry_run:
    case Operation::auxiliary_lock:
    case Operation::retrace:
    case Operation::handwheel_offset:
      request.command = switch_of(operation);
      request.on = on(body);
      return request;
    case Operation::start_from_line:
      only(body, {"line"});
      request.command = CommandKind::START_FROM_LINE;
      request.line = whole(required(body, "line"), "line", most_lines);
      if (request.line < 1) throw BadRequest("line", "lines count from 1");
      return request;
    case Operation::axis_lock:
      request.command = CommandKind::AXIS_LOCK;
      request.axes = axis_mask(body, state);
      return request;
    case Operation::block_skip:
      request.command = CommandKind::BLOCK_SKIP;
      request.levels = level_mask(body);
      return request;
    case Operation::handwheel:
      only(body, {"axis", "counts", "increment"});
      request.command = CommandKind::HANDWHEEL;
      request.axis = axis(body, state);
      request.counts = counts(body);
      request.increment = number(required(body, "increment"), "increment", 0, longest_step);
      return request;
    case Operation::cycle_start:
    case Operation::feed_hold:
    case Operation::reset:
      only(body, {});
      request.command = operation == Operation::cycle_start ? CommandKind::CYCLE_START
                        : operation == Operation::feed_hold ? CommandKind::FEED_HOLD
                                                            : CommandKind::RESET;
      return request;
    default:
      throw std::logic_error("not an order to a channel");
  }
}

idl::plc::PanelRequest panel_order(Operation operation, const Json& body) {
  only(body, {});
  idl::plc::PanelRequest request{};
  using idl::plc::PanelRequestKind;
  request.kind = operation == Operation::emergency_stop ? PanelRequestKind::PRESS_EMERGENCY_STOP
                 : operation == Operation::release      ? PanelRequestKind::RELEASE_EMERGENCY_STOP
                                                        : PanelRequestKind::RESET_EMERGENCY_STOP;
  return request;
}

idl::service::AlarmReset alarm_reset_order(const Json& body) {
  only(body, {"channel"});
  idl::service::AlarmReset reset{};
  reset.channel =
      body.contains("channel") ? static_cast<std::uint16_t>(whole(body["channel"], "channel", 65535)) : 65535;
  return reset;
}

idl::parameters::ParameterRequest parameter_order(std::uint32_t number_, bool is_text, const Json& body) {
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

idl::parameters::ParameterRequest work_offset_order(const Json& body) {
  only(body, {"channel", "index", "values", "who"});
  idl::parameters::ParameterRequest request{};
  request.operation = idl::parameters::Operation::SET_WORK_OFFSET;
  request.who = body.contains("who") ? text(body["who"], "who", name_bytes) : "hmi";
  idl::parameters::WorkOffset offset{};
  offset.channel = static_cast<std::uint16_t>(whole(required(body, "channel"), "channel", 31));
  offset.index = static_cast<std::uint8_t>(whole(required(body, "index"), "index", 53));
  const auto& values = required(body, "values");
  if (!values.is_array() || values.size() != 9)
    throw BadRequest("values", "values must be 9 numbers: X Y Z A B C U V W");
  for (const auto& value : values) offset.values.push_back(number(value, "values", -1e6, 1e6));
  request.offsets.push_back(offset);
  return request;
}

void check_program_name(const std::string& name) {
  if (name.empty()) throw BadRequest("program", "the program's name is empty");
  if (name.size() > name_bytes) throw BadRequest("program", "the program's name is longer than 64 bytes");
  if (name.front() == '.') throw BadRequest("program", "a program's name must not begin with a dot");
  for (const unsigned char c : name)
    if (c < 32 || c == 127 || c == '/' || c == '\\')
      throw BadRequest("program", "a program's name must not contain a slash or a control character");
}

}  // namespace trunnion::gateway
