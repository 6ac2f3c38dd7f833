// SPDX-License-Identifier: Apache-2.0
// Fields of a JSON object, checked: an error names the field and what is expected.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bus/json.hpp"

namespace trunnion::commands {

/// What is wrong with a field, and which one it is.
struct BadField : std::runtime_error {
  BadField(std::string_view where, const std::string& what) : std::runtime_error(what), field(where) {}
  std::string field;
};

/// All of these throw BadField.

/// A misspelt field would be silently without effect, so it is refused.
void only(const bus::Json& body, std::initializer_list<std::string_view> known);
const bus::Json& required(const bus::Json& body, std::string_view name);
double number(const bus::Json& value, std::string_view name, double minimum, double maximum);
/// Without a fraction; `minimum` and `maximum` are whole numbers of at most 53 bits.
std::int64_t whole(const bus::Json& value, std::string_view name, double minimum, double maximum);
/// One line of at most `longest` bytes without control characters but tabs.
std::string text(const bus::Json& value, std::string_view name, std::size_t longest);
bool boolean(const bus::Json& value, std::string_view name);
/// A name in the program store: 1 to 64 bytes, no leading dot, no slash, no control character.
void check_program_name(const std::string& name);

/// A number for people, without trailing zeros: 1.5, 0.001, 1000000.
std::string shown(double value);

}  // namespace trunnion::commands
