// SPDX-License-Identifier: Apache-2.0
#include "commands/json_fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace trunnion::commands {

using bus::Json;

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

void only(const Json& body, std::initializer_list<std::string_view> known) {
  for (const auto& [name, value] : body.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw BadField(name, "no such field: " + name);
}

const Json& required(const Json& body, std::string_view name) {
  const auto found = body.find(std::string(name));
  if (found == body.end()) throw BadField(name, "the field " + std::string(name) + " is missing");
  return *found;
}

double number(const Json& value, std::string_view name, double minimum, double maximum) {
  if (!value.is_number()) throw BadField(name, std::string(name) + " must be a number");
  const double result = value.get<double>();
  if (!(result >= minimum && result <= maximum))
    throw BadField(name, std::string(name) + " " + shown(result) + " must be from " + shown(minimum) +
                             " to " + shown(maximum));
  return result;
}

std::int64_t whole(const Json& value, std::string_view name, double minimum, double maximum) {
  const double result = number(value, name, minimum, maximum);
  if (std::floor(result) != result) throw BadField(name, std::string(name) + " must be a whole number");
  return static_cast<std::int64_t>(result);
}

std::string text(const Json& value, std::string_view name, std::size_t longest) {
  if (!value.is_string()) throw BadField(name, std::string(name) + " must be a text");
  auto result = value.get<std::string>();
  if (result.size() > longest)
    throw BadField(name, std::string(name) + " is longer than " + std::to_string(longest) + " bytes");
  if (std::any_of(result.begin(), result.end(),
                  [](unsigned char c) { return (c < 32 && c != '\t') || c == 127; }))
    throw BadField(name, std::string(name) + " must be one line without control characters");
  return result;
}

bool boolean(const Json& value, std::string_view name) {
  if (!value.is_boolean()) throw BadField(name, std::string(name) + " must be true or false");
  return value.get<bool>();
}

void check_program_name(const std::string& name) {
  if (name.empty()) throw BadField("program", "the program's name is empty");
  if (name.size() > 64) throw BadField("program", "the program's name is longer than 64 bytes");
  if (name.front() == '.') throw BadField("program", "a program's name must not begin with a dot");
  for (const unsigned char c : name)
    if (c < 32 || c == 127 || c == '/' || c == '\\')
      throw BadField("program", "a program's name must not contain a slash or a control character");
}

}  // namespace trunnion::commands
