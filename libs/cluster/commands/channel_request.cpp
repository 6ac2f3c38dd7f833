// SPDX-License-Identifier: Apache-2.0
#include "commands/channel_request.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

namespace trunnion::commands {
namespace {

using bus::Json;
using idl::channel::ChannelRequest;
using idl::channel::Mode;

constexpr std::size_t name_bytes = 64, block_bytes = 256;  // as in idl/channel.idl

std::string names_of_modes() {
  std::string names;
  for (const auto* name : bus::EnumNames<Mode>::names)
    names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

Mode mode_of(const Json& value, std::string_view name) {
  const auto mode = bus::from_string<Mode>(text(value, name, name_bytes));
  if (!mode) throw BadField(name, std::string(name) + " must be one of " + names_of_modes());
  return *mode;
}

std::string program_of(const Json& value, std::string_view name) {
  auto program = text(value, name, name_bytes);
  check_program_name(program);
  return program;
}

std::string block_of(const Json& value, std::string_view name) {
  auto block = text(value, name, block_bytes);
  if (block.find_first_not_of(" \t") == std::string::npos)
    throw BadField(name, std::string(name) + " is empty");
  return block;
}

/// By letter or by index.
std::uint8_t axis_of(const Json& value, std::string_view letters) {
  if (value.is_string()) {
    const auto letter = value.get<std::string>();
    const auto at = letter.size() == 1 ? letters.find(letter[0]) : std::string_view::npos;
    if (at == std::string_view::npos)
      throw BadField("axis", "the channel has no axis " + letter + ", it has " + std::string(letters));
    return static_cast<std::uint8_t>(at);
  }
  if (!value.is_number_integer()) throw BadField("axis", "axis must be a letter or an index");
  const auto index = value.get<std::int64_t>();
  if (index < 0 || index >= static_cast<std::int64_t>(letters.size()))
    throw BadField("axis", "the channel has " + std::to_string(letters.size()) + " axes, counted from 0");
  return static_cast<std::uint8_t>(index);
}

std::uint16_t axes_of(const Json& axes, std::string_view name, std::string_view letters) {
  if (!axes.is_array() || axes.size() > letters.size())
    throw BadField(name,
                   std::string(name) + " must be a list of axes of the channel; empty unlocks them all");
  std::uint16_t mask = 0;
  for (const auto& one : axes) mask = static_cast<std::uint16_t>(mask | 1u << axis_of(one, letters));
  return mask;
}

std::uint16_t levels_of(const Json& levels, const Field& field) {
  if (!levels.is_array() || levels.size() > 9)
    throw BadField(field.name,
                   std::string(field.name) + " must be a list of numbers from 1 to 9; empty skips nothing");
  std::uint16_t mask = 0;
  for (const auto& level : levels)
    mask =
        static_cast<std::uint16_t>(mask | 1u << (whole(level, field.name, field.minimum, field.maximum) - 1));
  return mask;
}

/// Empty when `value` is within the limits of `field`.
std::string outside(const Field& field, double value) {
  const auto what = std::string(field.name) + " " + shown(value) + " must be ";
  if (!field.one_of.empty()) {
    if (std::find(field.one_of.begin(), field.one_of.end(), value) != field.one_of.end()) return "";
    std::string list;
    for (const double one : field.one_of) list += (list.empty() ? "" : ", ") + shown(one);
    return what + "one of " + list;
  }
  if (!(value >= field.minimum && value <= field.maximum))
    return what + "from " + shown(field.minimum) + " to " + shown(field.maximum);
  if (field.nonzero && value == 0)
    return std::string(field.name) + " must not be 0: its sign is the direction";
  return "";
}

double number_of(const Json& value, const Field& field) {
  if (!value.is_number()) throw BadField(field.name, std::string(field.name) + " must be a number");
  const double result = value.get<double>();
  if (const auto why = outside(field, result); !why.empty()) throw BadField(field.name, why);
  return result;
}

double whole_of(const Json& value, const Field& field) {
  const double result = number_of(value, field);
  if (std::floor(result) != result)
    throw BadField(field.name, std::string(field.name) + " must be a whole number");
  return result;
}

void fill(ChannelRequest& request, const Field& field, const Json& value, std::string_view letters) {
  switch (field.into) {
    case Into::mode:
      request.mode = mode_of(value, field.name);
      break;
    case Into::program:
      request.program = program_of(value, field.name);
      break;
    case Into::block:
      request.block = block_of(value, field.name);
      break;
    case Into::line:
      request.line = static_cast<std::uint32_t>(whole_of(value, field));
      break;
    case Into::on:
      request.on = boolean(value, field.name);
      break;
    case Into::fraction:
      request.fraction = number_of(value, field);
      break;
    case Into::axis:
      request.axis = axis_of(value, letters);
      break;
    case Into::speed:
      request.speed = number_of(value, field);
      break;
    case Into::increment:
      request.increment = number_of(value, field);
      break;
    case Into::counts:
      request.counts = static_cast<std::int32_t>(whole_of(value, field));
      break;
    case Into::axes:
      request.axes = axes_of(value, field.name, letters);
      break;
    case Into::levels:
      request.levels = levels_of(value, field);
      break;
    case Into::press:
      request.press = static_cast<std::uint32_t>(whole_of(value, field));
      break;
    case Into::parts:
      request.parts = static_cast<std::uint32_t>(whole_of(value, field));
      break;
    case Into::tool:
      request.tool = static_cast<std::uint32_t>(whole_of(value, field));
      break;
  }
}

ChannelRequest filled(const ChannelCommand& command, const Json& body, std::string_view letters) {
  for (const auto& [name, value] : body.items())
    if (name != command.choice_field &&
        std::none_of(command.fields.begin(), command.fields.end(),
                     [&, &given = name](const Field& field) { return field.name == given; }))
      throw BadField(name, "no such field: " + name);
  ChannelRequest request;
  request.command = command.kind;
  for (const auto& field : command.fields)
    if (!field.optional || body.contains(std::string(field.name)))
      fill(request, field, required(body, field.name), letters);
  return request;
}

/// Of the commands that share a route the one that the body chooses.
const ChannelCommand& chosen(std::string_view route, const Json& body) {
  std::string choices;
  std::string_view field;
  for (const auto& row : channel_commands()) {
    if (row.route != route) continue;
    if (row.choice_field.empty()) return row;
    field = row.choice_field;
    if (text(required(body, field), field, name_bytes) == row.choice) return row;
    choices.append(choices.empty() ? "" : ", ").append(row.choice);
  }
  if (field.empty()) throw std::logic_error("no command has the route " + std::string(route));
  throw BadField(field, std::string(field) + " must be one of " + choices);
}

Json number_word(const Field& field, const std::string& word) {
  std::size_t read = 0;
  double value = 0;
  try {
    value = std::stod(word, &read);
  } catch (const std::exception&) {
    read = 0;
  }
  if (read == 0 || read != word.size()) throw BadField(field.name, "'" + word + "' is not a number");
  return value;
}

/// One word of the command line as the JSON of its field.
Json json_of(const Field& field, const std::string& word, std::string_view letters) {
  switch (field.into) {
    case Into::on:
      if (word != "on" && word != "off") throw BadField(field.name, "'" + word + "' must be on or off");
      return word == "on";
    case Into::mode: {
      std::string name = word;
      std::transform(name.begin(), name.end(), name.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      return name;
    }
    case Into::axes:
    case Into::levels: {
      Json list = Json::array();
      if (word == "off") return list;
      if (field.into == Into::axes && word == "all") return json_of(field, std::string(letters), letters);
      for (const char one : word) {
        if (field.into == Into::axes)
          list.push_back(std::string(1, one));
        else
          list.push_back(number_word(field, std::string(1, one)));
      }
      return list;
    }
    case Into::program:
    case Into::block:
    case Into::axis:
      return word;
    default:
      return number_word(field, word);
  }
}

/// What the number of a field is in a request; nothing for fields that are no numbers.
std::optional<double> number_in(const ChannelRequest& request, Into field) {
  switch (field) {
    case Into::line:
      return request.line;
    case Into::fraction:
      return request.fraction;
    case Into::speed:
      return request.speed;
    case Into::increment:
      return request.increment;
    case Into::counts:
      return request.counts;
    case Into::press:
      return request.press;
    case Into::parts:
      return request.parts;
    case Into::tool:
      return request.tool;
    default:
      return std::nullopt;
  }
}

}  // namespace

ChannelRequest request_of(std::string_view route, const Json& body, std::string_view letters) {
  return filled(chosen(route, body), body, letters);
}

ChannelRequest request_of(const ChannelCommand& command, const std::vector<std::string>& arguments,
                          std::string_view letters) {
  if (arguments.size() > command.fields.size())
    throw BadField("", "'" + arguments[command.fields.size()] + "' is too much: " + usage(command));
  Json body = Json::object();
  ChannelCommand needed = command;
  for (std::size_t i = 0; i < command.fields.size(); ++i) {
    const auto& field = command.fields[i];
    if (i < arguments.size()) {
      body[std::string(field.name)] = json_of(field, arguments[i], letters);
    } else if (field.word_optional) {
      needed.fields = command.fields.first(i);
      break;
    } else if (!field.optional) {
      throw BadField(field.name, std::string(field.argument) + " is missing: " + usage(command));
    }
  }
  return filled(needed, body, letters);
}

bool names_axes(const ChannelCommand& command) {
  return std::any_of(command.fields.begin(), command.fields.end(),
                     [](const Field& field) { return field.into == Into::axis || field.into == Into::axes; });
}

std::string outside_limits(const ChannelRequest& request) {
  for (const auto& row : channel_commands()) {
    if (row.kind != request.command) continue;
    for (const auto& field : row.fields)
      if (const auto value = number_in(request, field.into))
        if (auto why = outside(field, *value); !why.empty()) return why;
  }
  return "";
}

}  // namespace trunnion::commands
