// SPDX-License-Identifier: Apache-2.0
#include "core/requests.hpp"

#include <algorithm>
#include <stdexcept>

#include "machine/parameters.hpp"

namespace trunnion::gateway {

using bus::Json;
using commands::number;
using commands::only;
using commands::required;
using commands::text;
using commands::whole;

namespace {

constexpr std::size_t name_bytes = 64, type_bytes = 32;
constexpr std::int64_t most_values = 4096;
constexpr double longest_life = 999999;  // minutes or pieces

std::string who_of(const Json& body) {
  return body.contains("who") ? text(body["who"], "who", name_bytes) : "hmi";
}

std::uint64_t revision_of(const Json& body) {
  if (!body.contains("revision")) return 0;
  return static_cast<std::uint64_t>(whole(body["revision"], "revision", 0, 1LL << 53));
}

idl::parameters::LifeUnit life_unit_of(const Json& value) {
  const auto name = text(value, "life_unit", 16);
  if (name == "MINUTES") return idl::parameters::LifeUnit::MINUTES;
  if (name == "PIECES") return idl::parameters::LifeUnit::PIECES;
  throw BadRequest("life_unit", "life_unit must be MINUTES or PIECES");
}

}  // namespace

/// Counts before anything is kept: the members of an object are looked up one by one.
class JsonLimits : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(Json::number_integer_t) override { return value(); }
  bool number_unsigned(Json::number_unsigned_t) override { return value(); }
  bool number_float(Json::number_float_t, const std::string&) override { return value(); }
  bool string(std::string&) override { return value(); }
  bool binary(Json::binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return begin(); }
  bool start_array(std::size_t) override { return begin(); }
  bool key(std::string&) override {
    if (++members_.back() > most_members) beyond("members in an object", most_members);
    return true;
  }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  static constexpr std::size_t most_members = 64, most_levels = 16, most_values_in_all = 65536;
  [[noreturn]] static void beyond(const char* what, std::size_t most) {
    throw BadRequest("", std::string("the body has more than ") + std::to_string(most) + " " + what);
  }
  bool value() {
    if (++values_ > most_values_in_all) beyond("values", most_values_in_all);
    return true;
  }
  bool begin() {
    members_.push_back(0);
    if (members_.size() > most_levels) beyond("levels", most_levels);
    return value();
  }
  bool end() {
    members_.pop_back();
    return true;
  }
  std::vector<std::size_t> members_;  ///< so far, of what is open
  std::size_t values_ = 0;
};

Json parse_body(const std::string& body) {
  if (body.find_first_not_of(" \t\r\n") == std::string::npos) return Json::object();
  JsonLimits limits;
  if (!Json::sax_parse(body, &limits)) throw BadRequest("", "the body is not JSON");
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
  request.who = who_of(body);
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

idl::parameters::ParameterRequest parameter_import(const Json& body) {
  only(body, {"values", "who"});
  const auto& rows = required(body, "values");
  if (!rows.is_array() || rows.empty() || rows.size() > most_values)
    throw BadRequest("values",
                     "values must be a list of 1 to " + std::to_string(most_values) + " parameters");
  idl::parameters::ParameterRequest request{};
  request.operation = idl::parameters::Operation::IMPORT;
  request.who = who_of(body);
  for (const auto& row : rows) {
    if (!row.is_object()) throw BadRequest("values", "each of values must be an object");
    only(row, {"number", "value", "text"});
    const auto wanted = static_cast<std::uint32_t>(whole(required(row, "number"), "number", 0, 999999));
    const auto* definition = machine::Catalogue::instance().find(wanted);
    if (definition == nullptr) throw BadRequest("number", "no parameter " + std::to_string(wanted));
    const bool is_text = definition->type == machine::ParameterType::text;
    if (row.contains("value") + row.contains("text") != 1 || row.contains("text") != is_text)
      throw BadRequest("values", "parameter " + std::to_string(wanted) + " needs " +
                                     (is_text ? "text and no value" : "value and no text"));
    idl::parameters::Parameter parameter{};
    parameter.number = wanted;
    if (is_text)
      parameter.text = text(row["text"], "text", name_bytes);
    else
      parameter.value = number(row["value"], "value", -1e15, 1e15);
    request.values.push_back(parameter);
  }
  return request;
}

idl::parameters::ParameterRequest tool_request(std::uint32_t number_, const Json& body) {
  only(body, {"length", "length_wear", "radius", "radius_wear", "name", "type", "life_used", "life_limit",
              "life_unit", "revision", "who"});
  idl::parameters::ParameterRequest request{};
  request.operation = idl::parameters::Operation::SET_TOOL;
  request.who = who_of(body);
  request.revision = revision_of(body);
  const auto field = [&](const char* name) { return number(required(body, name), name, -1e6, 1e6); };
  idl::parameters::Tool tool{};
  tool.number = number_;
  tool.length = field("length");
  tool.length_wear = field("length_wear");
  tool.radius = field("radius");
  tool.radius_wear = field("radius_wear");
  tool.name = text(required(body, "name"), "name", name_bytes);
  if (body.contains("type")) tool.type = text(body["type"], "type", type_bytes);
  if (body.contains("life_used")) tool.life_used = number(body["life_used"], "life_used", 0, longest_life);
  if (body.contains("life_limit"))
    tool.life_limit = number(body["life_limit"], "life_limit", 0, longest_life);
  if (body.contains("life_unit")) tool.life_unit = life_unit_of(body["life_unit"]);
  request.tools.push_back(tool);
  return request;
}

idl::parameters::ParameterRequest tool_removal(std::uint32_t number_, const std::string& revision) {
  idl::parameters::ParameterRequest request{};
  request.operation = idl::parameters::Operation::REMOVE_TOOL;
  request.who = "hmi";
  if (!revision.empty()) {
    const auto known = path_number(revision, 999999999);
    if (!known) throw BadRequest("revision", "revision must be a whole number");
    request.revision = *known;
  }
  idl::parameters::Tool tool{};
  tool.number = number_;
  request.tools.push_back(tool);
  return request;
}

idl::program::ProgramRequest rename_request(const std::string& name, const Json& body) {
  only(body, {"name"});
  commands::check_program_name(name);
  idl::program::ProgramRequest request{};
  request.operation = idl::program::Operation::RENAME;
  request.name = name;
  request.new_name = text(required(body, "name"), "name", name_bytes);
  commands::check_program_name(request.new_name);
  return request;
}

idl::parameters::ParameterRequest work_offset_request(const Json& body) {
  only(body, {"channel", "index", "values", "revision", "who"});
  idl::parameters::ParameterRequest request{};
  request.operation = idl::parameters::Operation::SET_WORK_OFFSET;
  request.who = who_of(body);
  request.revision = revision_of(body);
  idl::parameters::WorkOffset offset{};
  offset.channel = static_cast<std::uint16_t>(whole(required(body, "channel"), "channel", 0, 31));
  offset.index = static_cast<std::uint8_t>(whole(required(body, "index"), "index", 0, 61));
  const auto& values = required(body, "values");
  if (!values.is_array() || values.size() != 9)
    throw BadRequest("values", "values must be 9 numbers: X Y Z A B C U V W");
  for (const auto& value : values) offset.values.push_back(number(value, "values", -1e6, 1e6));
  request.offsets.push_back(offset);
  return request;
}

}  // namespace trunnion::gateway
